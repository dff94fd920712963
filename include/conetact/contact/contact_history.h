// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_history_h
#define conetact_contact_contact_history_h

#include "conetact/base/archive.h"
#include "conetact/contact/contact_model.h"
#include "conetact/contact/increment_laws.h"
#include "conetact/contact/wear.h"

#include <functional>
#include <memory>
#include <string>

namespace conetact::contact
{
  /** What laws of contacts remember of each node. */
  struct LawMemory
  {
    Eigen::VectorXd slipped; ///< way so far, in contact [length]
    Eigen::VectorXd shorn;   ///< that of bonds, in contact or not [length]
    Eigen::VectorXd packed;  ///< largest pressure so far [stress]
    /** Largest opening of a bonded node so far, never_closed of what was open
     * at the start [length]. */
    Eigen::VectorXd opened;
    Eigen::VectorXd parted; ///< its opening now [length]
    Eigen::VectorXd broken; ///< work against its bond so far [force x length]
    Wear            wear;   ///< what both sides have lost, which opens gaps
  };

  /**
   * One increment in the terms of [K] (17): unknowns are slips of the
   * increment and new gaps. A value: a copy of it is where to go back to.
   */
  class ContactHistory
  {
  public:
    explicit ContactHistory(ContactModel &model);

    /** The increment that ends with `load`. */
    solvers::ContactProblem
    problem(const LoadCase &load);
    /** Where it starts: v = (0, gap), reactions and states so far. */
    solvers::ContactState
    start() const;
    /**
     * Free motions that the problem is written about, so that its unknowns are
     * small; those at the start unless said otherwise.
     */
    void
    linearise_at(const Eigen::VectorXd &motions)
    {
      elastic.base = motions;
    }
    /** See ElasticStates. */
    bool
    linearise_about(const solvers::ContactProblem &problem,
                    const solvers::ContactState   &state)
    {
      return model->elasticity().states().linearise_about(problem,
                                                          state,
                                                          elastic);
    }
    const Eigen::VectorXd &
    linearised_at() const
    {
      return elastic.base;
    }
    /**
     * The model takes contacts that were found again: their gaps are other
     * ones, and their displacements so far, which belong to the displacements u
     * of all dofs at time t (none: the start). Reactions and states stay,
     * components and all. Returns why they cannot be taken, a sentence.
     */
    std::string
    relink(std::vector<pairing::ContactNode> nodes,
           const Eigen::VectorXd            &u,
           const double                      t);
    /** The model is solved in another way from here on. */
    void
    see_elasticity();
    /** Of the model: free motions become other ones. */
    void
    lock_cuts(const double t, const Eigen::VectorXd &u)
    {
      model->lock_cuts(t, u, elastic);
      forget_motions();
    }
    /**
     * Where a solution is about that moves bodies by `motions` and deforms them
     * by w (all dofs), whose frames have followed these: what a solver starts
     * from, of a large system.
     */
    Eigen::VectorXd
    nearby(const Eigen::VectorXd &w, Eigen::VectorXd motions) const;
    /** The end of an increment with such amounts of OpenMotions more. */
    void
    move(solvers::ContactState &end,
         const Eigen::VectorXd &amounts,
         const double           largest_force) const;
    /** Takes over the end of an increment, at time t; `laws` of its contacts,
     * or none. */
    void
    advance(const solvers::ContactState &end,
            const double                 t,
            const IncrementLaws         *laws = nullptr);

    /** Change of a body's temperature at a point of it, at the time asked for.
     */
    using Temperature =
      std::function<double(unsigned int body, const Point<3> &p)>;
    /** Laws of the increment until t; none where contacts have none. `wet`:
     * candidates that a fluid has reached. */
    std::shared_ptr<const IncrementLaws>
    laws_until(const double             t,
               const Temperature       &temperature,
               const std::vector<bool> &wet = {}) const;

    /** Relative displacements of all contact unknowns since the start. */
    const Eigen::VectorXd &
    displacements() const
    {
      return q;
    }
    /** Amounts of the free motions since the start [length]. */
    const Eigen::VectorXd &
    free_motions() const
    {
      return elastic.motions;
    }
    /** What of it is kept in a checkpoint, and taken from one again: with what
     * all processes have of elastic displacements. */
    Eigen::VectorXd
    elastic_start() const
    {
      return model->elasticity().states().whole_start(elastic);
    }
    void
    save(const Eigen::VectorXd &elastic_start, Archive &archive) const;
    void
    restore(const Archive &archive);

    /** What Elasticity::expand() takes. */
    Eigen::VectorXd
    primal() const
    {
      return model->elasticity().states().primal(elastic, r);
    }
    Eigen::VectorXd
    gaps() const;
    const LawMemory &
    memory() const
    {
      return laws_know;
    }
    Wear &
    wear()
    {
      return laws_know.wear;
    }
    /** Largest reaction or load so far [force]. */
    double
    largest_force() const
    {
      return largest;
    }

  private:
    void
    forget_motions()
    {
      elastic.motions = elastic.base =
        Eigen::VectorXd::Zero(model->motions.n_free());
    }
    /** What moves contacts without strain until the end with `load`. */
    Eigen::VectorXd
    offset_at(const LoadCase &load) const;

    ContactModel                   *model;
    Eigen::VectorXd                 initial_gap; ///< of each node
    Eigen::VectorXd                 q, r;
    ElasticState                    elastic;
    std::vector<solvers::NodeState> states;
    double    largest = 0; ///< reaction or load so far [force]
    LawMemory laws_know;
    double    time = 0; ///< at the end of the last increment
  };
} // namespace conetact::contact

#endif
