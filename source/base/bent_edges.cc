// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/bent_edges.h"

#include "conetact/base/cell_topology.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  namespace
  {
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
  bent_edges(const FileMesh                               &mesh,
             const std::vector<const FileMesh::Element *> &elements)
  {
    constexpr double straight = 1e-6; // of the length of an edge

    BentEdges              bent;
    std::set<unsigned int> seen;
    for (const FileMesh::Element *element : elements)
      {
        if (element->middles.empty())
          continue;
        const auto &edges =
          topology_of(element->dim, element->nodes.size()).edges;
        for (std::size_t e = 0; e < edges.size(); ++e)
          {
            const Point<3> &a      = mesh.points[element->nodes[edges[e][0]]];
            const Point<3> &b      = mesh.points[element->nodes[edges[e][1]]];
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
           ". The body has the corners only, with straight edges between them. "
           "If that distance is not small beside gaps and interferences, use "
           "smaller cells.";
  }
} // namespace conetact
