// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_open_motions_h
#define conetact_contact_open_motions_h

#include "conetact/contact/contact_points.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/solvers/contact_problem.h"

namespace conetact::contact
{
  /** Whether a normal reaction is the rounding of the largest force so far. */
  bool
  carries_nothing(const double reaction, const double largest_force);

  /** Whether what sticks with such friction may slip. */
  bool
  is_at_limit(const Eigen::VectorXd &friction, const double largest_friction);

  /**
   * What forces leave open of positions at the end of an increment, and how
   * bodies have the shortest way there: the least squares over all nodes, those
   * of a free obstacle counting as its reference point and its rim. All forces
   * stay what they are: what presses does not move along its normal, nor what
   * sticks along its tangents, and slips keep their directions. Contacts that
   * carry nothing may open, and close until they touch.
   */
  class OpenMotions
  {
  public:
    /** `state` of all candidates; `largest_force` so far; laws of the
     * increment, or none. */
    OpenMotions(const RigidMotions          &motions,
                const ContactPoints         &points,
                const solvers::ContactState &state,
                const double                 largest_force,
                const solvers::NodalLaws    *laws = nullptr);

    bool
    exist() const
    {
      return open.cols() > 0;
    }
    /** Free motions that lead to another solution nearby; empty: none do, as
     * what touches is in the way. */
    Eigen::VectorXd
    elsewhere() const;
    /**
     * Amounts of free motions that, added, make the way the shortest; empty: it
     * is. `way`: displacements of all dofs since the start of the increment, in
     * the frames of bodies.
     */
    Eigen::VectorXd
    shortening(const Eigen::VectorXd &way) const;

  private:
    const RigidMotions &motions;
    Eigen::MatrixXd     open; ///< free motions, orthonormal over all nodes
    Eigen::MatrixXd     rows; ///< what may become larger, and smaller by
    Eigen::VectorXd     room; ///< this: gaps and slips
    double              touching = 0; ///< a room that is none [length]
  };
} // namespace conetact::contact

#endif
