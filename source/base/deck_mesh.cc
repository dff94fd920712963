// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/deck_mesh.h"

#include "conetact/base/deck_elements.h"
#include "conetact/base/deck_groups.h"
#include "conetact/base/deck_lines.h"
#include "conetact/base/deck_sets.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace conetact
{
  namespace
  {
    using Members                  = DeckScope::Members;
    using Scope                    = DeckScope;
    constexpr unsigned int no_cell = DeckScope::no_cell;
    using Blocks                   = std::vector<const DeckBlock *>;

    /** Moved, then turned about an axis. */
    struct Place
    {
      Tensor<1, 3> translation, axis;
      Point<3>     on_axis;
      double       angle = 0; ///< radians

      Point<3>
      operator()(const Point<3> &p) const
      {
        const Point<3> moved = p + translation;
        if (angle == 0)
          return moved;
        const Tensor<1, 3> r = moved - on_axis;
        return on_axis + std::cos(angle) * r +
               std::sin(angle) * cross_product_3d(axis, r) +
               (1 - std::cos(angle)) * (axis * r) * axis;
      }
    };

    class Builder
    {
    public:
      Builder(const std::string &contents, const std::filesystem::path &path)
        : text(contents, path)
        , groups(mesh)
        , sets(text, mesh, groups, instances, skipped)
      {}

      FileMesh
      build()
      {
        read_parts();
        for (const auto &[name, blocks] : parts)
          if (instances.empty())
            add_instance(blocks, name, Place());
        fill(whole, whole_blocks, Place());
        groups.find_faces_of_points();
        if (mesh.elements.empty())
          throw FileFault{"it has no elements (*ELEMENT)"};
        note_skipped();
        return std::move(mesh);
      }

    private:
      /** Sorts the blocks of parts from those of the whole; instances are made
       * where they stand, behind their parts. */
      void
      read_parts()
      {
        const DeckBlock *instance = nullptr;
        Blocks           own, *part = nullptr;
        for (const DeckBlock &block : text.blocks())
          if (block.keyword == "PART")
            part = &parts[sets.required(block, "NAME")];
          else if (block.keyword == "END PART")
            part = nullptr;
          else if (block.keyword == "INSTANCE")
            {
              instance = &block;
              own.clear();
            }
          else if (block.keyword == "END INSTANCE")
            {
              if (instance == nullptr)
                text.fail(block.head, "no *INSTANCE comes before it");
              make_instance(*instance, own);
              instance = nullptr;
            }
          else
            (instance != nullptr ? own :
             part != nullptr     ? *part :
                                   whole_blocks)
              .push_back(&block);
        if (instance != nullptr)
          text.fail(instance->head, "the deck ends before *END INSTANCE");
      }

      void
      make_instance(const DeckBlock &block, const Blocks &own)
      {
        const std::string part = sets.required(block, "PART");
        const auto        found =
          std::find_if(parts.begin(), parts.end(), [&](const auto &known) {
            return upper_case(known.first) == upper_case(part);
          });
        if (found == parts.end())
          text.fail(block.head, "there is no part '" + part + "' before it");
        Blocks all = found->second;
        all.insert(all.end(), own.begin(), own.end());
        add_instance(all, sets.required(block, "NAME"), place_of(block));
      }

      Place
      place_of(const DeckBlock &block) const
      {
        Place place;
        if (!block.lines.empty())
          place.translation = point(block.lines[0], 0);
        if (block.lines.size() < 2)
          return place;
        const DeckLine &line = block.lines[1];
        place.on_axis        = point(line, 0);
        place.axis           = point(line, 3) - place.on_axis;
        if (DeckText::fields(line).size() != 7 || place.axis.norm() == 0)
          text.fail(line,
                    "a turn has two points of its axis and an angle, seven "
                    "numbers");
        place.axis /= place.axis.norm();
        place.angle =
          text.number(DeckText::fields(line)[6], line) * std::acos(-1.) / 180;
        return place;
      }

      /** Three fields; what is not there is 0. */
      Point<3>
      point(const DeckLine &line, const std::size_t first) const
      {
        const auto fields = DeckText::fields(line);
        Point<3>   p;
        for (unsigned int d = 0; d < 3 && first + d < fields.size(); ++d)
          p[d] = text.number(fields[first + d], line);
        return p;
      }

      void
      add_instance(const Blocks      &blocks,
                   const std::string &name,
                   const Place       &at)
      {
        Scope &scope = instances[upper_case(name)];
        scope.name   = name;
        fill(scope, blocks, at);
        Members all;
        for (const auto &[label, element] : scope.elements)
          if (element != no_cell)
            all.insert(element);
        groups.add_elements(name, all);
      }

      /** Nodes come first, then what names them. */
      void
      fill(Scope &scope, const Blocks &blocks, const Place &place)
      {
        for (const DeckBlock *block : blocks)
          if (block->keyword == "NODE")
            read_nodes(*block, scope, place);
        for (const DeckBlock *block : blocks)
          if (block->keyword == "ELEMENT")
            read_elements(*block, scope);
        for (const DeckBlock *block : blocks)
          if (block->keyword == "NSET")
            sets.read_node_set(*block, scope);
          else if (block->keyword == "ELSET")
            sets.read_element_set(*block, scope);
        for (const DeckBlock *block : blocks)
          if (block->keyword == "SURFACE")
            sets.read_surface(*block, scope);
          else
            pass_over(*block);
      }

      void
      pass_over(const DeckBlock &block)
      {
        static const std::set<std::string> read = {"NODE",
                                                   "ELEMENT",
                                                   "NSET",
                                                   "ELSET",
                                                   "ASSEMBLY",

                                                   "HEADING",
                                                   "PREPRINT"};
        for (const char *makes :
             {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"})
          if (block.keyword == makes)
            text.fail(block.head,
                      "*" + block.keyword +
                        " makes or moves nodes or "
                        "elements and is not read. Save the deck with all of "
                        "them written out");
        if (read.count(block.keyword) == 0 &&
            block.keyword.rfind("END ", 0) != 0)
          skipped.insert(block.keyword);
      }

      void
      note_skipped()
      {
        if (skipped.empty())
          return;
        std::vector<std::string> names;
        for (const std::string &keyword : skipped)
          if (names.size() < 5)
            names.push_back("*" + keyword);
        mesh.notes.push_back(
          "of the deck the mesh is read, not " + join(names) +
          (skipped.size() > names.size() ?
             " and " + std::to_string(skipped.size() - names.size()) +
               " other keywords" :
             ""));
      }

      void
      read_nodes(const DeckBlock &block, Scope &scope, const Place &place)
      {
        if (!block.value("SYSTEM").empty() &&
            upper_case(block.value("SYSTEM")) != "R")
          text.fail(block.head,
                    "nodes in cylindrical or spherical coordinates are not "
                    "read. Save them in rectangular ones");
        Members all;
        for (const DeckLine &line : block.lines)
          {
            const auto     fields      = DeckText::fields(line);
            const auto     label       = text.label(fields[0], line);
            const Point<3> p           = place(point(line, 1));
            const auto [found, is_new] = scope.nodes.emplace(
              label, static_cast<unsigned int>(mesh.points.size()));
            if (is_new)
              mesh.points.push_back(p);
            else if (mesh.points[found->second].distance(p) > 0)
              text.fail(line,
                        "the node " + std::to_string(label) +
                          " stands there twice, at two places");
            all.insert(found->second);
          }
        if (block.has("NSET"))
          sets.name_points(block.value("NSET"), all, scope);
      }

      void
      read_elements(const DeckBlock &block, Scope &scope)
      {
        const std::string type = upper_case(sets.required(block, "TYPE"));
        const auto        kind = deck_kind(type);
        if (!kind)
          text.fail(block.head,
                    "the element type '" + type +
                      "' is not known. Solids "
                      "such as C3D4, C3D8, C3D10, C3D20, plane ones such as "
                      "CPS4 and CAX8 and shells (as surfaces) are");
        Members                   all;
        std::vector<unsigned int> numbers;
        DeckLine                  first{};
        for (const DeckLine &line : block.lines)
          {
            if (numbers.empty())
              first = line;
            for (const auto &field : DeckText::fields(line))
              if (kind->dim > 0 || numbers.empty())
                numbers.push_back(text.label(field, line));
            if (numbers.size() <= kind->n_nodes)
              continue;
            all.insert(add_element(*kind, type, numbers, first, scope));
            numbers.clear();
          }
        if (!numbers.empty())
          refuse_number_of_nodes(type, *kind, numbers, first);
        all.erase(no_cell);
        if (block.has("ELSET"))
          sets.name_elements(block.value("ELSET"), all, scope);
      }

      [[noreturn]] void
      refuse_number_of_nodes(const std::string               &type,
                             const DeckKind                  &kind,
                             const std::vector<unsigned int> &numbers,
                             const DeckLine                  &line) const
      {
        text.fail(line,
                  "the element " + std::to_string(numbers[0]) + " has " +
                    std::to_string(numbers.size() - 1) + " nodes, but a " +
                    type + " has " + std::to_string(kind.n_nodes));
      }

      unsigned int
      add_element(const DeckKind                  &kind,
                  const std::string               &type,
                  const std::vector<unsigned int> &numbers,
                  const DeckLine                  &line,
                  Scope                           &scope)
      {
        if (kind.dim == 0)
          {
            scope.elements.emplace(numbers[0], no_cell);
            return no_cell;
          }
        if (numbers.size() != kind.n_nodes + 1)
          refuse_number_of_nodes(type, kind, numbers, line);
        std::vector<unsigned int> points;
        for (std::size_t i = 1; i < numbers.size(); ++i)
          points.push_back(sets.find(scope.nodes, numbers[i], "node", line));
        const auto number = static_cast<unsigned int>(mesh.elements.size());
        const auto [found, is_new] = scope.elements.emplace(numbers[0], number);
        if (!is_new && found->second != no_cell)
          text.fail(line,
                    "the element " + std::to_string(numbers[0]) +
                      " stands there twice");
        found->second = number;
        mesh.elements.push_back(deck_element(kind, points));
        sets.has_solids = sets.has_solids || kind.dim == 3;
        return number;
      }

      DeckText                      text;
      FileMesh                      mesh;
      DeckGroups                    groups;
      std::map<std::string, Blocks> parts; ///< by their names
      Blocks                        whole_blocks;
      Scope                         whole;
      std::map<std::string, Scope>  instances; ///< by upper case names
      std::set<std::string>         skipped;
      DeckSets                      sets;
    };
  } // namespace

  FileMesh
  read_deck(const std::string &contents, const std::filesystem::path &path)
  {
    return Builder(contents, path).build();
  }
} // namespace conetact
