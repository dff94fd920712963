// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_cell_shapes_h
#define conetact_bodies_continuum_cell_shapes_h

#include "conetact/bodies/continuum/continuum_mesh.h"

#include <algorithm>
#include <vector>

namespace conetact::bodies
{
  /**
   * Cells of one material that are translated copies of each other have one
   * shape: what is computed of one serves all.
   */
  template <int dim>
  class CellShapes
  {
  public:
    /** Rings round the y axis are alike where they are moved along it only. */
    CellShapes(const ContinuumMesh<dim> &mesh, const bool is_ring);

    struct Shape
    {
      unsigned int first_cell;
      unsigned int n_cells = 0;
    };
    const std::vector<Shape> &
    all() const
    {
      return shapes;
    }
    /** Which one. */
    unsigned int
    of(const unsigned int cell) const
    {
      return shape_of_cell[cell];
    }

    /** Calls visit(first, end) for cells one behind the other that have one
     * shape, so few that what they need fits into the cache. */
    template <typename Visit>
    void
    for_each_run(const Visit &visit) const
    {
      constexpr unsigned int most    = 64;
      const auto             n_cells = size();
      for (unsigned int first = 0, end = 0; first < n_cells; first = end)
        {
          const unsigned int limit = std::min(n_cells, first + most);
          for (end = first + 1; end < limit && of(end) == of(first);)
            ++end;
          visit(first, end);
        }
    }

  private:
    unsigned int
    size() const
    {
      return static_cast<unsigned int>(shape_of_cell.size());
    }

    std::vector<Shape>        shapes;
    std::vector<unsigned int> shape_of_cell;
  };
} // namespace conetact::bodies

#endif
