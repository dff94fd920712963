// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_geometric_stiffness_h
#define conetact_contact_geometric_stiffness_h

#include "conetact/contact/contact_model.h"

#include <Eigen/Core>

namespace conetact::contact
{
  /**
   * How forces on bodies resist their turns because they keep their directions
   * [force/length of amounts], a block for each body in RigidModes. With the
   * virial @f$V = \sum x \otimes f@f$ a turn by @f$a@f$ takes away the moment
   * @f[ (\mathrm{tr} V\, I - V) a . @f]
   * It is that of a pendulum: positive where forces pull a body apart, and of
   * no use where they press it together, which is left out. Only bodies that
   * have frames and are free to turn have any; empty: none has.
   * `forces`: on all dofs, in the frames of bodies [force]; on each body they
   * are in balance.
   */
  Eigen::MatrixXd
  geometric_stiffness(const ContactModel &model, const Eigen::VectorXd &forces);

  /** The same of loads alone: each body is held by the node that it would come
   * to rest on if its load moved it straight on. */
  Eigen::MatrixXd
  geometric_stiffness_of_loads(const ContactModel    &model,
                               const Eigen::VectorXd &loads);
} // namespace conetact::contact

#endif
