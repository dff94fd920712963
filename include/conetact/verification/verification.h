// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_verification_h
#define conetact_verification_verification_h

#include "conetact/base/archive.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/dof_share.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/verification/claim.h"
#include "conetact/verification/contact_law.h"
#include "conetact/verification/rounding_budget.h"

#include <vector>

namespace conetact::verification
{
  /**
   * The judge of increments and points of load paths, which shares nothing
   * with solvers but the definitions. External forces are the only scales: F_b
   * is the largest external force on a node of body b in this increment, that
   * of a contact the smaller one of its two sides. With the tolerance tol and
   * the rounding eps,
   * - every dof that nothing holds is in equilibrium up to
   *   @f$tol\,F_b + 8\,eps \sum_j |K_{ij}|\,|w_j|@f$;
   * - each body balances by itself, forces and moments, up to tol of the sum of
   *   their magnitudes;
   * - reactions lie in their cones and slip against them up to tol F;
   * - closed gaps are closed and stuck nodes stick up to
   *   @f$l = tol\,F/k + 16\,eps\,(|x| + |u|)@f$; what is bound stays where it
   *   is bound up to the same, with any reaction.
   * Forces of the past count as rounding only. So do those of supports and
   * contacts on a body without loads, if they are no more than its own forces
   * leave when they cancel: none larger than 64 eps of its largest thermal
   * nodal force, or where they do not balance, all of them together less than
   * @f$8\,eps \sum_i \sum_j |K_{ij}|\,|w_j|@f$.
   */
  class Verification
  {
  public:
    /** What is given must outlive the object. */
    Verification(const model::Bodies          &bodies,
                 const contact::ElasticSystem &elastic,
                 const contact::Coordinates   &plain,
                 const contact::RigidMotions  &motions,
                 const contact::ContactPoints &points,
                 const double                  tolerance);

    /**
     * Stiffness of the softer side of each candidate, and along each unknown
     * of what is bound [force/length], 0: not known.
     */
    void
    set_stiffness(const Eigen::VectorXd &of_candidates,
                  const Eigen::VectorXd &of_bound = {})
    {
      law.set_stiffness(of_candidates, of_bound);
    }
    /** Judges against the state that was accepted last. */
    Finding
    judge(const Claim &claim) const;
    /** Displacements of all dofs that were accepted last; empty: none yet. */
    const contact::SharedVector &
    accepted_displacements() const
    {
      return last.u;
    }
    /** Their time. */
    double
    accepted_time() const
    {
      return last.t;
    }
    /** What it found of a claim at time t becomes the state that the next one
     * is judged against. */
    void
    accept(const double t, const Finding &finding);

    /** What of it is kept in a checkpoint, and taken from one again. */
    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive);

  private:
    using Share = contact::DofShare;

    Scales
    scales(const Claim &claim, const Finding &out, const Share &share) const;
    /** Forces of contacts at the dofs of this process. */
    void
    subtract_reactions(const Eigen::VectorXd &r,
                       const Share           &share,
                       Eigen::VectorXd       &forces) const;
    /** R a + w in space. */
    contact::SharedVector
    displacements(const Claim &claim) const;
    /** What acts and what is left of it, at the dofs of this process. */
    Eigen::VectorXd
    find_rest(const Claim &claim, const Share &share, Finding &out) const;
    void
    collect_forces(const Claim     &claim,
                   const Share     &share,
                   Eigen::VectorXd &rest,
                   Finding         &out) const;
    /** The worst unbalanced force of a body. */
    struct Unbalanced
    {
      double       error = 0;
      unsigned int body  = 0;
    };
    Unbalanced
    worst_node(const Claim  &claim,
               const Scales &scales,
               const Share  &share,
               Finding      &out) const;
    void
    check_nodes(const Claim  &claim,
                const Scales &scales,
                const Share  &share,
                Finding      &out) const;
    void
    check_bodies(const Scales &scales, Finding &out) const;
    template <typename Points>
    Eigen::VectorXd
    relative_displacements(const Points          &of,
                           const Eigen::VectorXd &u,
                           const double           t) const;
    void
    find_changes(const double t, Finding &out) const;
    void
    remember_contacts();

    const model::Bodies          &bodies;
    const contact::ElasticSystem &elastic;
    const contact::Coordinates   &plain;
    const contact::RigidMotions  &motions;
    const contact::ContactPoints &points;
    double                        tolerance;
    RoundingBudget                budget;
    ContactLaw                    law;
    std::vector<double>           largest_force; ///< so far, of each body

    /** What was accepted last; empty: nothing yet. */
    struct Last
    {
      contact::SharedVector u; ///< of all dofs
      double                t = 0;
      /** Contacts as they were, where they slide far. */
      std::vector<pairing::ContactNode>  nodes;
      std::vector<contact::ContactPoint> points;
    };
    Last last;
  };
} // namespace conetact::verification

#endif
