// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_open_motions_h
#define conetact_contact_open_motions_h

#include "conetact/contact/contact_points.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/solvers/contact_problem.h"

namespace conetact::contact
{
  /**
   * Orthonormal combinations (columns) of the motions of null_space() that
   * contacts in such states do not oppose: no closed one along its normal, none
   * that sticks along its tangents.
   */
  Eigen::MatrixXd
  unopposed_motions(const RigidMotions                    &motions,
                    const ContactPoints                   &points,
                    const std::vector<solvers::NodeState> &states);

  /**
   * What is left open of the positions of bodies at the end of an increment,
   * and how they have the shortest way there: the least squares of all nodes.
   * Forces stay what they are: no contact that carries one moves along its
   * normal, nor along its tangents if there is friction. None that carries
   * nothing gets closer than touching.
   */
  class OpenMotions
  {
  public:
    /** `state` of all candidates; `largest_force` so far. */
    OpenMotions(const RigidMotions          &motions,
                const ContactPoints         &points,
                const solvers::ContactState &state,
                const double                 largest_force);

    bool
    exist() const
    {
      return open.cols() > 0;
    }
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
    Eigen::MatrixXd     rows; ///< normals of contacts that carry nothing
    Eigen::VectorXd     gap;  ///< of these
  };
} // namespace conetact::contact

#endif
