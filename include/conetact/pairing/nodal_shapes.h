// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_nodal_shapes_h
#define conetact_pairing_nodal_shapes_h

#include <array>
#include <cstddef>
#include <vector>

namespace conetact::pairing
{
  /**
   * Shape functions of the nodes of a face at a point of the unit square or
   * triangle. Of first degree those of its corners; where it has nodes behind
   * them (bodies::n_corners), of second: products of
   * @f$(1-2a)(1-a),\ a(2a-1),\ 4a(1-a)@f$.
   */
  std::vector<double>
  nodal_shape_values(const std::size_t            n_nodes,
                     const std::size_t            n_corners,
                     const std::array<double, 2> &at);
  /** Their derivatives by the first and by the second coordinate. */
  std::array<std::vector<double>, 2>
  nodal_shape_slopes(const std::size_t            n_nodes,
                     const std::size_t            n_corners,
                     const std::array<double, 2> &at);
  /** Their integrals over a segment, triangle or parallelogram of size 1. */
  std::vector<double>
  nodal_shares(const std::size_t n_nodes, const std::size_t n_corners);
} // namespace conetact::pairing

#endif
