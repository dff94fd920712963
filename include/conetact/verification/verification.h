// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_verification_h
#define conetact_verification_verification_h

#include "conetact/base/archive.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/rigid_motions.h"
#include "conetact/verification/external_forces.h"

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
    Eigen::VectorXd                 w;       ///< deformation, all dofs [length]
    Eigen::VectorXd                 r; ///< reactions of all contact unknowns
    std::vector<solvers::NodeState> states;     ///< of the candidates
    Eigen::VectorXd                 loads;      ///< nodal, all dofs [force]
    Eigen::VectorXd                 mechanical; ///< those without thermal ones
    double                          t     = 0;
    bool                            whole = true; ///< not solved in parts
    bool incremental                      = true; ///< law of the slip since
                                                  ///< before; else of all slip
  };

  /** What the verification finds of a claim. */
  struct Finding
  {
    double      residual    = 0; ///< worst error of the contact law, relative
    double      equilibrium = 0; ///< worst unbalanced force, relative
    std::string why; ///< it is not accepted, a sentence; empty: it is
    /** Of w alone: a rigid motion has none [force x length]. */
    double strain_energy = 0;

    Eigen::VectorXd u;      ///< displacements of all dofs, in space [length]
    Eigen::VectorXd acting; ///< loads and supports, in space [force]
    Eigen::VectorXd unbalanced;    ///< forces on all dofs [force]
    Eigen::VectorXd displacements; ///< of all contact unknowns, relative
    Eigen::VectorXd change;        ///< of them in this increment
    /** The same as contacts were at the end of the increment before. */
    Eigen::VectorXd     change_as_before;
    Eigen::VectorXd     missed_by_bound; ///< what is bound moved by [length]
    std::vector<double> largest_force;   ///< external, on a node, of each body
    /**
     * Of each body on which nothing acts from outside: the rounding of forces
     * on its nodes, which are no more than that and count as 0; of others 0.
     */
    std::vector<double> rounding;
    /** Rounding of forces where springs of supports carry bodies along, at all
     * dofs; empty where none does. */
    Eigen::VectorXd carried;
    Eigen::VectorXd r; ///< reactions, 0 where they are this rounding
    ExternalForces  external;
    std::vector<contact::Foundation> foundations; ///< by support
  };

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
    Verification(const contact::Bodies        &bodies,
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
      stiffness       = of_candidates;
      bound_stiffness = of_bound;
    }
    /** Judges against the state that was accepted last. */
    Finding
    judge(const Claim &claim) const;
    /** Displacements of all dofs that were accepted last; empty: none yet. */
    const Eigen::VectorXd &
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
    struct Scales;
    Eigen::VectorXd
    rounding_of_springs(const Finding &out) const;
    Eigen::VectorXd
    rounding_of_supports(const double t) const;
    /** Ways of bodies that are no less than such displacements of all dofs. */
    void
    lengthen(std::vector<double> &ways, const Eigen::VectorXd &u) const;
    /** Forces that it takes to round such ways of bodies, of all dofs. */
    Eigen::VectorXd
    rounding_of_ways(const std::vector<double> &ways) const;
    Scales
    scales(const Claim &claim, const Finding &out) const;
    double
    rounding_of(const unsigned int     body,
                const Claim           &claim,
                const Balance         &balance,
                const Eigen::VectorXd &carried,
                Eigen::VectorXd       &rounding) const;
    bool
    find_rounding(const Claim &claim, Finding &out) const;
    void
    forget_rounding(Eigen::VectorXd &rest, Finding &out) const;
    void
    check_nodes(const Claim &claim, const Scales &scales, Finding &out) const;
    void
    check_bodies(const Scales &scales, Finding &out) const;
    struct LawErrors;
    LawErrors
    law_errors(const std::size_t point,
               const Claim      &claim,
               const Scales     &scales,
               const Finding    &out) const;
    LawErrors
    errors_of(const pairing::ContactNode &node,
              const double                k,
              const Scales               &scales) const;
    LawErrors
    bound_errors(const contact::ContactPoint &point,
                 const Scales                &scales,
                 const Finding               &out) const;
    void
    check_bound_forces(const Claim &claim, Finding &out) const;
    void
    check_law(const Claim &claim, const Scales &scales, Finding &out) const;
    template <typename Points>
    Eigen::VectorXd
    relative_displacements(const Points          &of,
                           const Eigen::VectorXd &u,
                           const double           t) const;
    void
    find_changes(const double t, Finding &out) const;
    void
    remember_contacts();

    const contact::Bodies        &bodies;
    const contact::ElasticSystem &elastic;
    const contact::Coordinates   &plain;
    const contact::RigidMotions  &motions;
    const contact::ContactPoints &points;
    double                        tolerance;
    /** The largest so far, of each body. */
    struct Past
    {
      std::vector<double> force;
      std::vector<double> on_springs, on_supports; ///< prescribed ways

      explicit Past(const std::size_t n_bodies)
        : force(n_bodies, 0.)
        , on_springs(force)
        , on_supports(force)
      {}
    };
    Past            past;
    Eigen::VectorXd stiffness, bound_stiffness;

    /** What was accepted last; empty: nothing yet. */
    struct Last
    {
      Eigen::VectorXd u; ///< of all dofs
      double          t = 0;
      /** Contacts as they were, where they slide far. */
      std::vector<pairing::ContactNode>  nodes;
      std::vector<contact::ContactPoint> points;
    };
    Last last;
  };
} // namespace conetact::verification

#endif
