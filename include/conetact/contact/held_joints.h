// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_held_joints_h
#define conetact_contact_held_joints_h

#include "conetact/contact/contact_model.h"

#include <string>
#include <utility>
#include <vector>

namespace conetact::contact
{
  /** Displacements of all dofs in space [length] at a time; none of them: the
   * undeformed bodies. */
  struct DisplacedAt
  {
    const Eigen::VectorXd &u;
    double                 t = 0;
  };

  /**
   * Nodes of ties that begin or end, and of bonds, that have no reaction of
   * their own, since a support holds them: whether their sides keep together
   * all the same.
   */
  class HeldJoints
  {
  public:
    /** Names of contacts, by number. Both must outlive the object. */
    HeldJoints(const std::vector<std::string> &names,
               const ContactModel             &model);

    /**
     * Which sides have parted in an increment, a sentence without its full
     * stop; empty: none have. Of each candidate `states` and whether its bond
     * is `whole` (empty: there are no bonds) at the end.
     */
    std::string
    parted(const DisplacedAt                     &start,
           const DisplacedAt                     &end,
           const std::vector<solvers::NodeState> &states,
           const std::vector<bool>               &whole) const;

  private:
    Tensor<1, 3>
    relative(const pairing::ContactNode &node, const DisplacedAt &at) const;
    double
    parted_tie(const pairing::ContactNode &node,
               const DisplacedAt          &start,
               const DisplacedAt          &end) const;
    double
    parted_bond(const pairing::ContactNode &node,
                const DisplacedAt          &start,
                const DisplacedAt          &end,
                const bool                  sticks) const;
    std::string
    sentence(const pairing::ContactNode &node, const double way) const;

    const std::vector<std::string> &names;
    const ContactModel             &model;
    /** Of bonds; the candidate beside each, whose bond says what theirs is. */
    std::vector<std::pair<std::size_t, std::size_t>> bonds;
    std::vector<std::size_t>                         ties;
  };
} // namespace conetact::contact

#endif
