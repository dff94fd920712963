// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_probes_h
#define conetact_bodies_probes_h

#include "conetact/bodies/structure.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace conetact::bodies
{
  /**
   * A chosen point of a body whose displacement is wanted,
   * @f$u_c(p) = \sum_i N_{ci}(p)\,u_i@f$ [length]: the shape functions N are
   * those that share out a point force there.
   */
  struct Probe
  {
    std::string  name;
    unsigned int body = 0;
    Point<3>     point; ///< undeformed
    /** Dofs of the body and their shape functions, for each component. */
    std::vector<std::vector<std::pair<Eigen::Index, double>>> shapes;

    /** From all dofs of its body. */
    template <class Vector>
    Tensor<1, 3>
    displacement(const Vector &u) const
    {
      Tensor<1, 3> sum;
      for (unsigned int c = 0; c < shapes.size(); ++c)
        for (const auto &[dof, shape] : shapes[c])
          sum[c] += shape * u[dof];
      return sum;
    }
  };

  /** Dofs of a body and their shape functions at a point, of a component; unit
   * forces tell. None if no cell holds the point. */
  std::optional<std::vector<std::pair<Eigen::Index, double>>>
  shapes_at(const Structure   &structure,
            const Point<3>    &point,
            const unsigned int component);

  /**
   * "tip: 1, 0 ; middle in block: 0.5, 0": names and points, with a body where
   * several hold the point. Throws InputError that names the entry.
   */
  std::vector<Probe>
  parse_probes(const std::string                    &text,
               const unsigned int                    dim,
               const std::vector<std::string>       &names,
               const std::vector<const Structure *> &bodies,
               const std::string                    &entry);
} // namespace conetact::bodies

#endif
