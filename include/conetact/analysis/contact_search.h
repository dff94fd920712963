// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_contact_search_h
#define conetact_analysis_contact_search_h

#include "conetact/analysis/pending_increment.h"
#include "conetact/pairing/sliding.h"

#include <vector>

namespace conetact::analysis
{
  /**
   * Finds contacts that slide far again, within increments and from one to the
   * next: an increment holds once its contacts are those at its end.
   */
  class ContactSearch
  {
  public:
    ContactSearch(const pairing::SlidingContacts &contacts,
                  contact::ContactModel          &model);

    /** Whether some contact slides far, or some body turns. */
    bool
    is_needed() const
    {
      return !contacts.empty() || !model.bodies.frames.empty();
    }

    /**
     * Why the slip until time t is no straight line, a sentence; empty: it is
     * nearly one.
     */
    std::string
    turns_too_far(const double t) const;

    /**
     * Whether an obstacle or a body passes through another body on the way to
     * displacements u at time t, a sentence; empty: none does. Where the
     * increment may be cut, what may only have gone round an edge is doubted,
     * too.
     */
    std::string
    passes_through(const Eigen::VectorXd &u,
                   const double           t,
                   const bool             may_be_cut);
    /** The same of bodies: whether a node has passed the faces that it met. */
    std::string
    loses_masters(const Eigen::VectorXd &u) const;

    /**
     * Whether an obstacle, smaller than cells, or a master has come in between
     * nodes at displacements u and time t, a sentence; empty: none has.
     */
    std::string
    comes_between(const Eigen::VectorXd &u, const double t);
    /**
     * Whether an obstacle presses on a node along a direction that its body
     * does not face, a sentence; empty: nowhere.
     */
    std::string
    meets_askew(const PendingIncrement &increment) const;

    /** Between where a node is pressed from and the normals of its body [rad].
     */
    double
    angle_to_body(const pairing::ContactNode &node) const;

    using Nodes = std::vector<pairing::ContactNode>;
    using Found = pairing::SlidingContacts::Found;
    /** Contacts where bodies are at time t: displacements u of all dofs.
     * `keep_faced`: see SlidingContacts::find(). */
    Found
    find(const Eigen::VectorXd &u,
         const double           t,
         const bool             keep_faced = false) const;
    /**
     * The same, but normals go only a part of the way from those that the model
     * has. On the edge between two facets each of them leads to the other one;
     * what holds there is a normal between theirs. Nodes at a rim are kept.
     */
    Found
    find_between(const Eigen::VectorXd &u,
                 const double           t,
                 const double           part) const;
    /**
     * The same before anything is solved: supports carry bodies and their
     * frames along.
     */
    Found
    guess(const double t);

    /** With the node that is farthest from where it is found. */
    struct Change : pairing::FoundChange
    {
      const pairing::ContactNode *worst = nullptr;
    };
    /**
     * How far the contacts that a solved increment had are from those that are
     * found at its end.
     */
    Change
    change(const PendingIncrement &increment,
           const Eigen::VectorXd  &u,
           const Nodes            &found) const;

    /**
     * The model takes them, and so does the history, which must be at the start
     * of the increment. Returns why they cannot be taken, a sentence.
     */
    std::string
    take(Found found, contact::ContactHistory &history) const;

    /** An increment, or a part of one, was accepted: the next starts there. */
    void
    accept(const Eigen::VectorXd &u, const double t);
    /** Where it ended. */
    double
    time() const
    {
      return start_t;
    }
    /** Contacts as they were then. */
    const Nodes &
    accepted() const
    {
      return start_nodes;
    }
    /** Bodies stand where they stood then. */
    void
    go_back();

    /** What of it is kept in a checkpoint, and taken from one again, also by
     * the history. Throws InputError. */
    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive, contact::ContactHistory &history);

  private:
    using Ways = std::vector<pairing::BodyWay>;
    Ways
    ways_to(const Eigen::VectorXd &u) const;
    std::string
    obstacle_passes(const Ways  &ways,
                    const double t,
                    const bool   may_be_cut) const;
    std::string
    body_passes(const Ways            &ways,
                const Eigen::VectorXd &u,
                const bool             may_be_cut);
    /** A face, or a part of it, whose corners may all touch an obstacle. */
    struct ObstacleFace
    {
      std::size_t               node; ///< one of them, among contact nodes
      std::vector<unsigned int> corners;
    };
    void
    find_obstacle_faces();
    /** At time t, of the points of a face of this size. */
    double
    lowest_gap(const ObstacleFace                           &face,
               const pairing::SlidingContacts::Displacement &at,
               const double                                  size,
               const double                                  t) const;
    using Places = std::vector<Tensor<1, 3>>; ///< of all nodes of all bodies
    double
    approach(const Places &from, const Places &to) const;
    std::string
    master_comes_between(const Eigen::VectorXd &u, const double deep);
    Found
    find_there(const Eigen::VectorXd &u,
               const double           t,
               const bool             keep_faced) const;
    Found
    linearised(Found found) const;

    pairing::SlidingContacts          contacts;
    contact::ContactModel            &model;
    Eigen::VectorXd                   start; ///< displacements of all dofs
    double                            start_t = 0;
    std::vector<pairing::RigidMotion> frames; ///< of bodies, then
    Nodes                             start_nodes;
    /// nodes in other bodies, then and at the end that was looked at last
    pairing::SlidingContacts::Entries start_inside, inside;
    std::vector<ObstacleFace>         obstacle_faces;
    Places clear_at;      ///< displacements where masters were looked for last
    double clearance = 0; ///< so far none was too deep in a slave [length]
  };
} // namespace conetact::analysis

#endif
