// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/deck_elements.h"

#include "conetact/base/cell_topology.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace conetact
{
  namespace
  {
    using Lists       = std::vector<std::vector<unsigned int>>;
    using ElementKind = std::pair<unsigned int, std::size_t>;

    /** Beginnings of names. The dimension; the number of nodes follows. */
    struct Family
    {
      const char  *prefix;
      unsigned int dim;
    };
    constexpr Family families[] = {
      {"C3D", 3},   {"DC3D", 3},  {"AC3D", 3}, {"F3D", 3}, {"SC", 3},
      {"CPS", 2},   {"CPE", 2},   {"CPEG", 2}, {"CAX", 2}, {"DC2D", 2},
      {"DCAX", 2},  {"S", 2},     {"STRI", 2}, {"DS", 2},  {"M3D", 2},
      {"SFM3D", 2}, {"R3D", 2},   {"B2", 1},   {"B3", 1},  {"T2D", 1},
      {"T3D", 1},   {"R2D", 1},   {"RAX", 1},  {"SAX", 1}, {"RB2D", 1},
      {"RB3D", 1},  {"PIPE2", 1}, {"PIPE3", 1}};

    /** Names of beams have their order; STRI65 has six nodes and five dofs. */
    std::size_t
    n_nodes(const Family &family, const std::size_t number)
    {
      const bool is_beam =
        family.dim == 1 && std::strchr("BP", family.prefix[0]) != nullptr;
      if (is_beam)
        return number == 2 ? 3 : 2;
      return number == 65 ? 6 : number;
    }

    /** What joins nodes without being a part of a mesh. */
    constexpr const char *no_cells[] = {"SPRING",
                                        "DASHPOT",
                                        "MASS",
                                        "ROTARYI",
                                        "GAP",
                                        "DCOUP",
                                        "CONN",
                                        "JOINT",
                                        "ITS",
                                        "HEATCAP",
                                        "DGAP",
                                        "ELBOW",
                                        "USER",
                                        "U"};

    /** Numbers of nodes that elements have, and of corners. */
    const std::map<ElementKind, std::size_t> &
    corners()
    {
      static const std::map<ElementKind, std::size_t> all = {{{1, 2}, 2},
                                                             {{1, 3}, 2},
                                                             {{2, 3}, 3},
                                                             {{2, 4}, 4},
                                                             {{2, 6}, 3},
                                                             {{2, 8}, 4},
                                                             {{3, 4}, 4},
                                                             {{3, 5}, 5},
                                                             {{3, 6}, 6},
                                                             {{3, 8}, 8},
                                                             {{3, 10}, 4},
                                                             {{3, 13}, 5},
                                                             {{3, 15}, 6},
                                                             {{3, 20}, 8}};
      return all;
    }

    /** Ends of edges in the order of middle nodes. */
    const Lists &
    edges(const ElementKind &kind)
    {
      static const std::map<ElementKind, Lists> all = {
        {{2, 3}, {{0, 1}, {1, 2}, {2, 0}}},
        {{2, 4}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
        {{3, 4}, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
        {{3, 5},
         {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}},
        {{3, 6},
         {{0, 1},
          {1, 2},
          {2, 0},
          {3, 4},
          {4, 5},
          {5, 3},
          {0, 3},
          {1, 4},
          {2, 5}}},
        {{3, 8},
         {{0, 1},
          {1, 2},
          {2, 3},
          {3, 0},
          {4, 5},
          {5, 6},
          {6, 7},
          {7, 4},
          {0, 4},
          {1, 5},
          {2, 6},
          {3, 7}}}};
      return all.at(kind);
    }

    const Lists &
    faces(const ElementKind &kind)
    {
      static const std::map<ElementKind, Lists> all = {
        {{2, 3}, {{0, 1}, {1, 2}, {2, 0}}},
        {{2, 4}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
        {{3, 4}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
        {{3, 5}, {{0, 1, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}},
        {{3, 6},
         {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}},
        {{3, 8},
         {{0, 1, 2, 3},
          {4, 7, 6, 5},
          {0, 4, 5, 1},
          {1, 5, 6, 2},
          {2, 6, 7, 3},
          {3, 7, 4, 0}}}};
      static const Lists none;
      const auto         found = all.find(kind);
      return found == all.end() ? none : found->second;
    }

    /** The place of an edge in a list, either way round. */
    std::size_t
    place_of(const std::vector<unsigned int> &edge, const Lists &list)
    {
      for (std::size_t i = 0; i < list.size(); ++i)
        if (std::is_permutation(edge.begin(), edge.end(), list[i].begin()))
          return i;
      return list.size(); // tables agree
    }
  } // namespace

  std::optional<DeckKind>
  deck_kind(const std::string &type)
  {
    for (const char *name : no_cells)
      if (type.rfind(name, 0) == 0)
        return DeckKind{0, 0};
    if (type == "D") // a pipe of a network
      return DeckKind{0, 0};
    for (const Family &family : families)
      {
        const std::string prefix = family.prefix;
        if (type.rfind(prefix, 0) != 0)
          continue;
        std::size_t n = 0, at = prefix.size();
        for (; at < type.size() && std::isdigit(type[at]); ++at)
          n = 10 * n + static_cast<std::size_t>(type[at] - '0');
        n = n_nodes(family, n);
        if (corners().count({family.dim, n}) > 0 &&
            std::all_of(type.begin() + static_cast<std::ptrdiff_t>(at),
                        type.end(),
                        [](const char c) { return std::isalnum(c) != 0; }))
          return DeckKind{family.dim, n};
      }
    return {};
  }

  FileMesh::Element
  deck_element(const DeckKind &kind, const std::vector<unsigned int> &nodes)
  {
    FileMesh::Element element{kind.dim, {}, {}};
    const auto        n = corners().at({kind.dim, kind.n_nodes});
    if (kind.dim == 1 && kind.n_nodes == 3) // the middle stands between
      {
        element.nodes   = {nodes[0], nodes[2]};
        element.middles = {nodes[1]};
        return element;
      }
    element.nodes.assign(nodes.begin(),
                         nodes.begin() + static_cast<std::ptrdiff_t>(n));
    if (n < nodes.size())
      for (const auto &edge : topology_of(kind.dim, n).edges)
        element.middles.push_back(
          nodes.at(n + place_of(edge, edges({kind.dim, n}))));
    return element;
  }

  std::vector<unsigned int>
  deck_face(const FileMesh::Element &element, const unsigned int number)
  {
    const Lists &all = faces({element.dim, element.nodes.size()});
    if (number < 1 || number > all.size())
      return {};
    std::vector<unsigned int> nodes;
    for (const unsigned int i : all[number - 1])
      if (std::find(nodes.begin(), nodes.end(), element.nodes[i]) ==
          nodes.end()) // of a collapsed cell
        nodes.push_back(element.nodes[i]);
    return nodes;
  }
} // namespace conetact
