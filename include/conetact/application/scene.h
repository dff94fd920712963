// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_h
#define conetact_application_scene_h

#include "conetact/application/automatic_contacts.h"
#include "conetact/application/contact_kinematics.h"
#include "conetact/application/scene_entries.h"
#include "conetact/application/stages.h"
#include "conetact/bodies/nodal_loads.h"
#include "conetact/bodies/probes.h"
#include "conetact/pairing/sliding.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace conetact::application
{
  /**
   * A scene file, read and checked, with all objects it names and how they are
   * solved.
   */
  class Scene : public SceneObjects, public RunSettings
  {
  public:
    /** Reads entries, no meshes. Throws InputError with file and line. */
    explicit Scene(const CommandLine &line);

    /**
     * Makes bodies (refined, one entry a body, or as they are), obstacles,
     * contacts, supports, loads. Throws InputError.
     */
    void
    build(const std::vector<bodies::Refinements> &refinements = {});

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
    /** What is possible and hardly meant, a sentence each. */
    std::vector<std::string>
    cautions() const;

    /** Runs until then only, from the checkpoint in a folder where it is not
     * empty, with the supports of that stage. */
    void
    take_stage(const double end, const std::filesystem::path &folder);
    /** Increments that are done already; `times` begins with theirs. */
    unsigned int
    n_done() const
    {
      return restart ? restart->n_done : 0;
    }

    const SceneEntries       entries;
    std::vector<std::string> contact_names, support_names, load_names;
    /**
     * Names of all contacts, then of the masters' sides of pairs, with their
     * index there (a contact with an obstacle: its own).
     */
    std::vector<std::string>      contact_sides;
    std::vector<unsigned int>     master_side;
    std::vector<unsigned int>     side_bodies; ///< the body of each of them
    std::vector<pairing::Pairing> pairings;    ///< of each contact
    std::vector<unsigned int>     adjusted_contacts; ///< Gap = adjust
    /** Of each contact, nodes that belong to contacts before it. */
    std::vector<unsigned int>               n_shared;
    std::vector<pairing::ContactKinematics> kinematics; ///< the same
    std::vector<bodies::Probe>              probes;
    Stages                                  stages;
    std::optional<Restart>                  restart;
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

  private:
    void
    create_objects(const std::vector<bodies::Refinements> &refinements);
    /** Loads of bodies that have a density under Gravity. */
    void
    add_weights(const std::vector<double> &densities);
    void
    add_contact(dealii::ParameterHandler &prm,
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
    find_contact_nodes();

    std::vector<std::unique_ptr<bodies::Structure>> structures;
  };
} // namespace conetact::application

#endif
