// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensed_compliance_h
#define conetact_contact_condensed_compliance_h

#include "conetact/contact/body_rows.h"
#include "conetact/contact/condensed_bound.h"
#include "conetact/contact/free_motions.h"

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
   * eliminated before anyone asks for the system (CondensedBound).
   * The form of FETI methods with friction (Dostal, Kozubek, Horyl, Brzobohaty,
   * Markopoulos, Comput. Struct. 2012).
   */
  class CondensedCompliance : public Elasticity
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
    ForceScale
    force_scale(const LoadCase &load) const override;
    Eigen::VectorXd
    contact_load(const solvers::ContactProblem &problem) const override;
    const BoundContacts &
    bound() const override
    {
      return eliminated;
    }
    LoadCase
    reduce_unbalanced(const Unbalanced &left) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
    bool
    relink(const Changed what) override;
    ElasticReport
    report() const override
    {
      return bodies.report();
    }
    std::vector<StiffnessDifference>
    compare(const condensed::Condenser &other) const override
    {
      return bodies.compare(other);
    }

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

  private:
    using Index    = Eigen::Index;
    using VectorXd = Eigen::VectorXd;
    using MatrixXd = Eigen::MatrixXd;

    MatrixXd
    assemble_all() const;
    void
    assemble_system();
    VectorXd
    reduce_all(const VectorXd &b, const VectorXd &forces) const;
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

    const ElasticSystem &elastic;
    const ContactPoints &points;
    const Coordinates   &coordinates;
    const RigidMotions  &motions;
    BodyCoordinates      own;
    BodyRows             rows;
    CondensedBodies      bodies;
    FreeMotions          free;
    CondensedBound       eliminated;
    MatrixXd             unseen; ///< motions, orthonormal
  };

  /** Of each body: how many unknowns its nodes have that meet something. All of
   * them are retained, and a dense flexibility is made of them. */
  std::vector<double>
  unknowns_of_flexibilities(const model::Bodies &bodies,
                            const ContactPoints &points);
} // namespace conetact::contact

#endif
