// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_condensed_stiffness_h
#define conetact_contact_condensed_stiffness_h

#include "conetact/contact/condensed_bodies.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/rigid_motions.h"

namespace conetact::contact
{
  /**
   * Bodies that supports hold and that meet obstacles only, each node in one
   * contact: what they are condensed to is the stiffness of the contact
   * unknowns, [K] section 4, @f$ K q_C = r + f @f$, without any inverse. It
   * serves all loads of all increments. Also bodies that nothing may touch.
   */
  class CondensedStiffness : public Elasticity
  {
  public:
    /**
     * Looks for motions without strain besides rigid ones with
     * `find_mechanisms`. `coordinates` are those of the bodies without
     * contacts; references must outlive the object. Throws SingularMatrix if a
     * body can move although its contact nodes are fixed.
     */
    CondensedStiffness(const ElasticSystem        &elastic,
                       const ContactPoints        &points,
                       const Coordinates          &coordinates,
                       const RigidMotions         &motions,
                       const bool                  find_mechanisms,
                       const condensed::Condenser &condenser);

    /** What its factorisation would take. */
    static condensed::FactorEstimate
    estimate(const ElasticSystem        &elastic,
             const ContactPoints        &points,
             const Coordinates          &coordinates,
             const condensed::Condenser &condenser);

    std::vector<Eigen::VectorXd>
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const override;
    void
    write(const LoadCase          &load,
          const Eigen::VectorXd   &offset,
          const ElasticState      &state,
          solvers::ContactProblem &problem) const override;
    ForceScale
    force_scale(const LoadCase &load) const override
    {
      return {solvers::largest(load.f)};
    }
    /** In stiffness form f has forces along contact unknowns already. */
    Eigen::VectorXd
    contact_load(const solvers::ContactProblem &problem) const override
    {
      return problem.load;
    }
    LoadCase
    reduce_unbalanced(const Unbalanced &left) const override;
    Eigen::VectorXd
    correction(const LoadCase        &change,
               const Eigen::VectorXd &primal) const override;
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

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;

  private:
    /** Whether nothing may touch: load cases are solved, not reduced. */
    bool
    is_linear() const
    {
      return own_unknown.empty();
    }
    Eigen::MatrixXd
    take_stiffness();
    Eigen::VectorXd
    reduce_forces(const Eigen::VectorXd &b) const;
    /** Own unknowns under forces (columns) and displacements of contact
     * unknowns. */
    Eigen::MatrixXd
    carry(const Eigen::MatrixXd &b, const Eigen::MatrixXd &contact) const;

    const ElasticSystem  &elastic;
    const BodyCoordinates own;
    /** The number of each contact unknown among own unknowns. */
    const std::vector<CondensedBodies::Index> own_unknown;
    CondensedBodies                           bodies;
  };
} // namespace conetact::contact

#endif
