// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_model_h
#define conetact_contact_contact_model_h

#include "conetact/base/archive.h"
#include "conetact/contact/condensation.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/dual_backend.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/contact/iterative_backend.h"
#include "conetact/contact/iterative_limits.h"
#include "conetact/contact/node_rules.h"
#include "conetact/contact/redundant_rows.h"
#include "conetact/contact/rigid_motions.h"

#include <memory>

namespace conetact::contact
{
  /**
   * A scene's bodies made ready for contact solvers: rules of nodes, contact
   * points, rigid motions and, when first asked for, the condensation.
   */
  class ContactModel
  {
  public:
    /** `times` are those of the increments. Throws InputError. */
    ContactModel(
      const Bodies              &bodies,
      const std::vector<double> &times,
      const backends::Condenser &condenser = backends::default_condenser());

    const Bodies       &bodies;
    const NodeRules     rules;       ///< what supports and hanging nodes leave
    ContactPoints       points;      ///< contacts as rows over the nodes
    const Coordinates   coordinates; ///< of the bodies without contacts
    const ElasticSystem elastic;
    RigidMotions        motions;

    /** A bound node of which supports or other bound contacts hold what its
     * own contact does; null: there is none. */
    const pairing::ContactNode *
    held_twice() const;

    /**
     * Whether contacts are rows over bodies that condense themselves, with
     * free motions as unknowns (DualBackend); else all bodies are held, meet
     * obstacles only, do not slide along what supports hold and differ from
     * each other, and one stiffness serves them (Condensation), if they are
     * condensed.
     */
    bool
    condenses_bodies() const
    {
      return dual;
    }
    /** The same, unless nothing is condensed. */
    bool
    is_dual() const
    {
      return dual && !large;
    }

    /** Nothing is condensed (IterativeBackend). */
    bool
    is_iterative() const
    {
      return large;
    }
    /**
     * Makes it so, before anything is condensed. Throws InputError where the
     * scene has what that cannot do.
     */
    void
    solve_iteratively();
    /** The other way from here on, with all candidates. */
    void
    solve_condensed();
    /** What IterativeBackend cannot do; empty: nothing. */
    std::string
    why_not_iterative() const
    {
      return contact::why_not_iterative(bodies, rules, points);
    }

    /** See hardest_slave() of large_nodes.h. */
    double
    hardest_slave() const;

    /**
     * Condenses the bodies to the working set, unless that is done already:
     * factorises the first time and after choose().
     */
    ElasticBackend &
    condense();
    /** That, where nothing is condensed. */
    const IterativeBackend &
    iterative_backend();

    /**
     * How far its stiffness is that of another condenser. Throws AnalysisError
     * where one of both takes it for singular.
     */
    std::vector<StiffnessDifference>
    compare_stiffness(const backends::Condenser &other);

    /** What the factorisation of a condensation takes. */
    backends::FactorEstimate
    estimate_factor() const;

    /**
     * Everything that acts at time t: nodal forces on all dofs, and those of
     * changes of temperature (or none), which balance by themselves.
     */
    LoadCase
    load_case(const Eigen::VectorXd &mechanical,
              const Eigen::VectorXd &thermal,
              const double           t);
    /** Of the contact unknowns, from displacements of all dofs at time t. */
    Eigen::VectorXd
    relative_displacements(const Eigen::VectorXd &u, const double t) const;
    /** That of a node. */
    Tensor<1, 3>
    displacement(const Eigen::VectorXd &u,
                 const unsigned int     body,
                 const unsigned int     node) const;

    /** Amounts of all rigid motions, from the free ones. */
    Eigen::VectorXd
    amounts(const Eigen::VectorXd &placement, const Eigen::VectorXd &a) const;

    /** Whether a body may turn far. */
    bool
    has_frame(const unsigned int body) const
    {
      return body < turns.size() && turns[body];
    }
    /** Largest angle by which amounts turn a body that has a frame [rad]. */
    double
    turn_of_frames(const Eigen::VectorXd &amounts) const;
    /** Frames of bodies go on by these amounts; those of others stay. */
    void
    move_frames(const Eigen::VectorXd &amounts);
    /** They go where supports take bodies until time t. */
    void
    move_frames_with_supports(const double t);

    /** The candidates to be condensed; all, unless chosen otherwise. */
    const WorkingSet &
    working_set() const
    {
      return condensed ? condensed->working_set() : chosen;
    }
    /** Chooses them; a condensation made before is made anew. */
    void
    choose(WorkingSet set);
    /** Adds candidates to the condensation at hand, if it can take them. */
    bool
    extend(const std::vector<Eigen::Index> &nodes);

    /**
     * Takes contact nodes that were found again (finite sliding): other rows
     * over the same bodies, nothing is factorised. What is not condensed is
     * made anew if nodes face others or turn, unless why_not_iterative() has a
     * reason now, and `elastic`, its unknowns, are those of the new contacts
     * then. Throws AnalysisError.
     */
    void
    relink(std::vector<pairing::ContactNode> nodes, Eigen::VectorXd &elastic);

    /**
     * Locks cuts that are due in increments that begin at t, as open as they
     * are in displacements u of all dofs (none: undeformed). Whether there were
     * any: free motions are other ones then.
     */
    bool
    lock_cuts(const double t, const Eigen::VectorXd &u);
    /** How open cuts are in displacements u of all dofs [length]. */
    double
    opening(const Cut &cut, const Eigen::VectorXd &u) const;
    /** On all dofs: forces by which locks of cuts keep reactions in balance. */
    Eigen::VectorXd
    lock_forces(const Eigen::VectorXd &all_reactions) const;

    bool
    may_be_mechanism() const;

    /** Work with all elastic factors so far. */
    backends::SchurWork
    work() const;

  private:
    void
    find_frames();
    bool
    may_turn(const unsigned int body) const;
    /** How far frames have taken nodes that have rules, at most [length]. */
    double
    way_of_frames() const;
    bool
    needs_dual() const;
    /** Of small frames, as that takes a factorisation. */
    bool
    moves_as_rigid_only() const;
    bool
    has_equal_bodies() const;
    std::unique_ptr<ElasticBackend>
    make_backend() const;
    std::string
    singular_sentence(const backends::SingularMatrix &error) const;
    Eigen::VectorXd
    all_offsets(const LoadCase &load, const double t) const;

    const std::vector<double>       times;
    std::vector<bool>               turns; ///< of each body with a frame
    const backends::Condenser      &condenser;
    bool                            dual;
    bool                            large = false;
    WorkingSet                      chosen;
    std::unique_ptr<ElasticBackend> condensed;
    backends::SchurWork             former_work; ///< before condensed anew
  };

  /**
   * One increment in the terms of [K] (17): unknowns are slips of the
   * increment and new gaps. It knows all candidates; problems and states of
   * solvers are those of the model's working set.
   */
  class ContactHistory
  {
  public:
    /** Whether the model is solved iteratively must be known by then. */
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
      base = motions;
    }
    /**
     * The same where bodies touch that a solution, nearby, moves further than
     * it strains them: gaps that close are zero there, to the last bit. False
     * if it does not move them so far.
     */
    bool
    linearise_about(const solvers::ContactProblem &problem,
                    const solvers::ContactState   &state);
    const Eigen::VectorXd &
    linearised_at() const
    {
      return base;
    }
    /**
     * The model takes contacts that were found again: their gaps are other
     * ones, and their displacements so far, which belong to the displacements u
     * of all dofs at time t (none: the start). Reactions and states stay,
     * components and all. Throws AnalysisError.
     */
    void
    relink(std::vector<pairing::ContactNode> nodes,
           const Eigen::VectorXd            &u,
           const double                      t);
    /** The model is condensed from here on. */
    void
    see_condensation();
    /** Free motions have become other ones. */
    void
    forget_motions()
    {
      a = base = Eigen::VectorXd::Zero(model->motions.n_free());
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
    /** Takes over the end of an increment. */
    void
    advance(const solvers::ContactState &end);
    /**
     * Displacements of all candidates, once they are known: those outside the
     * working set are taken over.
     */
    void
    recover(const Eigen::VectorXd &displacements);
    /** `end` of an increment for all candidates that began at `before`. */
    solvers::ContactState
    of_candidates(const solvers::ContactState &end,
                  const ContactHistory        &before) const;

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
      return a;
    }
    /** What of it is kept in a checkpoint, and taken from one again. */
    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive);

    /** What ElasticBackend::expand() takes. */
    Eigen::VectorXd
    primal() const;
    /** Gaps of all candidates. */
    Eigen::VectorXd
    gaps() const;
    /** Largest reaction or load so far [force]. */
    double
    largest_force() const
    {
      return largest;
    }

  private:
    Eigen::VectorXd
    shift() const;
    /** What moves contacts without strain until the end with `load`. */
    Eigen::VectorXd
    offset_at(const LoadCase &load) const;
    void
    take_motions();
    /** `elastic` of this or another backend. */
    void
    take_elastic(const std::vector<double> &kept);
    /** A scale of forces whose rounding is that of motions without strain. */
    double
    motion_force(const LoadCase &load) const;

    ContactModel   *model;
    Eigen::VectorXd initial_gap; ///< of each node with unknowns
    Eigen::VectorXd q, r;
    /** Without offset, stiffness form; of all unknowns where it is large, less
     * the free motions `base`. */
    Eigen::VectorXd                 elastic;
    Eigen::VectorXd                 a, base; ///< free motions
    std::vector<solvers::NodeState> states;
    double largest = 0; ///< reaction or load so far [force]
  };
} // namespace conetact::contact

#endif
