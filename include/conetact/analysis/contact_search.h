// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_contact_search_h
#define conetact_analysis_contact_search_h

#include "conetact/analysis/contact_passages.h"
#include "conetact/analysis/pending_increment.h"

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

    const pairing::SlidingContacts &
    sliding_contacts() const
    {
      return contacts;
    }
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
    /** The same of bodies that have rolled while contacts were found again. */
    std::string
    rolls_on() const;

    /** What happens on the way to displacements u at time t; see
     * ContactPassages. */
    std::string
    passes_through(const Eigen::VectorXd &u,
                   const double           t,
                   const bool             may_be_cut);
    std::string
    loses_masters(const Eigen::VectorXd &u, const double t) const;

    using Nodes = std::vector<pairing::ContactNode>;
    using Found = pairing::SlidingContacts::Found;
    /** Contacts where bodies are at time t: displacements u of all dofs.
     * `keep_faced`: see SlidingContacts::find(). */
    Found
    find(const Eigen::VectorXd &u,
         const double           t,
         const bool             keep_faced = false) const;
    /**
     * The same, but rows go only a part of the way from those that the model
     * has. On the edge between two facets each of them leads to the other one;
     * what holds there is a row between theirs. Nodes at a rim are kept.
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
      return start.t;
    }
    /** Contacts as they were then. */
    const Nodes &
    accepted() const
    {
      return start.nodes;
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
    Found
    find_there(const Eigen::VectorXd &u,
               const double           t,
               const bool             keep_faced) const;
    void
    keep_normals_of_held(Nodes &nodes) const;
    Found
    linearised(Found found) const;
    void
    go_part_of_the_way(const pairing::ContactNode &last,
                       const Eigen::VectorXd      &u,
                       const double                part,
                       pairing::ContactNode       &node) const;

    pairing::SlidingContacts contacts;
    contact::ContactModel   &model;
    ContactPassages          passages;
    ContactStart             start;
    /// nodes in other bodies at the end that was looked at last
    pairing::SlidingContacts::Entries inside;
  };
} // namespace conetact::analysis

#endif
