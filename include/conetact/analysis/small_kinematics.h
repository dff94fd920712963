// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_small_kinematics_h
#define conetact_analysis_small_kinematics_h

#include "conetact/analysis/pending_increment.h"
#include "conetact/analysis/round_facets.h"
#include "conetact/application/scene.h"
#include "conetact/verification/verification.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /** The end of an increment, as small kinematics is judged there. */
  struct IncrementEnd
  {
    const PendingIncrement      &increment;
    const verification::Finding &finding;
    const Eigen::VectorXd       &w;       ///< deformation of all dofs
    const Eigen::VectorXd       &amounts; ///< of all rigid motions
  };

  /**
   * Contacts that are those of undeformed bodies, and what shows that they are
   * no longer. Sentences say what has happened, without a full stop.
   */
  class SmallKinematics
  {
  public:
    SmallKinematics(const application::Scene    &scene,
                    const contact::ContactModel &model);

    /** What a contact is wrong for. */
    struct Left
    {
      std::string why;
      /** It has slid so far as only what is let go does. */
      bool is_let_go = false;
    };
    using Found = std::map<unsigned int, Left>;
    /** By their number: gaps, feet, slips. */
    Found
    left(const IncrementEnd &end) const;

    /** A body that has turned further than linear motions are good for. */
    struct Turned
    {
      std::string               why;
      double                    angle;        ///< [rad]
      std::vector<unsigned int> small;        ///< contacts of it
      bool                      is_automatic; ///< a contact of it
      /** If these slide far it has a frame that turns with it. */
      bool could_turn;
    };
    std::vector<Turned>
    turned(const Eigen::VectorXd &amounts) const;

    /** Whether friction holds nothing of a contact any more. */
    bool
    all_slips(const PendingIncrement &increment,
              const unsigned int      contact) const;

    /** A contact of curved sides whose normals have turned; none: little. */
    std::optional<std::pair<unsigned int, std::string>>
    tilted(const IncrementEnd &end) const;

  private:
    void
    add_wrong_gaps(const IncrementEnd &end, Found &found) const;
    void
    add_wrong_feet(const IncrementEnd &end, Found &found) const;
    void
    add_wrong_turns(const IncrementEnd &end, Found &found) const;
    void
    add_turned_springs(const IncrementEnd &end, Found &found) const;
    void
    add_rolled(const IncrementEnd &end, Found &found) const;
    void
    add_beside_sliding(const IncrementEnd &end, Found &found) const;
    /** Whether a contact touches on sides that look in several directions. */
    bool
    encloses(const PendingIncrement &increment,
             const unsigned int      contact) const;
    /** Of a body, but for ties that hold for ever. */
    std::vector<unsigned int>
    contacts_of(const unsigned int body) const;
    /** Of a body that has no frame, which would turn with it [rad]. */
    Tensor<1, 3>
    turn_of(const unsigned int body, const IncrementEnd &end) const;
    /** Whether a body has a motion that no support prescribes. */
    bool
    is_free(const unsigned int body) const;
    /** How far a round body has rolled at a node of it [rad]; 0 where it is not
     * round. */
    double
    rolled(const pairing::ContactNode &node, const IncrementEnd &end) const;
    pairing::RigidMotion
    obstacle_motion(const pairing::ContactNode &node,
                    const Eigen::VectorXd      &amounts,
                    const double                t) const;
    Tensor<1, 3>
    turn_of_normal(const pairing::ContactNode &node,
                   const IncrementEnd         &end) const;

    const application::Scene    &scene;
    const contact::ContactModel &model;
    /** Faces at the nodes of contacts with other bodies that may tilt. */
    std::map<std::pair<unsigned int, unsigned int>,
             std::vector<std::vector<unsigned int>>>
                        faces_at;
    mutable RoundFacets facets; ///< finds sides when they are asked for
  };
} // namespace conetact::analysis

#endif
