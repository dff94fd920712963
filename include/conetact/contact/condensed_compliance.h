// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensed_compliance_h
#define conetact_contact_condensed_compliance_h

#include "conetact/contact/bound_unknowns.h"
#include "conetact/contact/condensed_elasticity.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/free_motions.h"
#include "conetact/contact/rigid_motions.h"

#include <Eigen/SparseCore>

#include <vector>

namespace conetact::contact
{
  /**
   * Bodies that condense themselves, and contacts as rows H over them:
   * @f[ v = W r + G a + q,\quad W = \sum_b H_b P_b H_b^T,\quad G = H R, @f]
   * with the balance of each free motion as an equation of its own (compliance
   * form of ContactProblem). Flexibilities of stiff and soft bodies just add:
   * no digits are lost where stiffnesses differ, nor where bodies float or move
   * far. Equal bodies share a SuperElement. Foundations K_s are part of a
   * body's stiffness; against its free motions they act as
   * @f[ Y = -P K_s R,\quad G = H (R + Y),\quad
   *     C = R^T K_s R + R^T K_s Y . @f]
   * Ties and bilateral contacts are rows as well, behind those of contacts, and
   * eliminated before anyone asks for the system (BoundUnknowns).
   * The form of FETI methods with friction (Dostal, Kozubek, Horyl, Brzobohaty,
   * Markopoulos, Comput. Struct. 2012).
   */
  class CondensedCompliance : public CondensedElasticity
  {
  public:
    /**
     * `coordinates` are those of the bodies without contacts. Throws
     * SingularMatrix. All must outlive the object.
     */
    CondensedCompliance(const ElasticSystem        &elastic,
                        const ContactPoints        &points,
                        const Coordinates          &coordinates,
                        const RigidMotions         &motions,
                        const condensed::Condenser &condenser);

    using Elasticity::reduce;
    LoadCase
    reduce(const Eigen::VectorXd &forces,
           const Eigen::VectorXd &heat,
           const Eigen::VectorXd &prescribed) override;
    std::vector<Eigen::VectorXd>
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const override;
    void
    write(const LoadCase          &load,
          const Eigen::VectorXd   &offset,
          const ElasticState      &state,
          solvers::ContactProblem &problem) const override;
    double
    largest_force(const LoadCase &load) const override;
    double
    reference_force(const LoadCase &load) const override;
    Eigen::VectorXd
    contact_load(const solvers::ContactProblem &problem) const override;
    void
    begin(const ElasticState    &state,
          solvers::ContactState &start) const override;
    void
    end(const solvers::ContactState &end, ElasticState &state) const override;
    Eigen::VectorXd
    primal(const ElasticState &state, const Eigen::VectorXd &r) const override;
    void
    move(const Eigen::VectorXd &amounts,
         const Eigen::VectorXd &seen,
         solvers::ContactState &end) const override;
    void
    restore(const std::vector<double> &start,
            const Eigen::VectorXd     &q,
            ElasticState              &state) const override;
    LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
    void
    add_missed(const Eigen::VectorXd &by_contacts,
               const Eigen::VectorXd &by_bound,
               LoadCase              &change) const override;
    solvers::ContactState
    restart(const solvers::ContactState &start,
            const solvers::ContactState &end) const override;
    void
    move_bound(const Eigen::VectorXd &offset, LoadCase &load) const override;
    BoundState
    bound_state(const LoadCase        &load,
                const Eigen::VectorXd &primal) const override;
    Eigen::VectorXd
    bound_stiffness() const override
    {
      return stiffness_of_bound;
    }
    const RedundantRows *
    redundant_rows() const override
    {
      return &bound.redundant_rows();
    }
    bool
    relink() override;
    bool
    see_motions() override;

    /** What the factorisations would take; nothing is factorised. */
    static condensed::FactorEstimate
    estimate(const ElasticSystem        &elastic,
             const ContactPoints        &points,
             const Coordinates          &coordinates,
             const RigidMotions         &motions,
             const condensed::Condenser &condenser);

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;
    const CondensedBodies &
    condensed_bodies() const override
    {
      return bodies;
    }

  private:
    using Index    = Eigen::Index;
    using VectorXd = Eigen::VectorXd;
    using MatrixXd = Eigen::MatrixXd;

    /** H of all contact points. */
    Eigen::SparseMatrix<double>
    rows() const;
    void
    write_row(const ContactPoint                  &point,
              Index                               &row,
              std::vector<Eigen::Triplet<double>> &entries) const;
    MatrixXd
    assemble_all() const;
    void
    assemble_system();
    /** Splits a load of all rows and motions into those that the system and
     * what is bound see. */
    void
    set_load(const VectorXd &all, LoadCase &load) const;
    VectorXd
    reduce_all(const VectorXd &b, const VectorXd &forces) const;
    VectorXd
    moved_rows(const VectorXd &u) const;
    /** Reactions of all rows and all own motions. */
    VectorXd
    all_of(const LoadCase &load, const VectorXd &primal) const;
    Index
    n_contact() const
    {
      return points.layout().n_unknowns();
    }
    MatrixXd
    flexibility() const;
    /** Deformations of all own unknowns under forces on them (columns). */
    MatrixXd
    deform(const MatrixXd &forces) const;
    /**
     * A load whose parts cancel against a free motion leaves their rounding,
     * which must not drive a body that nothing holds.
     */
    void
    forget_rounding(LoadCase &load) const;
    /** Takes out of the system the motions that neither foundations resist nor
     * contacts see, and remembers them. */
    void
    forget_unseen_motions(solvers::ContactSystem &system);
    /** Takes motions that nothing resists out of imbalances. */
    VectorXd
    without_unseen(const VectorXd &imbalance) const;
    /** Forces on own unknowns of reactions and free motions. */
    VectorXd
    forces_of(const VectorXd &primal) const;

    struct Empty
    {};
    /** Without factors, for an estimate. */
    CondensedCompliance(const ElasticSystem        &elastic,
                        const ContactPoints        &points,
                        const Coordinates          &coordinates,
                        const RigidMotions         &motions,
                        const condensed::Condenser &condenser,
                        const Empty);

    const ElasticSystem        &elastic;
    const ContactPoints        &points;
    const Coordinates          &coordinates;
    const RigidMotions         &motions;
    BodyCoordinates             own;
    Eigen::SparseMatrix<double> H; ///< of own unknowns
    CondensedBodies             bodies;
    FreeMotions                 free;
    BoundUnknowns               bound;
    VectorXd                    stiffness_of_bound;
    MatrixXd                    unseen; ///< motions, orthonormal
  };
} // namespace conetact::contact

#endif
