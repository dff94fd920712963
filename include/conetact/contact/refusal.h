// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_refusal_h
#define conetact_contact_refusal_h

#include "conetact/contact/contact_model.h"
#include "conetact/solvers/existence.h"

#include <optional>
#include <string>
#include <vector>

namespace conetact::contact
{
  /** The existence check of a model's contact system, in its node frames, with
   * friction coefficients of the nodes. */
  solvers::ExistenceCheck
  make_existence_check(ContactModel &model, const Eigen::VectorXd &mu);

  /** Whether a load of the contact unknowns drives free motions that the nodes
   * which hold anything do not see. */
  bool
  drives_what_is_not_held(const std::vector<bool> &holding,
                          const Eigen::VectorXd   &load,
                          ContactModel            &model);

  /** The same by those contact nodes alone that hold anything; nothing: they do
   * not see all free motions. */
  std::optional<solvers::Existence>
  check_by(const std::vector<bool> &holding,
           const Eigen::VectorXd   &load,
           const Eigen::VectorXd   &start,
           const double             reference_force,
           ContactModel            &model);

  /**
   * The same by those contact nodes alone that are nearest to what they face,
   * contact by contact: what holds a body where it stands. `gaps`, the load
   * and the start of the increment are as check() takes them. Nothing: those
   * nodes do not see all free motions.
   */
  std::optional<solvers::Existence>
  check_where_it_stands(const Eigen::VectorXd &gaps,
                        const Eigen::VectorXd &load,
                        const Eigen::VectorXd &start,
                        const double           reference_force,
                        ContactModel          &model);

  /**
   * What happens physically where no equilibrium exists: "body 'block' slides
   * along (1, 0, 0): of this increment's load friction can carry at most
   * 0.62". The body that is named is the one that `forces` on all dofs drive
   * most.
   */
  std::string
  describe(const solvers::Existence &refusal,
           const ContactModel       &model,
           const Eigen::VectorXd    &forces = {});

  /** What the body does, without why: "body 'lid' lifts off, moving along (0,
   * 1, 0)". */
  std::string
  describe_motion(const solvers::Existence &refusal,
                  const ContactModel       &model,
                  const Eigen::VectorXd    &forces);

  /** The contacts that touch all of whose nodes slip under the reactions
   * `last`, where each node has so much friction, as a sentence; empty: there
   * are none.
   */
  std::string
  what_slips(const Eigen::VectorXd          &last,
             const Eigen::VectorXd          &friction,
             const std::vector<std::string> &contact_names,
             const ContactModel             &model);

  /**
   * The same of ExistenceCheck::limit_state(), with the contacts all of whose
   * nodes slip under the reactions `last`, where each node has so much
   * friction, and what to do.
   */
  std::string
  describe_limit(const solvers::Existence       &limit,
                 const Eigen::VectorXd          &last,
                 const Eigen::VectorXd          &friction,
                 const std::vector<std::string> &contact_names,
                 const ContactModel             &model,
                 const Eigen::VectorXd          &forces);
} // namespace conetact::contact

#endif
