// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_iterative_elasticity_h
#define conetact_contact_iterative_elasticity_h

#include "conetact/contact/elasticity.h"
#include "conetact/contact/large_bound.h"

namespace conetact::contact
{
  /**
   * The elastic system with all its unknowns, for solvers of LargeSystem: what
   * is too large to be condensed. Loads and what is primal are a process's own
   * numbers of LargeUnknowns.
   */
  class IterativeElasticity : public Elasticity
  {
  public:
    /** Arguments must outlive the object. */
    IterativeElasticity(const ElasticSystem            &elastic,
                        const NodeRules                &supports,
                        const ContactPoints            &points,
                        const RigidMotions             &motions,
                        const iterative::Preconditioner preconditioner);

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
      return following;
    }
    LoadCase
    reduce_unbalanced(const Unbalanced &left) const override;
    Eigen::VectorXd
    correction(const LoadCase &, const Eigen::VectorXd &primal) const override
    {
      return unknowns.field(primal);
    }
    /** Gaps alone may change, and no node may turn or face others. What opened
     * a tie was an unknown. */
    bool
    relink(const Changed what) override
    {
      return what == Changed::contacts && describe_contacts() == contacts;
    }
    ElasticReport
    report() const override
    {
      return {"stiffness of all unknowns, levels of multigrid", 0, 0, {}};
    }

  protected:
    void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) override;
    LoadCase
    nothing() const override;

  private:
    /** Directions of contact nodes in the frames of both sides, and weights of
     * their masters: numbers one behind the other. */
    std::vector<double>
    describe_contacts() const;

    const ElasticSystem      &elastic;
    const ContactPoints      &points;
    const RigidMotions       &motions;
    const LargeUnknowns       unknowns;
    const LargeBound          following; ///< what it faces
    const std::vector<double> contacts;  ///< as they were when it was made
  };
} // namespace conetact::contact

#endif
