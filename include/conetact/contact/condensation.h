// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensation_h
#define conetact_contact_condensation_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/schur_solver.h"

#include <memory>

namespace conetact
{
  /**
   * The elastic system condensed to its contact unknowns, [K] section 4: one
   * factorisation gives @f$ K q_C = r + f @f$ and serves all loads of all
   * increments.
   */
  class Condensation
  {
  public:
    /**
     * `null_space`: rigid motions in the contact unknowns. Throws
     * SingularMatrix if a body can move although its contact nodes are fixed.
     */
    Condensation(const ElasticSystem   &elastic,
                 const Coordinates     &coordinates,
                 const Eigen::MatrixXd &null_space);

    /** K, its cones and its null space. */
    const std::shared_ptr<const ContactSystem> &
    system() const
    {
      return contact_system;
    }

    /** A load case, seen by the contact unknowns. */
    struct Load
    {
      Eigen::VectorXd prescribed; ///< d, all dofs [length]
      Eigen::VectorXd b;          ///< C^T (f - K d), all unknowns [force]
      Eigen::VectorXd f;          ///< condensed, contact unknowns [force]
    };
    /** `forces` are nodal forces on all dofs, `prescribed` is d(t). */
    Load
    reduce(const Eigen::VectorXd &forces,
           const Eigen::VectorXd &prescribed) const;

    /** Displacements of all dofs from those of the contact unknowns. */
    Eigen::VectorXd
    expand(const Load &load, const Eigen::VectorXd &contact) const;

    double
    factor_bytes() const
    {
      return solver->factor_bytes();
    }

  private:
    const ElasticSystem                 &elastic;
    const Coordinates                   &coordinates;
    std::unique_ptr<SchurSolver>         solver;
    std::shared_ptr<const ContactSystem> contact_system;
  };
} // namespace conetact

#endif
