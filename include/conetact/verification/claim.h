// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_claim_h
#define conetact_verification_claim_h

#include "conetact/contact/elastic_system.h"
#include "conetact/contact/increment_laws.h"
#include "conetact/contact/shared_vector.h"
#include "conetact/verification/external_forces.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace conetact::verification
{
  /**
   * What an increment claims: displacements R a + w and reactions. Loads and
   * displacements are components in the frames of bodies (contact::Bodies).
   */
  struct Claim
  {
    Eigen::VectorXd                 amounts; ///< of all rigid motions
    contact::SharedVector           w;       ///< deformation, all dofs [length]
    Eigen::VectorXd                 r; ///< reactions of all contact unknowns
    std::vector<solvers::NodeState> states;     ///< of the candidates
    contact::SharedVector           loads;      ///< nodal, all dofs [force]
    contact::SharedVector           mechanical; ///< those without thermal ones
    /** Laws of contacts that have some, and where these stand as far as it is
     * known at the start of the increment; else none. */
    std::shared_ptr<const contact::IncrementLaws> laws;
    Eigen::VectorXd worn; ///< depth of each candidate there; with laws [length]
    double          t           = 0;
    bool            whole       = true; ///< not solved in parts
    bool            incremental = true; ///< law of the slip since
                                        ///< before; else of all slip
  };

  /** What the verification finds of a claim. */
  struct Finding
  {
    double      residual    = 0; ///< worst error of the contact law, relative
    double      equilibrium = 0; ///< worst unbalanced force, relative
    std::string why; ///< it is not accepted, a sentence; empty: it is
    /** The energy of w alone: a rigid motion has none [force x length]. */
    double strain_energy = 0;

    contact::SharedVector u; ///< displacements of all dofs, in space [length]
    /** Loads and supports, in space, and forces that are left, at the dofs of
     * this process (contact::DofShare) [force]. */
    Eigen::VectorXd acting, unbalanced;
    Eigen::VectorXd displacements; ///< of all contact unknowns, relative
    Eigen::VectorXd change;        ///< of them in this increment
    /** The same as contacts were at the end of the increment before. */
    Eigen::VectorXd     change_as_before;
    Eigen::VectorXd     missed_by_bound; ///< what is bound moved by [length]
    std::vector<double> largest_force;   ///< external, on a node, of each body
    /** The rounding of forces on the nodes of each body on which nothing acts
     * from outside: they are no more than that and count as 0; of others 0. */
    std::vector<double> rounding;
    /** Rounding of forces where springs of supports carry bodies along, at all
     * dofs; empty where none does. */
    Eigen::VectorXd carried;
    Eigen::VectorXd r; ///< reactions, 0 where they are this rounding
    ExternalForces  external;
    std::vector<contact::Foundation> foundations; ///< by support
  };
} // namespace conetact::verification

#endif
