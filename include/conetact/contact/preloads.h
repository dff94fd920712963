// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_preloads_h
#define conetact_contact_preloads_h

#include "conetact/contact/node_rules.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace conetact::contact
{
  /**
   * Ties across which a force draws both sides together, as a bolt that is
   * tightened: the sides keep their places relative to each other but for a
   * translation s along an axis, the same for all nodes,
   * @f[ u - \sum_k w_k u_k = s\,e,\qquad e \cdot \sum_i r_i = -F(t), @f]
   * with the tension F given and s found, until the cut is locked; from then on
   * s stays and F is found. s is the motion of a rigid body without nodes of
   * its own that every contact node of the tie sees beside its two sides: one
   * free motion, whose balance is the equation of F. It carries nothing from
   * one side to the other: forces on both sides are opposite as those of any
   * tie.
   *
   * Comes last: behind free obstacles, before anyone asks for rigid motions.
   * Throws InputError.
   */
  std::vector<std::unique_ptr<bodies::Structure>>
  add_preloads(const std::vector<pairing::Contact> &contacts,
               model::Bodies                       &bodies);

  /** Adds their tensions at time t, on all dofs of all bodies [force]. */
  void
  add_preload_forces(const std::vector<pairing::Contact> &contacts,
                     const model::Bodies                 &bodies,
                     const double                         t,
                     Eigen::VectorXd                     &f);

  /** Prestress of all contacts, on all dofs of all bodies [force]; empty: there
   * is none. */
  Eigen::VectorXd
  prestress_forces(const model::Bodies &bodies);
} // namespace conetact::contact

#endif
