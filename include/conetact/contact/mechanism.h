// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_mechanism_h
#define conetact_contact_mechanism_h

#include "conetact/contact/contact_model.h"

#include <string>
#include <vector>

namespace conetact::contact
{
  /** What happens at a limit load, read from the velocity of the contacts. */
  struct Mechanism
  {
    std::string kind; ///< sliding, turning, tipping or lifting
    /** Touching nodes of the bodies that move, indices of contact nodes. */
    std::vector<std::size_t> slide, stay, open;
  };

  /**
   * `velocity` of the contact unknowns, largest entry 1; `touching`: whether
   * each node is closed when the motion sets in. Nodes that slide by one
   * translation between each two bodies make a sliding, others a turning; where
   * some open and others stay closed, the body tips.
   */
  Mechanism
  name_mechanism(const ContactModel      &model,
                 const Eigen::VectorXd   &velocity,
                 const std::vector<bool> &touching);

  /** "node 3 of contact 'bottom'" or "nodes 1, 2, 3 and 17 more of ...". */
  std::string
  name_nodes(const ContactModel             &model,
             const std::vector<std::string> &contact_names,
             const std::vector<std::size_t> &nodes);
} // namespace conetact::contact

#endif
