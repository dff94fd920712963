// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_h
#define conetact_application_scene_h

#include "conetact/application/adaptive_settings.h"
#include "conetact/application/automatic_contacts.h"
#include "conetact/application/command_line.h"
#include "conetact/application/entry_list.h"
#include "conetact/application/scene_file.h"
#include "conetact/application/solver_options.h"
#include "conetact/base/archive.h"
#include "conetact/bodies/nodal_loads.h"
#include "conetact/bodies/probes.h"
#include "conetact/contact/node_rules.h"
#include "conetact/iterative/preconditioner.h"
#include "conetact/output/units.h"
#include "conetact/pairing/kinematics.h"
#include "conetact/pairing/obstacles.h"
#include "conetact/pairing/sliding.h"
#include "conetact/solvers/contact_solver.h"

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace conetact::application
{
  /**
   * A scene file, read and checked, with all objects it names. The file is
   * read twice: first only its lists of names, then strictly with one
   * subsection for each name.
   */
  class Scene
  {
  public:
    /**
     * Reads the file and the overrides of the command line. Throws InputError
     * with file and line.
     */
    explicit Scene(const CommandLine &line);

    /**
     * Makes bodies (refined, one entry a body, or as they are), obstacles,
     * contacts, supports, loads. Throws InputError.
     */
    void
    build(const std::vector<bodies::Refinements> &refinements = {});

    /** All entries with their documentation, or just their values. */
    std::string
    documentation() const;
    std::string
    values() const;
    std::vector<EntryDescription>
    entries() const;

    /** The scene file's name without folder and ending. */
    std::string
    name() const;

    /** Nodal forces of all loads, to be integrated when asked for. */
    bodies::NodalLoads
    nodal_loads() const;
    /** Obstacles that no contact names. */
    std::vector<const pairing::Obstacle *>
    idle_obstacles() const;

    /** Forces on obstacles that are free and of Preloads, on all dofs of all
     * bodies [force]. */
    Eigen::VectorXd
    obstacle_forces(const double t) const;
    /** The loads of each body at time t, for its stresses. */
    std::vector<bodies::Actions>
    actions(const double t) const;
    /** Contacts as they are found again where bodies slide far. */
    pairing::SlidingContacts
    sliding_contacts() const;
    const pairing::Contact &
    contact(const std::size_t number) const
    {
      return contacts[number];
    }
    /** What is possible and hardly meant, a sentence each. */
    std::vector<std::string>
    cautions() const;
    /** Prestress of all contacts, on all dofs of all bodies [force]; empty:
     * there is none. */
    Eigen::VectorXd
    prestress() const;
    /**
     * Throws InputError where a load or a motion is not linear in t between
     * t = 0 and the first time, or from one time to the next.
     */
    void
    check_stages() const;
    /** Whether Solver/Method = load path would take the scene. */
    bool
    may_follow_path() const;
    /** Whether any load is a moment. */
    bool
    has_moments() const;

    model::Bodies            bodies;
    std::vector<std::string> contact_names, support_names, load_names;
    /**
     * Names of all contacts, then of the masters' sides of pairs, with their
     * index there (a contact with an obstacle: its own).
     */
    std::vector<std::string>      contact_sides;
    std::vector<unsigned int>     master_side;
    std::vector<unsigned int>     side_bodies; ///< the body of each of them
    std::vector<pairing::Pairing> pairings;    ///< of each contact
    /** Of each contact, nodes that belong to contacts before it. */
    std::vector<unsigned int>               n_shared;
    std::vector<pairing::ContactKinematics> kinematics; ///< the same
    std::vector<double>                     times;
    solvers::SolverOptions                  solver;
    const condensed::Condenser *condenser = &condensed::default_condenser();
    iterative::Preconditioner   preconditioner =
      iterative::Preconditioner::aggregation;
    Backend                    backend = Backend::automatic;
    PathSettings               path;
    AdaptiveSettings           adaptive;
    std::vector<bodies::Probe> probes;
    unsigned int               vtu_every = 1;
    output::Units              units;
    /** Increments that are drawn. */
    std::size_t
    n_drawings() const
    {
      return vtu_every > 0 ? times.size() / vtu_every : 0;
    }
    /** Only the last of several meshes is drawn and has problem files. */
    void
    draw_nothing()
    {
      vtu_every = 0;
      fclib_increments.clear();
      text_increments.clear();
      judges_uniqueness = false;
      follows_branches  = false;
    }
    /** A run that is continued, from its last checkpoint on. */
    struct Restart
    {
      std::filesystem::path folder;
      Archive               state;
      unsigned int          n_done = 0; ///< increments
    };
    std::optional<Restart> restart;
    /** Whether supports may change in the course of the scene. */
    bool
    has_stages() const;
    /** Ends of the stages in which the same supports are active: the last time,
     * and those after which others are. */
    std::vector<double>
    stage_ends() const;
    /** Ends of increments in the last of these stages. */
    std::vector<double>
    stage_times() const;
    /** Runs until then only, from the checkpoint in a folder where it is not
     * empty, with the supports of that stage. */
    void
    take_stage(const double end, const std::filesystem::path &folder);
    /** Why a later stage cannot begin anew with contacts that slide far, a
     * sentence. */
    std::string
    why_not_anew(const std::map<unsigned int, std::string> &sliding) const;
    /** Increments that are done already; `times` begins with theirs. */
    unsigned int
    n_done() const
    {
      return restart ? restart->n_done : 0;
    }
    /**
     * Contacts of automatic kinematics, by number, that a run has shown to need
     * finite sliding, and why, a part of a sentence. To be set before build().
     */
    std::map<unsigned int, std::string> shown_to_slide;
    /**
     * What `Contacts = automatic` has found, after build(). To be set before it
     * where a history runs again on another mesh, so that contacts stay the
     * same.
     */
    std::optional<pairing::NearPairs> near_sides;
    /** All contacts that were found so, as a scene would have them; empty: none
     * were asked for. */
    std::string automatic_text;
    /** What of included files no list names any more, a sentence each. */
    std::vector<std::string> left_out;
    /** A run that continues this one must take contacts as it does. */
    void
                            save_kinematics(Archive &archive) const;
    unsigned int            checkpoint_every = 0; ///< 0: never
    unsigned int            threads          = 1;
    std::set<unsigned int>  fclib_increments; ///< with a file of their own
    std::set<unsigned int>  text_increments;  ///< or stages of a load path
    bool                    judges_uniqueness = false;
    bool                    follows_branches  = false; ///< of all solutions
    std::vector<Expression> activity; ///< of each support, of t

  private:
    void
    parse_all(dealii::ParameterHandler &handler,
              const bool                skip_undefined) const;
    void
    read_names();
    /** Loads of bodies that have a density under Gravity. */
    void
    add_weights(const std::vector<double> &densities);
    void
    add_contact(dealii::ParameterHandler &entries,
                const std::string        &name,
                const std::string        &in);
    void
    add_automatic_contacts();
    /** Loads that are rigid: an obstacle and a tie each. The name of that of
     * each load, empty: it has none. */
    std::vector<std::string>
    add_couplings();
    /** Once these obstacles are bodies: loads act on them. */
    void
    act_on_couplings(const std::vector<std::string> &names);
    void
    read_options();
    void
    replace_times();
    void
    read_problem_increments();
    std::vector<bool>
    bodies_at_rest() const;
    void
    check_path() const;
    /** What is not linear in t, a sentence; empty: nothing. */
    std::string
    bent_load() const;
    std::string
    bent_motion() const;
    void
    settle_friction();
    void
    refuse_joints_of_other_methods() const;
    void
    check_turning_supports() const;
    void
    check_preloads() const;
    /** Finds contact nodes, with the kinematics that each contact needs. */
    void
    pair_contacts();
    std::string
    why_not_sliding(const pairing::Contact &contact) const;
    std::string
    why_it_turns(const pairing::Contact &contact) const;
    void
    begin_kinematics(const unsigned int contact);
    bool
    change_kinematics(const unsigned int contact, const std::string &held);
    void
    keep_nodes();
    void
    continue_from(const std::filesystem::path &folder);
    void
    read_activity();
    /** Whether each support is active at time t. */
    std::vector<bool>
    active_supports(const double t) const;
    void
    refuse_changes(const Restart &run) const;
    void
    refuse_checkpoints() const;

    std::filesystem::path    file;
    std::vector<std::string> overrides;
    bool                     verifies; ///< condenses twice
    SceneText                text;     ///< of the file and what it includes
    std::vector<std::string> obstacle_names;
    bool                     finds_contacts = false; ///< `Contacts = automatic`

    mutable dealii::ParameterHandler                prm;
    std::vector<std::unique_ptr<bodies::Structure>> structures;
    std::vector<pairing::Obstacle>                  obstacles;
    std::vector<pairing::Contact>                   contacts;
    std::vector<unsigned int> adjusted_contacts; ///< Gap = adjust
    std::vector<bodies::Load> loads;
  };
} // namespace conetact::application

#endif
