// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/face_nodes.h"

namespace conetact::bodies
{
  std::size_t
  n_corners(const Structure &body, const SurfaceFace &face)
  {
    if (face.nodes.size() == 9)
      return 4;
    // Nodes of continua in the plane have two components.
    if (face.nodes.size() == 3 && body.n_components() == 2)
      return 2;
    return face.nodes.size();
  }

  std::vector<std::vector<unsigned int>>
  parts_of_first_degree(const Structure &body, const SurfaceFace &face)
  {
    const auto &n = face.nodes;
    if (!is_of_second_degree(body, face))
      return {n};
    if (n.size() == 3)
      return {{n[0], n[2]}, {n[2], n[1]}};
    return {{n[0], n[6], n[4], n[8]},
            {n[6], n[1], n[8], n[5]},
            {n[4], n[8], n[2], n[7]},
            {n[8], n[5], n[7], n[3]}};
  }
} // namespace conetact::bodies
