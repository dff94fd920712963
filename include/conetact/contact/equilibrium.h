// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_equilibrium_h
#define conetact_contact_equilibrium_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/output/output.h"

namespace conetact
{
  /**
   * Judges displacements and reactions by the uncondensed equations of the
   * bodies, which know nothing of condensation or contact solvers.
   */
  struct Equilibrium
  {
    double residual      = 0;    ///< largest unbalanced nodal force, relative
    double largest_force = 0;    ///< largest nodal force of the state [force]
    Eigen::VectorXd unbalanced;  ///< in all unknowns [force]
    double          balance = 0; ///< sum of all forces and moments, relative

    std::vector<double> body_balance; ///< the same of each body

    std::vector<Resultant> contacts; ///< reactions on the bodies, by contact
    std::vector<Resultant> masters;  ///< the same on their master bodies
    Resultant              supports; ///< on the bodies, with foundations
    Resultant              loads;    ///< on the bodies
  };

  /**
   * `u`: all dofs; `r`: reactions of the contact unknowns; `loads`: nodal
   * forces on all dofs at time `t`; residuals are relative to the larger of
   * the largest nodal force and `reference_force`. Where both are below 1e-10
   * of the largest sum @f$|K|\,|u|@f$ of a node, the bodies move without force,
   * and residuals are relative to 1e-3 of that sum.
   */
  Equilibrium
  check_equilibrium(const Bodies          &bodies,
                    const ElasticSystem   &elastic,
                    const Coordinates     &coordinates,
                    const Eigen::VectorXd &u,
                    const Eigen::VectorXd &r,
                    const Eigen::VectorXd &loads,
                    const double           t,
                    const std::size_t      n_contacts,
                    const double           reference_force);

  /** Force on the body from the reactions of contact rule i. */
  Tensor<1, 3>
  reaction_vector(const Coordinates     &coordinates,
                  const std::size_t      i,
                  const Eigen::VectorXd &r);
} // namespace conetact

#endif
