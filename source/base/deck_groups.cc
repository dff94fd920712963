// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/deck_groups.h"

#include "conetact/base/cell_topology.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace conetact
{
  namespace
  {
    /** Names that are numbers, also those that Cubit gives (SS2); else 0. */
    unsigned int
    number_in(const std::string &name)
    {
      const std::string kind   = name.substr(0, 2);
      const bool        cubit  = kind == "SS" || kind == "EB" || kind == "NS";
      const std::string number = cubit ? name.substr(2) : name;
      if (number.empty() || number.size() > 6 ||
          !std::all_of(number.begin(), number.end(), [](const unsigned char c) {
            return std::isdigit(c) != 0;
          }))
        return 0;
      return static_cast<unsigned int>(std::stoul(number));
    }

    using Corners = std::vector<unsigned int>;
    using Names   = std::set<std::string>;

    constexpr std::size_t inside = static_cast<std::size_t>(-1);

    Corners
    sorted(Corners corners)
    {
      std::sort(corners.begin(), corners.end());
      return corners;
    }

    /** The sets that have all these corners. */
    Names
    common(const Corners &corners, const std::vector<Names> &sets_of)
    {
      Names names = sets_of[corners[0]];
      for (const unsigned int corner : corners)
        {
          Names both;
          std::set_intersection(names.begin(),
                                names.end(),
                                sets_of[corner].begin(),
                                sets_of[corner].end(),
                                std::inserter(both, both.end()));
          names = both;
        }
      return names;
    }

    /** The corners of the sides of a cell: faces, or edges in the plane. */
    std::vector<Corners>
    sides_of(const FileMesh::Element &cell)
    {
      const CellTopology &kind  = topology_of(cell.dim, cell.nodes.size());
      auto                local = cell.dim == 2 ? kind.edges : kind.quads;
      if (cell.dim == 3)
        local.insert(local.end(), kind.triangles.begin(), kind.triangles.end());
      for (auto &side : local)
        for (unsigned int &node : side)
          node = cell.nodes[node];
      return local;
    }
  } // namespace

  void
  DeckGroups::add_elements(const std::string            &name,
                           const std::set<unsigned int> &elements)
  {
    for (const unsigned int e : elements)
      mesh.elements[e].groups.insert(number(mesh.elements[e].dim, name));
  }

  void
  DeckGroups::add_face(const std::string               &name,
                       const std::vector<unsigned int> &corners)
  {
    const unsigned int dim = corners.size() == 2 ? 1 : 2;
    face(corners).groups.insert(number(dim, name));
  }

  void
  DeckGroups::add_points(const std::string            &name,
                         const std::set<unsigned int> &points)
  {
    sets[name].insert(points.begin(), points.end());
  }

  /* Inside of a body no face is a boundary, but between two of them. */
  void
  DeckGroups::find_faces_of_points()
  {
    if (sets.empty())
      return;
    std::vector<Names> sets_of(mesh.points.size());
    for (const auto &[name, points] : sets)
      for (const unsigned int point : points)
        sets_of[point].insert(name);
    unsigned int dim = 2;
    for (const FileMesh::Element &element : mesh.elements)
      dim = std::max(dim, element.dim);
    std::map<Corners, std::size_t> first_cell;
    std::map<Corners, Names>       outer;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      if (mesh.elements[e].dim == dim)
        for (const Corners &corners : sides_of(mesh.elements[e]))
          {
            const Names names = common(corners, sets_of);
            if (names.empty())
              continue;
            const auto [found, is_new] = first_cell.emplace(sorted(corners), e);
            if (is_new)
              outer[corners] = names;
            else if (mesh.elements[found->second].groups ==
                     mesh.elements[e].groups)
              found->second = inside;
          }
    for (const auto &[corners, names] : outer)
      if (first_cell.at(sorted(corners)) != inside)
        for (const std::string &name : names)
          add_face(name, corners);
  }

  unsigned int
  DeckGroups::number(const unsigned int dim, const std::string &name)
  {
    const auto [found, is_new] = numbers.emplace(std::pair(dim, name), 0);
    if (is_new)
      {
        unsigned int n = number_in(name);
        if (n == 0 || mesh.names.count({dim, n}) > 0)
          n = own_numbers;
        while (mesh.names.count({dim, n}) > 0)
          ++n;
        found->second        = n;
        mesh.names[{dim, n}] = name;
      }
    return found->second;
  }

  FileMesh::Element &
  DeckGroups::face(const std::vector<unsigned int> &corners)
  {
    const unsigned int dim = corners.size() == 2 ? 1 : 2;
    const auto [found, is_new] =
      faces.emplace(sorted(corners), mesh.elements.size());
    if (is_new)
      mesh.elements.push_back({dim, corners, {}});
    return mesh.elements[found->second];
  }
} // namespace conetact
