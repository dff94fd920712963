// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_candidates_h
#define conetact_contact_candidates_h

#include "conetact/contact/contact_model.h"

#include <functional>

namespace conetact::contact
{
  /**
   * Contact nodes that may touch under the given loads, by a cheap guess that
   * no result depends on: those that the motion of supports and obstacles
   * brings into contact, and those that the loads press close enough, each
   * contact node taken as a spring of its own stiffness, softer in proportion
   * to the number of nodes across the contact. Always enough to hold every
   * body. All of them where leaving some out would not pay.
   *
   * `forces` are nodal forces on all dofs [force]; `times` some of the run's.
   */
  WorkingSet
  guess_working_set(
    const ContactModel                                   &model,
    const std::function<Eigen::VectorXd(const double t)> &forces,
    const std::vector<double>                            &times);

  /**
   * Candidates outside the working set that penetrate, by the gaps of all
   * [length]. Where there are none, a result is that of the whole set.
   */
  std::vector<Eigen::Index>
  penetrating(const ContactModel &model, const Eigen::VectorXd &gaps);

  /**
   * Adds those to the condensation at hand, or condenses anew with them where
   * that is cheaper.
   */
  void
  join(ContactModel &model, const Eigen::VectorXd &gaps);
} // namespace conetact::contact

#endif
