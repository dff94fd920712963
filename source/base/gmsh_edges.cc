// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/gmsh_edges.h"

#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  namespace
  {
    using Edges = std::vector<std::pair<unsigned int, unsigned int>>;

    /** The ends of edges in the order of their middle nodes: section "Node
     * ordering" of Gmsh's reference manual. */
    const Edges &
    edges_of(const unsigned int dim, const std::size_t n_corners)
    {
      static const std::map<std::pair<unsigned int, std::size_t>, Edges> all = {
        {{1, 2}, {{0, 1}}},
        {{2, 3}, {{0, 1}, {1, 2}, {2, 0}}},
        {{2, 4}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
        {{3, 4}, {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}},
        {{3, 5},
         {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}},
        {{3, 6},
         {{0, 1},
          {0, 2},
          {0, 3},
          {1, 2},
          {1, 4},
          {2, 5},
          {3, 4},
          {3, 5},
          {4, 5}}},
        {{3, 8},
         {{0, 1},
          {0, 3},
          {0, 4},
          {1, 2},
          {1, 5},
          {2, 3},
          {2, 6},
          {3, 7},
          {4, 5},
          {4, 7},
          {5, 6},
          {6, 7}}}};
      static const Edges none;
      const auto         found = all.find({dim, n_corners});
      return found == all.end() ? none : found->second;
    }

    /** Of p from the straight line through a and b. */
    double
    distance_from_line(const Point<3> &p, const Point<3> &a, const Point<3> &b)
    {
      const Tensor<1, 3> along = b - a;
      if (along.norm() == 0)
        return p.distance(a);
      return cross_product_3d(along, p - a).norm() / along.norm();
    }
  } // namespace

  BentEdges
  bent_edges(const GmshMesh                               &mesh,
             const std::vector<const GmshMesh::Element *> &elements)
  {
    constexpr double straight = 1e-6; // of the length of an edge

    BentEdges              bent;
    std::set<unsigned int> seen;
    for (const GmshMesh::Element *element : elements)
      {
        const Edges &edges = edges_of(element->dim, element->nodes.size());
        for (std::size_t e = 0; e < element->middles.size(); ++e)
          {
            const Point<3> &a = mesh.points[element->nodes[edges[e].first]];
            const Point<3> &b = mesh.points[element->nodes[edges[e].second]];
            const Point<3> &middle = mesh.points[element->middles[e]];
            const double    off    = distance_from_line(middle, a, b);
            if (off <= straight * a.distance(b) ||
                !seen.insert(element->middles[e]).second)
              continue;
            ++bent.n;
            if (off > bent.distance)
              {
                bent.distance = off;
                bent.place    = middle;
              }
          }
      }
    return bent;
  }

  std::string
  to_sentence(const BentEdges   &edges,
              const std::string &file,
              const double       scale,
              const Point<3>    &place)
  {
    if (edges.n == 0)
      return "";
    return "the middle nodes of " + std::to_string(edges.n) + " edges of '" +
           file + "' lie beside the straight lines between corners, by up to " +
           to_text(scale * edges.distance) + " at " + to_text(place) +
           ". Only corners are taken and edges are straight. Where that is not "
           "small beside gaps and interferences, use smaller cells.";
  }
} // namespace conetact
