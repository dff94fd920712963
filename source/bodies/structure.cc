// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/structure.h"

#include "conetact/base/atomic_file.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace conetact::bodies
{
  std::vector<Tensor<1, 3>>
  smooth_patches(const std::vector<Tensor<1, 3>> &face_normals)
  {
    // nine facets round a circle turn by just this angle
    const double             cosine_of_edge = std::cos(angle_of_patches + 1e-4);
    const std::size_t        n              = face_normals.size();
    std::vector<std::size_t> patch(n);
    std::iota(patch.begin(), patch.end(), std::size_t{0});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (const Tensor<1, 3> &a = face_normals[i], &b = face_normals[j];
            a * b > cosine_of_edge * a.norm() * b.norm())
          {
            // neighbours of neighbours belong to the same patch
            const std::size_t other = patch[j], own = patch[i];
            for (std::size_t &p : patch)
              if (p == other)
                p = own;
          }
    std::vector<Tensor<1, 3>> sums(n), normals;
    for (std::size_t i = 0; i < n; ++i)
      sums[patch[i]] += face_normals[i];
    for (std::size_t i = 0; i < n; ++i)
      if (const std::size_t p = patch[i]; sums[p].norm() > 0)
        {
          normals.push_back(sums[p] / sums[p].norm());
          sums[p] = 0;
        }
    return normals;
  }

  double
  reach(const Structure &body)
  {
    double reach = 0;
    for (unsigned int node = 0; node < body.n_nodes(); ++node)
      reach = std::max(reach, body.position(node).norm());
    return reach;
  }

  void
  write_graphics(const Structure             &body,
                 const Eigen::VectorXd       &u,
                 const double                 time,
                 const std::filesystem::path &file)
  {
    write_atomically(file, body.drawing(u, u, {}).text(time, 0));
  }
} // namespace conetact::bodies
