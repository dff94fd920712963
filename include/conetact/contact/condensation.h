// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensation_h
#define conetact_contact_condensation_h

#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/extended_schur.h"
#include "conetact/contact/substructures.h"
#include "conetact/contact/working_set.h"

#include <memory>
#include <vector>

namespace conetact
{
  /**
   * The elastic system condensed to the contact unknowns of a working set, [K]
   * section 4: one factorisation gives @f$ K q_C = r + f @f$ and serves all
   * loads of all increments. Vectors of contact unknowns are those of the set.
   */
  class Condensation
  {
  public:
    /**
     * `null_space`: rigid motions in the unknowns of all candidates; with
     * `find_mechanisms` other motions without strain are looked for besides.
     * Throws SingularMatrix if a body can move although the contact nodes of
     * the set are fixed.
     */
    Condensation(const ElasticSystem   &elastic,
                 const Coordinates     &coordinates,
                 const WorkingSet      &set,
                 const Eigen::MatrixXd &null_space,
                 const bool             find_mechanisms);

    const WorkingSet &
    working_set() const
    {
      return set;
    }

    /**
     * Adds candidates to the set with the factor at hand: system() is another
     * one then, and load cases must be reduced again, at no cost.
     */
    void
    extend(const std::vector<Eigen::Index> &nodes,
           const Eigen::MatrixXd           &null_space);

    /**
     * Whether adding `n_new` unknowns is cheaper than condensing anew with
     * them: three triangular solves for each, which run at half the speed of
     * the factorisation.
     */
    bool
    extension_is_cheaper(const Eigen::Index n_new) const;

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
      Eigen::VectorXd b; ///< C^T (f - K (d + C q)), all unknowns [force]
      Eigen::VectorXd f; ///< condensed, contact unknowns [force]
      /**
       * Known displacements of all unknowns [length]: of bodies that supports
       * carry along; where nothing may touch, those of the load.
       */
      Eigen::VectorXd q;
    };
    /**
     * `forces` are nodal forces on all dofs, `prescribed` is d(t). A load case
     * that is a linear combination of earlier ones costs no solve, nor do
     * supports that move bodies without strain.
     */
    Load
    reduce(const Eigen::VectorXd &forces, const Eigen::VectorXd &prescribed);

    /**
     * Displacements of all dofs, a column for each load case and its contact
     * unknowns.
     */
    Eigen::MatrixXd
    expand(const std::vector<const Load *>    &loads,
           const std::vector<Eigen::VectorXd> &contact) const;

    /**
     * Iterative refinement: the part of unbalanced forces that the contact
     * unknowns see, and the change of all displacements that takes them away
     * while the contact unknowns change by `contact`.
     */
    Eigen::VectorXd
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const;
    Eigen::VectorXd
    correction(const Eigen::VectorXd &unbalanced,
               const Eigen::VectorXd &contact) const;

    /** Load cases that were reduced by the solver. */
    unsigned int
    n_reductions() const
    {
      return n_reduced;
    }

    double
    factor_bytes() const
    {
      return solver->base().factor_bytes();
    }

    /** Bodies for which an equal one is condensed. */
    unsigned int
    n_shared_bodies() const
    {
      return solver->base().n_shared();
    }

    /** Work with the factors so far. */
    SchurWork
    work() const
    {
      return solver->base().work();
    }

  private:
    /** Whether nothing may touch: load cases are solved, not reduced. */
    bool
    is_linear() const;
    /** Adds b, f and q of these forces and prescribed displacements. */
    void
    add_case(const Eigen::VectorXd &forces,
             const Eigen::VectorXd &prescribed,
             Load                  &load);
    /** Of all unknowns, those of the set. */
    Eigen::VectorXd
    contact_part(const Eigen::VectorXd &q) const;
    /** K times the contact unknowns among q. */
    Eigen::VectorXd
    contact_forces(const Eigen::VectorXd &q) const;
    /** Displacements of the unknowns [length], in a linear system. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &b) const;
    /** Rows in the order of the solver, and back. */
    Eigen::MatrixXd
    to_solver(Eigen::MatrixXd b) const;
    Eigen::MatrixXd
    from_solver(Eigen::MatrixXd b) const;
    Eigen::MatrixXd
    expand_unknowns(Eigen::MatrixXd        b,
                    const Eigen::MatrixXd &contact,
                    const Eigen::MatrixXd &reduced) const;

    const ElasticSystem                 &elastic;
    const Coordinates                   &coordinates;
    WorkingSet                           set;
    std::unique_ptr<ExtendedSchur>       solver;
    std::shared_ptr<const ContactSystem> contact_system;

    double stiffness_scale;
    Places place; ///< of unknowns in the solver, those of the set last

    /**
     * What is known of load cases: an orthonormal basis of those seen,
     * (forces, stiffness_scale x prescribed displacements), and what they
     * reduce to.
     */
    std::vector<Eigen::VectorXd> basis, basis_b, basis_f, basis_q;
    unsigned int                 n_reduced = 0;
  };

  /** What the factorisation of a condensation will take. */
  FactorEstimate
  estimate_condensation(const ElasticSystem &elastic,
                        const Coordinates   &coordinates,
                        const WorkingSet    &set);
} // namespace conetact

#endif
