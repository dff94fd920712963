// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_elastic_states_h
#define conetact_contact_elastic_states_h

#include "conetact/contact/shared_vector.h"
#include "conetact/solvers/contact_problem.h"

#include <vector>

namespace conetact::contact
{
  /** Where bodies are between increments: a value. */
  struct ElasticState
  {
    /** Elastic displacements that solvers start from, in the unknowns of the
     * Elasticity that wrote them [length]; none: nothing is strained. */
    SharedVector    start;
    Eigen::VectorXd motions; ///< amounts of the free ones so far [length]
    Eigen::VectorXd base;    ///< those that problems are written about
  };

  /** How an Elasticity goes on from one state of contact to the next. */
  class ElasticStates
  {
  public:
    virtual ~ElasticStates() = default;

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
    /** What solvers start a correction from: `start`, or where they ended. */
    virtual solvers::ContactState
    restart(const solvers::ContactState &start,
            const solvers::ContactState & /*end*/) const
    {
      return start;
    }
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

    /** What the motions that problems are written about move contacts by, as
     * far as it is part of their offset; empty: it is part of their load. */
    virtual Eigen::VectorXd
    moved_by(const Eigen::VectorXd & /*base*/) const
    {
      return {};
    }
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
  };
} // namespace conetact::contact

#endif
