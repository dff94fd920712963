// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_node_weights_h
#define conetact_pairing_node_weights_h

#include "conetact/pairing/contact_nodes.h"

namespace conetact::pairing
{
  using NodeWeights = std::vector<std::pair<unsigned int, double>>;

  /** The mean of two means over nodes, in parts of 1. */
  NodeWeights
  mean_of(const NodeWeights &first,
          const double       first_part,
          const NodeWeights &second,
          const double       second_part);

  /** What a contact node is a mean over on its own body: at least itself. */
  NodeWeights
  own_side(const ContactNode &node);
} // namespace conetact::pairing

#endif
