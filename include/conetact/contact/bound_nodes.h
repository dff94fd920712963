// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_bound_nodes_h
#define conetact_contact_bound_nodes_h

#include "conetact/contact/node_rules.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * Nodes that ties and bilateral contacts bind by themselves, as slaves or as
   * the one master of a slave. Where another contact of the same node faces the
   * same body its gap cannot change, as at the end of a weld or of a crack.
   */
  class BoundNodes
  {
  public:
    explicit BoundNodes(const std::vector<pairing::ContactNode> &nodes);

    /** Adds the directions in which a contact node that is not bound is, by
     * others, to what it faces. */
    void
    append(const pairing::ContactNode &node,
           std::vector<Tensor<1, 3>>  &orthonormal) const;

    /** Whether they hold it along its normal. */
    bool
    hold(const pairing::ContactNode &node) const
    {
      std::vector<Tensor<1, 3>> basis;
      append(node, basis);
      return !basis.empty() && is_spanned(node.n, basis);
    }

  private:
    struct Bound
    {
      int                       opponent;
      std::vector<Tensor<1, 3>> directions;
    };

    std::map<std::pair<unsigned int, unsigned int>, std::vector<Bound>> all;
  };

  /** Why a mean over faces that slides far may not be held by a support along
   * its normal, a sentence without its stop. */
  std::string
  why_it_does_not_slide(const pairing::ContactNode &node,
                        const model::Bodies        &bodies);
} // namespace conetact::contact

#endif
