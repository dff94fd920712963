// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_deck_sets_h
#define conetact_base_deck_sets_h

#include "conetact/base/deck_groups.h"
#include "conetact/base/deck_lines.h"

namespace conetact
{
  /** Numbers and sets of an instance of a part, or of the whole deck. */
  struct DeckScope
  {
    using Members = std::set<unsigned int>;
    using Labels  = std::map<unsigned int, unsigned int>;
    using Sets    = std::map<std::string, Members>; ///< by upper case names

    /** In the place of an element that is no cell, such as a spring. */
    static constexpr unsigned int no_cell = ~0u;

    std::string name; ///< of an instance
    Labels      nodes, elements;
    Sets        node_sets, element_sets;
  };

  /** Sets and surfaces of a deck: finds their members and makes groups. All
   * that it is given must outlive it; all throw FileFault. */
  class DeckSets
  {
  public:
    using Members   = DeckScope::Members;
    using Instances = std::map<std::string, DeckScope>; ///< upper case names

    DeckSets(const DeckText        &deck,
             const FileMesh        &m,
             DeckGroups            &g,
             const Instances       &all,
             std::set<std::string> &passed_over)
      : text(deck)
      , mesh(m)
      , groups(g)
      , instances(all)
      , skipped(passed_over)
    {}

    /** Where cells are solids, shells are surfaces of them. */
    bool has_solids = false;

    /** A parameter that must be there. */
    std::string
    required(const DeckBlock &block, const std::string &parameter) const;
    /** `what` is a "node" or an "element". */
    unsigned int
    find(const DeckScope::Labels &known,
         const unsigned int       label,
         const std::string       &what,
         const DeckLine          &line) const;
    void
    name_points(const std::string &name,
                const Members     &members,
                DeckScope         &scope);
    void
    name_elements(const std::string &name,
                  const Members     &members,
                  DeckScope         &scope);
    void
    read_node_set(const DeckBlock &block, DeckScope &scope);
    void
    read_element_set(const DeckBlock &block, DeckScope &scope);
    void
    read_surface(const DeckBlock &block, const DeckScope &scope);

  private:
    using Labels = DeckScope::Labels DeckScope::*;
    using Sets   = DeckScope::Sets     DeckScope::*;

    const DeckScope &
    scope_named(const DeckBlock &block, const DeckScope &own) const;
    const DeckScope &
    scope_of(std::string_view &field, const DeckScope &own) const;
    const Members &
    set_named(const std::string &name,
              const DeckScope   &scope,
              const Sets         sets,
              const DeckLine    &line) const;
    Members
    members_of(const DeckBlock   &block,
               const DeckScope   &scope,
               const Labels       labels,
               const Sets         sets,
               const std::string &what) const;
    void
    generate(const DeckLine          &line,
             const DeckScope::Labels &labels,
             Members                 &members) const;
    void
    add_members(std::string_view   field,
                const DeckLine    &line,
                const DeckScope   &own,
                const Labels       labels,
                const Sets         sets,
                const std::string &what,
                Members           &members) const;
    void
    refuse_empty(const DeckBlock   &block,
                 const std::string &name,
                 const bool         has_others) const;
    void
    add_faces(const std::string &name,
              const DeckLine    &line,
              const DeckScope   &scope);
    void
    add_side(const std::string &name,
             const unsigned int element,
             const std::string &side,
             const DeckLine    &line);

    const DeckText        &text;
    const FileMesh        &mesh;
    DeckGroups            &groups;
    const Instances       &instances;
    std::set<std::string> &skipped;
  };
} // namespace conetact

#endif
