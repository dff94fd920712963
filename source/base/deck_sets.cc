// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/deck_sets.h"

#include "conetact/base/deck_elements.h"

#include <cctype>

namespace conetact
{
  namespace
  {
    /** In an instance a name is that of all instances, too. */
    std::vector<std::string>
    names_of(const std::string &name, const DeckScope &scope)
    {
      if (scope.name.empty())
        return {name};
      return {name, scope.name + "." + name};
    }
  } // namespace

  std::string
  DeckSets::required(const DeckBlock &block, const std::string &parameter) const
  {
    const std::string value = block.value(parameter);
    if (value.empty())
      text.fail(block.head,
                "*" + block.keyword + " lacks its " + parameter + "=");
    return value;
  }

  unsigned int
  DeckSets::find(const DeckScope::Labels &known,
                 const unsigned int       label,
                 const std::string       &what,
                 const DeckLine          &line) const
  {
    const auto found = known.find(label);
    if (found == known.end())
      text.fail(line,
                "the " + what + " " + std::to_string(label) + " is not there");
    return found->second;
  }

  void
  DeckSets::name_points(const std::string &name,
                        const Members     &members,
                        DeckScope         &scope)
  {
    scope.node_sets[upper_case(name)].insert(members.begin(), members.end());
    for (const std::string &known : names_of(name, scope))
      groups.add_points(known, members);
  }
  void
  DeckSets::name_elements(const std::string &name,
                          const Members     &members,
                          DeckScope         &scope)
  {
    scope.element_sets[upper_case(name)].insert(members.begin(), members.end());
    for (const std::string &known : names_of(name, scope))
      groups.add_elements(known, members);
  }

  /** That of the parameter INSTANCE, else the given one. */
  const DeckScope &
  DeckSets::scope_named(const DeckBlock &block, const DeckScope &own) const
  {
    if (!block.has("INSTANCE"))
      return own;
    const auto found = instances.find(upper_case(block.value("INSTANCE")));
    if (found == instances.end())
      text.fail(block.head,
                "there is no instance '" + block.value("INSTANCE") + "'");
    return found->second;
  }

  void
  DeckSets::read_node_set(const DeckBlock &block, DeckScope &scope)
  {
    const std::string name    = required(block, "NSET");
    Members           members = members_of(block,
                                 scope_named(block, scope),
                                 &DeckScope::nodes,
                                 &DeckScope::node_sets,
                                 "node");
    if (block.has("ELSET"))
      for (const unsigned int e : set_named(
             block.value("ELSET"), scope, &DeckScope::element_sets, block.head))
        {
          const FileMesh::Element &element = mesh.elements[e];
          members.insert(element.nodes.begin(), element.nodes.end());
          members.insert(element.middles.begin(), element.middles.end());
        }
    refuse_empty(block, name, block.has("ELSET"));
    name_points(name, members, scope);
  }

  void
  DeckSets::read_element_set(const DeckBlock &block, DeckScope &scope)
  {
    const std::string name    = required(block, "ELSET");
    Members           members = members_of(block,
                                 scope_named(block, scope),
                                 &DeckScope::elements,
                                 &DeckScope::element_sets,
                                 "element");
    members.erase(DeckScope::no_cell);
    refuse_empty(block, name, false);
    name_elements(name, members, scope);
  }

  void
  DeckSets::refuse_empty(const DeckBlock   &block,
                         const std::string &name,
                         const bool         has_others) const
  {
    if (block.lines.empty() && !has_others)
      text.fail(block.head, "the set '" + name + "' has no members");
  }

  DeckSets::Members
  DeckSets::members_of(const DeckBlock   &block,
                       const DeckScope   &scope,
                       const Labels       labels,
                       const Sets         sets,
                       const std::string &what) const
  {
    Members members;
    for (const DeckLine &line : block.lines)
      if (block.has("GENERATE"))
        generate(line, scope.*labels, members);
      else
        for (const auto &field : DeckText::fields(line))
          if (!field.empty())
            add_members(field, line, scope, labels, sets, what, members);
    return members;
  }

  /** First, last, step; not all of these must be there. */
  void
  DeckSets::generate(const DeckLine          &line,
                     const DeckScope::Labels &labels,
                     Members                 &members) const
  {
    const auto fields = DeckText::fields(line);
    if (fields.size() < 2)
      text.fail(line, "GENERATE needs a first and a last number");
    const unsigned int first = text.label(fields[0], line);
    const unsigned int last  = text.label(fields[1], line);
    const unsigned int step =
      fields.size() > 2 && !fields[2].empty() ? text.label(fields[2], line) : 1;
    for (auto found = labels.lower_bound(first);
         found != labels.end() && found->first <= last;
         ++found)
      if ((found->first - first) % step == 0)
        members.insert(found->second);
  }

  /** A label, or a set; 'INSTANCE.' may stand before it. */
  void
  DeckSets::add_members(std::string_view   field,
                        const DeckLine    &line,
                        const DeckScope   &own,
                        const Labels       labels,
                        const Sets         sets,
                        const std::string &what,
                        Members           &members) const
  {
    const DeckScope &scope = scope_of(field, own);
    if (std::isdigit(static_cast<unsigned char>(field[0])) != 0)
      {
        members.insert(
          find(scope.*labels, text.label(field, line), what, line));
        return;
      }
    const Members &all = set_named(std::string(field), scope, sets, line);
    members.insert(all.begin(), all.end());
  }

  /** Takes the name of an instance off a field. */
  const DeckScope &
  DeckSets::scope_of(std::string_view &field, const DeckScope &own) const
  {
    const auto dot = field.find('.');
    if (dot == field.npos)
      return own;
    const auto found = instances.find(upper_case(field.substr(0, dot)));
    if (found == instances.end())
      return own;
    field.remove_prefix(dot + 1);
    return found->second;
  }

  const DeckSets::Members &
  DeckSets::set_named(const std::string &name,
                      const DeckScope   &scope,
                      const Sets         sets,
                      const DeckLine    &line) const
  {
    const auto found = (scope.*sets).find(upper_case(name));
    if (found == (scope.*sets).end())
      text.fail(line,
                std::string("there is no set of ") +
                  (sets == &DeckScope::node_sets ? "nodes" : "elements") +
                  " '" + name + "' before it");
    return found->second;
  }

  void
  DeckSets::read_surface(const DeckBlock &block, const DeckScope &scope)
  {
    const std::string name = required(block, "NAME");
    const std::string type = upper_case(block.value("TYPE"));
    if (block.has("COMBINE") ||
        (!type.empty() && type != "ELEMENT" && type != "NODE"))
      {
        skipped.insert("SURFACE, NAME=" + name);
        return;
      }
    if (block.lines.empty())
      text.fail(block.head, "the surface '" + name + "' has no members");
    for (const DeckLine &line : block.lines)
      if (type == "NODE")
        {
          Members members;
          add_members(DeckText::fields(line)[0],
                      line,
                      scope,
                      &DeckScope::nodes,
                      &DeckScope::node_sets,
                      "node",
                      members);
          for (const std::string &known : names_of(name, scope))
            groups.add_points(known, members);
        }
      else
        add_faces(name, line, scope);
  }

  void
  DeckSets::add_faces(const std::string &name,
                      const DeckLine    &line,
                      const DeckScope   &scope)
  {
    const auto fields = DeckText::fields(line);
    Members    elements;
    add_members(fields[0],
                line,
                scope,
                &DeckScope::elements,
                &DeckScope::element_sets,
                "element",
                elements);
    elements.erase(DeckScope::no_cell);
    const std::string side =
      fields.size() > 1 ? upper_case(fields[1]) : std::string();
    for (const unsigned int e : elements)
      for (const std::string &known : names_of(name, scope))
        add_side(known, e, side, line);
  }

  /** "S2", "SPOS" of a shell; empty: all sides. */
  void
  DeckSets::add_side(const std::string &name,
                     const unsigned int e,
                     const std::string &side,
                     const DeckLine    &line)
  {
    const FileMesh::Element element = mesh.elements[e];
    if (element.dim == 1)
      {
        skipped.insert("SURFACE on beams");
        return;
      }
    if (element.dim == 2 && has_solids) // a shell on a solid
      {
        groups.add_face(name, element.nodes);
        return;
      }
    const auto n = static_cast<unsigned int>(
      side.size() == 2 && side[0] == 'S' ? side[1] - '0' : 0);
    if (!side.empty() && deck_face(element, n).empty())
      text.fail(line,
                "'" + side +
                  "' is no side of such an element. Sides are "
                  "called S1, S2 and so on");
    for (unsigned int i = 1; !deck_face(element, i).empty(); ++i)
      if (const auto corners = deck_face(element, i);
          (side.empty() || i == n) && corners.size() >= element.dim)
        groups.add_face(name, corners);
  }
} // namespace conetact
