// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_elasticity_h
#define conetact_contact_elasticity_h

#include "conetact/condensed/condenser.h"
#include "conetact/contact/bound_contacts.h"
#include "conetact/contact/elastic_states.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace conetact::contact
{
  /** How far two condensers agree on a stiffness. */
  struct StiffnessDifference
  {
    std::vector<unsigned int> bodies;       ///< whose stiffness it is
    double                    relative = 0; ///< to its largest entry [-]
  };

  /** A reference force over the largest force so far: to a tolerance of 1e-10
   * of this, what is left of it is rounding. */
  constexpr double rounding_of_past = 1e-4;

  /** Forces that the tolerances of a problem are measured by. */
  struct ForceScale
  {
    double largest;       ///< that the load is for contacts [force]
    double reference = 0; ///< whose rounding the problem may leave [force]
  };

  /** What a solution leaves, as the verification finds it. */
  struct Unbalanced
  {
    Eigen::VectorXd forces; ///< on all dofs: K w less all that acts
    /** By how much contact unknowns, and what is bound, are elsewhere than they
     * should; none: nothing is missed. */
    Eigen::VectorXd by_contacts, by_bound;
    /** What the solution moves bodies by beyond what the problem is written
     * about, and deforms them by; none: it is not known. */
    Eigen::VectorXd motions, w;
  };

  /** Work that an Elasticity was made by, for the log. */
  struct ElasticReport
  {
    std::string  description;
    double       factor_bytes    = 0; ///< 0: no factor, or it is not known
    unsigned int n_shared_bodies = 0; ///< for which an equal one is condensed
    condensed::SchurWork work;        ///< with the factors so far
  };

  /**
   * The elastic answer of all bodies to the nodes that may touch, whichever way
   * it comes about (elasticity_row.h). Displacements are the deformation w of
   * RigidMotions. What is primal is p of the solver's linear relation: elastic
   * displacements of the contact unknowns in stiffness form, reactions and free
   * motions in compliance form, own numbers of a large system.
   */
  class Elasticity
  {
  public:
    virtual ~Elasticity() = default;

    /** The relation of contact unknowns, cones, motions without resistance. */
    const std::shared_ptr<const solvers::ContactSystem> &
    system() const
    {
      return contact_system;
    }

    /**
     * Nodal `forces` on all dofs and the prescribed deformation. A load case
     * that is a linear combination of earlier ones costs no solve.
     */
    LoadCase
    reduce(const Eigen::VectorXd &forces, const Eigen::VectorXd &prescribed);
    /** The same with forces of heat, or none, which balance by themselves. */
    virtual LoadCase
    reduce(const Eigen::VectorXd &forces,
           const Eigen::VectorXd &heat,
           const Eigen::VectorXd &prescribed);
    /** Load cases that were reduced by the solver. */
    unsigned int
    n_reductions() const
    {
      return n_reduced;
    }

    /** Deformation of all dofs for each load case and its primal; all processes
     * call this. */
    virtual std::vector<Eigen::VectorXd>
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const = 0;

    /** Load and offset of a problem; `offset` moves contacts without strain. */
    virtual void
    write(const LoadCase          &load,
          const Eigen::VectorXd   &offset,
          const ElasticState      &state,
          solvers::ContactProblem &problem) const = 0;
    virtual ForceScale
    force_scale(const LoadCase &load) const = 0;
    /** Forces on contact unknowns that drive rigid motions as its load does. */
    virtual Eigen::VectorXd
    contact_load(const solvers::ContactProblem &problem) const = 0;

    const ElasticStates &
    states() const
    {
      return *own_states;
    }
    /** Ties and bilateral contacts. */
    virtual const BoundContacts &
    bound() const;

    /**
     * Iterative refinement: the change of a load case that takes away what is
     * left, nothing where a problem that is written anew does so; and the
     * change of the deformation while the primal unknowns change by `primal`.
     */
    virtual LoadCase
    reduce_unbalanced(const Unbalanced &left) const = 0;
    virtual Eigen::VectorXd
    correction(const LoadCase &change, const Eigen::VectorXd &primal) const = 0;

    /** What is another one than before, of the same bodies. */
    enum class Changed
    {
      contacts, ///< were found again: other rows
      motions   ///< a cut was locked: fewer are free
    };
    /** Takes it over, nothing is factorised. False: it must be made anew. */
    virtual bool
    relink(const Changed /*what*/)
    {
      return true;
    }

    virtual ElasticReport
    report() const = 0;
    /**
     * Condenses all bodies once more by another condenser and compares:
     * largest difference of an entry over the largest entry, body by body.
     */
    virtual std::vector<StiffnessDifference>
    compare(const condensed::Condenser & /*other*/) const
    {
      return {};
    }

  protected:
    /** Fills b, f and q of one load case. */
    virtual void
    reduce_one(const Eigen::VectorXd &forces,
               const Eigen::VectorXd &prescribed,
               LoadCase              &load) = 0;
    /** The same without anything that acts. */
    virtual LoadCase
    nothing() const = 0;
    /** What was reduced does not hold any more. */
    void
    forget_reductions()
    {
      basis.clear();
    }

    std::shared_ptr<const solvers::ContactSystem> contact_system;
    std::unique_ptr<const ElasticStates>          own_states;
    /** Makes prescribed displacements as large as forces. */
    double stiffness_scale = 1;

  private:
    /** An orthonormal basis of load cases, and what they reduce to. */
    struct Known
    {
      Eigen::VectorXd direction; ///< (forces, stiffness_scale x prescribed)
      LoadCase        load;
    };
    std::vector<Known> basis;
    unsigned int       n_reduced = 0;
  };

  /** The shortest of all forces with these resultants along a null space. */
  Eigen::VectorXd
  shortest_load(const Eigen::MatrixXd &null_space,
                const Eigen::VectorXd &resultants);
} // namespace conetact::contact

#endif
