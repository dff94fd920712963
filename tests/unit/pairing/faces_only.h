// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_faces_only_h
#define conetact_tests_faces_only_h

#include <numeric>

#include "empty_structure.h"

namespace conetact::test
{
  using namespace bodies;

  /**
   * A body of which there is nothing but faces: nodes, and for each face its
   * nodes, turned outward, and its boundary id.
   */
  class FacesOnly : public EmptyStructure
  {
  public:
    struct Face
    {
      std::vector<unsigned int> nodes;
      unsigned int              id = 0;
    };
    FacesOnly(std::vector<Point<3>> p, std::vector<Face> f, const bool sheet)
      : points(std::move(p))
      , faces(std::move(f))
      , two_sided(sheet)
    {}

    unsigned int
    n_nodes() const override
    {
      return static_cast<unsigned int>(points.size());
    }
    unsigned int
    n_components() const override
    {
      return 3;
    }
    Point<3>
    position(const unsigned int node) const override
    {
      return points[node];
    }
    BoundaryIds
    boundary_ids() const override
    {
      BoundaryIds ids;
      for (const Face &face : faces)
        ids.insert(face.id);
      return ids;
    }
    /** Faces alone: pairing asks no more of a master. */
    Surface
    surface(const BoundaryIds &ids) const override
    {
      Surface result;
      result.two_sided = two_sided;
      for (const Face &face : faces)
        if (ids.count(face.id) > 0)
          result.faces.push_back({face.nodes, normal(face)});
      return result;
    }

  private:
    Tensor<1, 3>
    normal(const Face &face) const
    {
      const auto at = [&](const std::size_t i) {
        return points[face.nodes[i]];
      };
      const Tensor<1, 3> a = at(1) - at(0);
      const Tensor<1, 3> n = face.nodes.size() == 2 ?
                               Tensor<1, 3>({a[1], -a[0], 0.}) :
                               cross_product_3d(at(3) - at(0), at(2) - at(1));
      return n / n.norm();
    }

    std::vector<Point<3>> points;
    std::vector<Face>     faces;
    bool                  two_sided;
  };

  /** The unit cube, n cells a direction; ids 0 to 5 as in deal.II. */
  inline FacesOnly
  cube(const unsigned int n)
  {
    std::vector<Point<3>> points;
    const unsigned int    m = n + 1;
    for (unsigned int i = 0; i < m * m * m; ++i)
      points.emplace_back(double(i % m) / n,
                          double(i / m % m) / n,
                          double(i / (m * m)) / n);
    std::vector<FacesOnly::Face> faces;
    for (unsigned int id = 0; id < 6; ++id)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          {
            const unsigned int stride[3] = {1, m, m * m}, d = id / 2;
            const unsigned int s = stride[(d + 1) % 3], t = stride[(d + 2) % 3];
            const unsigned int first =
              (id % 2 == 1 ? n * stride[d] : 0) + j * s + k * t;
            if (id % 2 == 1)
              faces.push_back(
                {{first, first + s, first + t, first + s + t}, id});
            else
              faces.push_back(
                {{first, first + t, first + s, first + s + t}, id});
          }
    return FacesOnly(std::move(points), std::move(faces), false);
  }

  /** The unit square; ids 0 to 3 as in deal.II. */
  inline FacesOnly
  square()
  {
    return FacesOnly({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                     {{{3, 0}, 0}, {{1, 2}, 1}, {{0, 1}, 2}, {{2, 3}, 3}},
                     false);
  }
} // namespace conetact::test

#endif
