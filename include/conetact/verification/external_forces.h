// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_external_forces_h
#define conetact_verification_external_forces_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/dof_share.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/model/increment_record.h"

#include <vector>

namespace conetact::verification
{
  /** Forces on one body that should balance, with their magnitudes. */
  struct Balance
  {
    model::Resultant sum;         ///< moment about the body's centre
    double           forces  = 0; ///< sum of magnitudes [force]
    double           moments = 0; ///< sum of |arm x force| and |moment|
    double           arms    = 0; ///< sum of |arm| |force| [force x length]
    double           largest = 0; ///< force on a node [force]
    double           largest_moment = 0; ///< on a node that rotates

    /** What moments are compared with. */
    double
    turning() const;
    /** The sum over the magnitudes, the larger of forces and moments. */
    double
    error() const;
  };

  /** Everything that acts on the bodies from outside, in space, at the
   * undeformed nodes in the frames of bodies. */
  struct ExternalForces
  {
    std::vector<Balance> bodies;
    std::vector<model::Resultant>
      contacts; ///< reactions on the bodies, by contact
    std::vector<model::Resultant> masters; ///< the same on their master bodies
    std::vector<model::Resultant>
                     supports; ///< of each support, with foundations
    model::Resultant loads;
    Eigen::VectorXd  held; ///< forces of rigid supports, dofs of this process
  };

  /** What acts on the bodies, and the dofs that this process looks after. */
  struct ActedOn
  {
    const model::Bodies          &bodies;
    const contact::Coordinates   &plain;
    const contact::ContactPoints &points;
    const contact::DofShare      &share;
  };

  /**
   * `rest`: forces K w - loads - foundations - contacts on the dofs of this
   * process, which supports hold; `foundations` act on the bodies; `loads` (all
   * dofs) without thermal ones, which cancel by themselves. All in space. All
   * processes of the team call this.
   */
  ExternalForces
  external_forces(const ActedOn                          &on,
                  const Eigen::VectorXd                  &rest,
                  const std::vector<contact::Foundation> &foundations,
                  const Eigen::VectorXd                  &loads,
                  const Eigen::VectorXd                  &r);

  /** The resultant of forces on all dofs, in space, about the origin. */
  model::Resultant
  resultant(const model::Bodies        &bodies,
            const contact::Coordinates &plain,
            const Eigen::VectorXd      &forces);
} // namespace conetact::verification

#endif
