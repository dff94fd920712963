// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/facets.h"

#include "conetact/bodies/face_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    using Faces = std::vector<FaceNet::Face>;

    /** Normals that differ by less are those of one plane. */
    constexpr double one_plane = 1e-6;
    /**
     * So many vertices of a facet are looked at: ends of long strips suffice.
     */
    constexpr std::size_t most_vertices = 64;
    /** Neighbours on a curved surface are alike: their widths differ by less
     * than this factor. */
    constexpr double alike = 4;

    using Corner  = std::pair<std::size_t, std::size_t>; ///< of a face
    using Corners = std::map<unsigned int, std::vector<Corner>>;

    Corners
    face_corners_at_nodes(const Faces &faces)
    {
      Corners corners;
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t c = 0; c < faces[f].corners.size(); ++c)
          corners[faces[f].nodes[c]].emplace_back(f, c);
      return corners;
    }

    /**
     * The weight of a face in the normal of a vertex, |a x b| / (|a|^2 |b|^2)
     * with the edges a, b there: so that the normal is exact where the vertices
     * are on a circle or a sphere, whatever the sizes of faces (Max, J.
     * Graphics Tools 4 (1999) 1-6).
     */
    double
    weight(const FaceNet::Face &face, const std::size_t corner)
    {
      const auto &x = face.corners;
      if (x.size() == 2)
        return 1 / x[0].distance(x[1]);
      // quadrilaterals stand row by row
      static constexpr std::size_t beside[4][2] = {{1, 2},
                                                   {0, 3},
                                                   {0, 3},
                                                   {1, 2}};
      const std::size_t            one =
        x.size() == 3 ? (corner + 1) % 3 : beside[corner][0];
      const std::size_t two =
        x.size() == 3 ? (corner + 2) % 3 : beside[corner][1];
      const Tensor<1, 3> a = x[one] - x[corner], b = x[two] - x[corner];
      return cross_product_3d(a, b).norm() /
             (a.norm_square() * b.norm_square());
    }

    /** The first face of the facet that each face is a part of. */
    std::vector<std::size_t>
    join_planes(const Faces &faces, const Corners &corners)
    {
      std::vector<std::size_t> facet(faces.size());
      std::iota(facet.begin(), facet.end(), std::size_t{0});
      const auto root = [&](std::size_t f) {
        while (facet[f] != f)
          f = facet[f] = facet[facet[f]];
        return f;
      };
      for (const auto &[node, here] : corners)
        for (std::size_t i = 1; i < here.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            if ((faces[here[i].first].outward - faces[here[j].first].outward)
                  .norm() < one_plane)
              facet[root(here[i].first)] = root(here[j].first);
      for (std::size_t f = 0; f < faces.size(); ++f)
        facet[f] = root(f);
      return facet;
    }

    /** A vertex of a facet where its neighbours turn away from it. */
    struct Turn
    {
      Point<3>     position;
      Tensor<1, 3> turn; ///< normal of the vertex less that of the facet
    };

    struct Facet
    {
      std::map<unsigned int, Turn> turns; ///< by node
      std::set<std::size_t>        beside;
      double                       sagitta = 0, width = 0; ///< [length]
    };

    /** The facets, by their first face, with what turns beside them. */
    std::map<std::size_t, Facet>
    find_turns(const Faces                    &faces,
               const Corners                  &corners,
               const std::vector<std::size_t> &facet_of)
    {
      // Edges of 30 degrees, whatever their rounding, are meant: no normal is
      // averaged across them.
      const double                 smooth = std::cos(M_PI / 6) + 1e-9;
      std::map<std::size_t, Facet> facets;
      for (const auto &[node, here] : corners)
        for (const auto &[f, c] : here)
          {
            Facet &own = facets[facet_of[f]];
            if (own.turns.count(node) > 0)
              continue;
            const Tensor<1, 3> &normal = faces[f].outward;
            Tensor<1, 3>        sum;
            for (const auto &[g, d] : here)
              if (faces[g].outward * normal > smooth)
                {
                  sum += weight(faces[g], d) * faces[g].outward;
                  if (facet_of[g] != facet_of[f])
                    own.beside.insert(facet_of[g]);
                }
            const Tensor<1, 3> turn = sum / sum.norm() - normal;
            if (turn.norm() > one_plane)
              own.turns[node] = {faces[f].corners[c], turn};
          }
      return facets;
    }

    /**
     * Takes the sagitta s from the two vertices that turn most against each
     * other. On a circle of radius R the normal of a vertex turns from that of
     * its facet, h long, by h / 2R, so that turn . d = h^2 / 2R = 4 s with the
     * chord d. Both must turn in the same sense, and the smaller turn counts:
     * at the end of a curve one is that of a plane.
     */
    void
    measure_facet(Facet &facet)
    {
      std::vector<const Turn *> turns;
      const std::size_t         step = facet.turns.size() / most_vertices + 1;
      std::size_t               i    = 0;
      for (const auto &[node, turn] : facet.turns)
        if (i++ % step == 0)
          turns.push_back(&turn);
      for (const Turn *a : turns)
        for (const Turn *b : turns)
          {
            const Tensor<1, 3> d    = b->position - a->position;
            const double       at_b = b->turn * d, at_a = -(a->turn * d);
            if (at_a * at_b <= 0)
              continue;
            const double sagitta =
              .25 * std::min(std::abs(at_a), std::abs(at_b));
            if (sagitta > facet.sagitta)
              {
                facet.sagitta = sagitta;
                facet.width =
                  4 * sagitta / std::max(a->turn.norm(), b->turn.norm());
              }
          }
    }

    /** Tells whether a facet beside this one belongs to the same curved
     * surface. */
    bool
    is_of_curve(const Facet &facet, const std::map<std::size_t, Facet> &facets)
    {
      return facet.sagitta > 0 &&
             std::any_of(facet.beside.begin(),
                         facet.beside.end(),
                         [&](const std::size_t other) {
                           const double width = facets.at(other).width;
                           return width > 0 && width < alike * facet.width &&
                                  facet.width < alike * width;
                         });
    }

    /** Tells whether the face itself follows the curve. */
    bool
    is_bent(const FaceNet::Face &face)
    {
      if (face.middles.empty())
        return false;
      const std::size_t n = face.corners.size();
      return bodies::is_bent(
        n == 2 ? 2 : 3,
        face.nodes.size(),
        [&](const std::size_t i) -> const Point<3> & {
          return i < n ? face.corners[i] : face.middles[i - n];
        },
        one_plane *face.size);
    }

    double
    found_at(const std::map<unsigned int, double> &values,
             const unsigned int                    node)
    {
      const auto found = values.find(node);
      return found == values.end() ? 0 : found->second;
    }
  } // namespace

  Facets::Facets(const Faces &faces)
    : around_face(faces.size(), 0.)
  {
    const Corners corners  = face_corners_at_nodes(faces);
    const auto    facet_of = join_planes(faces, corners);
    auto          facets   = find_turns(faces, corners, facet_of);
    for (auto &[number, facet] : facets)
      measure_facet(facet);
    const auto largest_at = [&](std::map<unsigned int, double> &values) {
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (const unsigned int node : faces[f].nodes)
          if (double &value = values[node]; around_face[f] > value)
            value = around_face[f];
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (const Facet &facet = facets[facet_of[f]]; is_bent(faces[f]))
        for (const unsigned int node : faces[f].nodes)
          bent_node[node] = std::max(bent_node[node], facet.sagitta);
      else if (is_of_curve(facet, facets))
        {
          around_face[f] = facet.sagitta;
          for (const unsigned int node : faces[f].nodes)
            if (facet.turns.count(node) == 0)
              below_node[node] = std::max(below_node[node], facet.sagitta);
        }
    // At its ends a curved surface turns on one side only: it is as curved
    // there as beside.
    std::map<unsigned int, double> inside;
    largest_at(inside);
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const unsigned int node : faces[f].nodes)
        around_face[f] = std::max(around_face[f], inside[node]);
    largest_at(around_node);
  }

  double
  Facets::at(const unsigned int node) const
  {
    return found_at(around_node, node);
  }

  double
  Facets::bent_at(const unsigned int node) const
  {
    return found_at(bent_node, node);
  }

  double
  Facets::of_node(const unsigned int node) const
  {
    return found_at(below_node, node);
  }

  double
  Facets::largest() const
  {
    return around_face.empty() ?
             0. :
             *std::max_element(around_face.begin(), around_face.end());
  }
} // namespace conetact::pairing
