// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensation_h
#define conetact_contact_condensation_h

#include "conetact/backends/extended_schur.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_backend.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/working_set.h"

#include <memory>
#include <vector>

namespace conetact::contact
{
  /** Places of unknowns; empty: as they are. */
  using Places = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic>;

  /**
   * The elastic system condensed to the contact unknowns of a working set, [K]
   * section 4: one factorisation gives @f$ K q_C = r + f @f$ and serves all
   * loads of all increments. Vectors of contact unknowns are those of the set.
   */
  class Condensation : public ElasticBackend
  {
  public:
    /**
     * `null_space`: rigid motions in the unknowns of all candidates; with
     * `find_mechanisms` other motions without strain are looked for besides.
     * Throws SingularMatrix if a body can move although the contact nodes of
     * the set are fixed.
     */
    Condensation(const ElasticSystem       &elastic,
                 const NodeRules           &supports,
                 const ContactPoints       &points,
                 const WorkingSet          &set,
                 const Eigen::MatrixXd     &null_space,
                 const bool                 find_mechanisms,
                 const backends::Condenser &condenser);

    Eigen::MatrixXd
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const override;
    LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
    /**
     * With the factor at hand, where that is cheaper. system() is another one
     * then, and load cases must be reduced again, at no cost.
     */
    bool
    extend(const std::vector<Eigen::Index> &nodes) override;

    double
    factor_bytes() const override
    {
      return solver->base().factor_bytes();
    }
    backends::SchurWork
    work() const override
    {
      return solver->base().work();
    }
    std::vector<StiffnessDifference>
    compare(const backends::Condenser &other) const override;

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;
    Eigen::VectorXd
    reduce_forces(const Eigen::VectorXd &b) const override;

  private:
    /** Whether nothing may touch: load cases are solved, not reduced. */
    bool
    is_linear() const;
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

    const ElasticSystem                     &elastic;
    const ContactPoints                     &points;
    const Coordinates                        coordinates;
    std::unique_ptr<backends::ExtendedSchur> solver;

    Eigen::MatrixXd rigid; ///< null space in the unknowns of all candidates
    Places          place; ///< of unknowns in the solver, those of the set last
  };

  /** What the factorisation of a condensation will take. */
  backends::FactorEstimate
  estimate_condensation(const ElasticSystem       &elastic,
                        const NodeRules           &supports,
                        const ContactPoints       &points,
                        const WorkingSet          &set,
                        const backends::Condenser &condenser);
} // namespace conetact::contact

#endif
