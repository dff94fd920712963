// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/nodal_shapes.h"

#include "conetact/pairing/closest_point.h"

#include <deal.II/base/exceptions.h>

namespace conetact::pairing
{
  namespace
  {
    /** Products of what the ends and the middle of a segment have, in the order
     * of deal.II: corners, edges a = 0, a = 1, b = 0, b = 1, the middle. */
    std::vector<double>
    products(const std::size_t            n_nodes,
             const std::array<double, 3> &a,
             const std::array<double, 3> &b)
    {
      if (n_nodes == 3)
        return {a.begin(), a.end()};
      return {a[0] * b[0],
              a[1] * b[0],
              a[0] * b[1],
              a[1] * b[1],
              a[0] * b[2],
              a[1] * b[2],
              a[2] * b[0],
              a[2] * b[1],
              a[2] * b[2]};
    }
    /** Functions l (2 l - 1) of the corners and 4 l l' of the middles of the
     * edges 01, 12, 20, with the area coordinates l. */
    std::vector<double>
    of_triangle(const double a, const double b)
    {
      const double c = 1 - a - b;
      return {c * (2 * c - 1),
              a * (2 * a - 1),
              b * (2 * b - 1),
              4 * c * a,
              4 * a * b,
              4 * b * c};
    }
  } // namespace

  std::vector<double>
  nodal_shape_values(const std::size_t            n_nodes,
                     const std::size_t            n_corners,
                     const std::array<double, 2> &at)
  {
    Assert(n_nodes >= n_corners, dealii::ExcMessage("Corners are nodes."));
    if (n_nodes == n_corners)
      {
        const auto of_corners = shape_values(n_corners, at);
        return {of_corners.begin(),
                of_corners.begin() + static_cast<std::ptrdiff_t>(n_corners)};
      }
    if (n_corners == 3)
      return of_triangle(at[0], at[1]);
    const auto of_segment = [](const double a) {
      return std::array<double, 3>{
        {(1 - 2 * a) * (1 - a), a * (2 * a - 1), 4 * a * (1 - a)}};
    };
    return products(n_nodes, of_segment(at[0]), of_segment(at[1]));
  }

  /* Differences over half a unit to either side are exact for functions of
     second degree in each coordinate. */
  std::array<std::vector<double>, 2>
  nodal_shape_slopes(const std::size_t            n_nodes,
                     const std::size_t            n_corners,
                     const std::array<double, 2> &at)
  {
    std::array<std::vector<double>, 2> slopes;
    for (std::size_t d = 0; d < 2; ++d)
      {
        auto before = at, behind = at;
        before[d] -= .5;
        behind[d] += .5;
        slopes[d]        = nodal_shape_values(n_nodes, n_corners, behind);
        const auto lower = nodal_shape_values(n_nodes, n_corners, before);
        for (std::size_t i = 0; i < n_nodes; ++i)
          slopes[d][i] -= lower[i];
      }
    return slopes;
  }

  /* The integral of each shape function over a parallelogram, a triangle or a
     segment, over its area: the part of a uniform pressure that a node gets. */
  std::vector<double>
  nodal_shares(const std::size_t n_nodes, const std::size_t n_corners)
  {
    Assert(n_nodes >= n_corners, dealii::ExcMessage("Corners are nodes."));
    if (n_nodes == n_corners)
      return std::vector<double>(n_nodes, 1. / static_cast<double>(n_nodes));
    if (n_corners == 3)
      // A uniform pressure leaves the corners of six nodes without any force.
      return {0, 0, 0, 1. / 3, 1. / 3, 1. / 3};
    // Simpson's rule.
    constexpr std::array<double, 3> of_segment = {{1. / 6, 1. / 6, 4. / 6}};
    return products(n_nodes, of_segment, of_segment);
  }
} // namespace conetact::pairing
