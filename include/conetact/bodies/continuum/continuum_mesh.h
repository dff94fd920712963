// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_continuum_mesh_h
#define conetact_bodies_continuum_continuum_mesh_h

#include "conetact/base/counting_list.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <vector>

namespace conetact::bodies
{
  /**
   * Nodes and cells of a mesh as plain arrays, for what runs over all of them
   * often. All cells have the same number of nodes, in deal.II's order.
   */
  template <int dim>
  struct ContinuumMesh
  {
    std::vector<Point<dim>>   nodes;
    unsigned int              n_cell_nodes = 0;
    std::vector<unsigned int> nodes_of_cells; ///< one cell by another
    CountingList              material_ids;   ///< of the cells, as in the file
    std::vector<HangingNode>  hanging;
    std::vector<unsigned int> phase_of_cell; ///< empty: one for all
    /** The numbers of deal.II's active cells here; empty: the same. */
    std::vector<unsigned int> number_of_active;

    unsigned int
    n_cells() const
    {
      return static_cast<unsigned int>(nodes_of_cells.size()) / n_cell_nodes;
    }
    dealii::ArrayView<const unsigned int>
    cell(const unsigned int number) const
    {
      return {&nodes_of_cells[std::size_t{number} * n_cell_nodes],
              n_cell_nodes};
    }
    /** The cell that is deal.II's active one of this index. */
    unsigned int
    number(const unsigned int active) const
    {
      return number_of_active.empty() ? active : number_of_active[active];
    }
    /** Which of the body's materials. */
    unsigned int
    phase(const unsigned int number) const
    {
      return phase_of_cell.empty() ? 0 : phase_of_cell[number];
    }
    std::vector<Point<dim>>
    vertices(const unsigned int number) const
    {
      std::vector<Point<dim>> points;
      points.reserve(n_cell_nodes);
      for (const unsigned int node : cell(number))
        points.push_back(nodes[node]);
      return points;
    }
  };

  /** With z = 0 in 2D. */
  template <int dim>
  Point<3>
  to_space(const Point<dim> &p)
  {
    Point<3> q;
    for (unsigned int d = 0; d < dim; ++d)
      q[d] = p[d];
    return q;
  }
  /** The inverse: in the plane without z. */
  template <int dim>
  Point<dim>
  from_space(const Point<3> &p)
  {
    Point<dim> q;
    for (unsigned int d = 0; d < dim; ++d)
      q[d] = p[d];
    return q;
  }
  template <int dim>
  Tensor<1, 3>
  to_space(const Tensor<1, dim> &v)
  {
    return to_space(Point<dim>(v));
  }
} // namespace conetact::bodies

#endif
