// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_elasticity_h
#define conetact_contact_elasticity_h

#include "conetact/condensed/condenser.h"
#include "conetact/contact/increment_laws.h"
#include "conetact/contact/redundant_rows.h"
#include "conetact/contact/shared_vector.h"
#include "conetact/solvers/contact_problem.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace conetact::contact
{
  /** A load case, seen by the contact unknowns. */
  struct LoadCase
  {
    Eigen::VectorXd prescribed; ///< deformation that supports give, all dofs;
                                ///< empty: none [length]
    bool
    deforms() const
    {
      return prescribed.size() > 0;
    }
    /** Its forces on the elastic unknowns [force]; of a large system f has
     * them. */
    Eigen::VectorXd b;
    /**
     * Load of a ContactProblem in total terms: f [force] in stiffness form, q
     * [length] and -b [force] in compliance form.
     */
    Eigen::VectorXd f;
    /** Elastic displacements, where nothing may touch [length]. */
    Eigen::VectorXd q;
    /** What ties and bilateral contacts see of it, as BoundUnknowns has it. */
    Eigen::VectorXd bound;
    /**
     * What moves all contact unknowns without strain: placements of bodies by
     * their supports less the motion of obstacles [length].
     */
    Eigen::VectorXd offset;
    Eigen::VectorXd placement; ///< amounts of RigidMotions
    /** Laws of contacts that have some of their own; else none. */
    std::shared_ptr<const IncrementLaws> laws;
  };

  /** Ties and bilateral contacts, which solvers do not see. */
  struct BoundState
  {
    Eigen::VectorXd r;      ///< their reactions [force]
    Eigen::VectorXd motion; ///< rigid motions that they resist, amounts of the
                            ///< bodies' own ones [length]
  };

  /** How far two condensers agree on a stiffness. */
  struct StiffnessDifference
  {
    std::vector<unsigned int> bodies;       ///< whose stiffness it is
    double                    relative = 0; ///< to its largest entry [-]
  };

  /** Where bodies are between increments: a value. */
  struct ElasticState
  {
    /** Elastic displacements that solvers start from, in the unknowns of the
     * Elasticity that wrote them [length]; none: nothing is strained. */
    SharedVector    start;
    Eigen::VectorXd motions; ///< amounts of the free ones so far [length]
    Eigen::VectorXd base;    ///< those that problems are written about
  };

  /** A reference force over the largest force so far: to a tolerance of 1e-10
   * of this, what is left of it is rounding. */
  constexpr double rounding_of_past = 1e-4;

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

    /** Deformation of all dofs for each load case and its primal; all processes
     * call this. */
    virtual std::vector<Eigen::VectorXd>
    expand(const std::vector<const LoadCase *> &loads,
           const std::vector<Eigen::VectorXd>  &primal) const = 0;

    /** @name The contact problem of an increment
     * @{ */
    /** Load and offset of a problem; `offset` moves contacts without strain. */
    virtual void
    write(const LoadCase          &load,
          const Eigen::VectorXd   &offset,
          const ElasticState      &state,
          solvers::ContactProblem &problem) const = 0;
    /** What the motions that problems are written about move contacts by, as
     * far as it is part of their offset; empty: it is part of their load. */
    virtual Eigen::VectorXd
    moved_by(const Eigen::VectorXd & /*base*/) const
    {
      return {};
    }
    /** The largest force that a load is for contacts [force]. */
    virtual double
    largest_force(const LoadCase &load) const = 0;
    /** A reference force whose rounding a problem with the load may leave. */
    virtual double
    reference_force(const LoadCase & /*load*/) const
    {
      return 0;
    }
    /** Forces on contact unknowns that drive rigid motions as its load does. */
    virtual Eigen::VectorXd
    contact_load(const solvers::ContactProblem &problem) const = 0;
    /** @} */

    /** @name States of contact
     * @{ */
    /** Completes the start of an increment, which has v = (0, gap) and r. */
    virtual void
    begin(const ElasticState &state, solvers::ContactState &start) const = 0;
    /** Takes over the end of an increment. */
    virtual void
    end(const solvers::ContactState &end, ElasticState &state) const = 0;
    virtual Eigen::VectorXd
    primal(const ElasticState &state, const Eigen::VectorXd &r) const = 0;
    /** The end with such amounts of free motions more, which contacts see. */
    virtual void
    move(const Eigen::VectorXd &amounts,
         const Eigen::VectorXd &seen,
         solvers::ContactState &end) const = 0;
    /** What a state starts from, as checkpoints have it; all processes call
     * this. */
    virtual Eigen::VectorXd
    whole_start(const ElasticState &state) const
    {
      return numbers(state.start);
    }
    /** The whole of it once more, as this or the other Elasticity has left it;
     * `q`: displacements of contact unknowns so far. */
    virtual void
    restore(const std::vector<double> &start,
            const Eigen::VectorXd     &q,
            ElasticState              &state) const = 0;
    /**
     * Writes problems about motions nearby, where bodies touch that a solution
     * which was not found moves further than it strains them: gaps that close
     * are zero there, to the last bit. False: it does not.
     */
    virtual bool
    linearise_about(const solvers::ContactProblem & /*problem*/,
                    const solvers::ContactState & /*state*/,
                    ElasticState & /*elastic*/) const
    {
      return false;
    }
    /** Deformation of all dofs that another start may be made of; empty:
     * solvers need none. */
    virtual Eigen::VectorXd
    deformation(const Eigen::VectorXd & /*primal*/) const
    {
      return {};
    }
    /** Unknowns of such a deformation with motions `amounts` more. */
    virtual Eigen::VectorXd
    nearby(const Eigen::VectorXd & /*w*/,
           const Eigen::VectorXd & /*amounts*/) const
    {
      return {};
    }
    /** @} */

    /** @name Iterative refinement
     * @{ */
    /**
     * The change of a load case that takes away forces on all dofs that are not
     * balanced, and the change of the deformation that does so while the primal
     * unknowns change by `primal`.
     */
    virtual LoadCase
    reduce_unbalanced(const Eigen::VectorXd &unbalanced) const = 0;
    virtual Eigen::VectorXd
    correction(const LoadCase &change, const Eigen::VectorXd &primal) const = 0;
    /** Contact unknowns and what is bound are elsewhere than they should. */
    virtual void
    add_missed(const Eigen::VectorXd & /*by_contacts*/,
               const Eigen::VectorXd & /*by_bound*/,
               LoadCase & /*change*/) const
    {}
    /** What solvers start from then: `start`, or where they ended. */
    virtual solvers::ContactState
    restart(const solvers::ContactState &start,
            const solvers::ContactState & /*end*/) const
    {
      return start;
    }
    /** Whether a problem that is written about such a motion of bodies has more
     * digits than a correction that deforms them by w. */
    virtual bool
    is_rounded_by(const Eigen::VectorXd & /*motions*/,
                  const Eigen::VectorXd & /*w*/) const
    {
      return false;
    }
    /** @} */

    /** What is bound has moved by `offset` without strain. */
    virtual void
    move_bound(const Eigen::VectorXd & /*offset*/, LoadCase & /*load*/) const
    {}
    /** What is bound under a load case and its primal. */
    virtual BoundState
    bound_state(const LoadCase & /*load*/,
                const Eigen::VectorXd & /*primal*/) const
    {
      return {};
    }
    /** Stiffness along each unknown of what is bound [force/length]. */
    virtual Eigen::VectorXd
    bound_stiffness() const
    {
      return {};
    }

    /** Redundant rows of what is bound, where they are known; null: they are
     * not. */
    virtual const RedundantRows *
    redundant_rows() const
    {
      return nullptr;
    }

    /** Contacts were found again: other rows over the same bodies. False: it
     * must be made anew. */
    virtual bool
    relink()
    {
      return true;
    }
    /** A cut was locked: fewer motions are free, nothing is factorised. False:
     * it must be made anew. */
    virtual bool
    see_motions()
    {
      return true;
    }

    /** Load cases that were reduced by the solver. */
    unsigned int
    n_reductions() const
    {
      return n_reduced;
    }
    /** Work that made it, for the log. */
    virtual std::string
    description() const = 0;
    /** Memory of factors [bytes]; 0: there are none, or it is not known. */
    virtual double
    factor_bytes() const
    {
      return 0;
    }
    /** Bodies for which an equal one is condensed. */
    virtual unsigned int
    n_shared_bodies() const
    {
      return 0;
    }
    /** Work with the factors so far. */
    virtual condensed::SchurWork
    work() const
    {
      return {};
    }

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
