// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_continuum_mesh_h
#define conetact_bodies_continuum_continuum_mesh_h

#include "conetact/bodies/structure.h"

#include <array>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class Triangulation;
}

namespace conetact
{
  /**
   * A mesh as plain arrays: numbered nodes, cells, boundary faces, hanging
   * nodes. Nodes are numbered like the dofs of deal.II's FE_Q(1).
   */
  template <int dim>
  struct ContinuumMesh
  {
    static constexpr unsigned int n_cell_nodes = 1u << dim;
    static constexpr unsigned int n_face_nodes = 1u << (dim - 1);
    using CellNodes = std::array<unsigned int, n_cell_nodes>;
    using FaceNodes = std::array<unsigned int, n_face_nodes>;

    struct Face
    {
      FaceNodes    nodes;
      unsigned int id;     ///< boundary id
      bool         inward; ///< direction of the normal by the nodes' order
    };

    std::vector<Point<dim>>  nodes;
    std::vector<CellNodes>   cells; ///< in the order of active cells
    std::vector<Face>        faces; ///< of the boundary
    std::vector<HangingNode> hanging;

    explicit ContinuumMesh(const dealii::Triangulation<dim, dim> &mesh);

    std::array<Point<dim>, n_cell_nodes>
    vertices(const CellNodes &cell) const
    {
      std::array<Point<dim>, n_cell_nodes> points;
      for (unsigned int v = 0; v < n_cell_nodes; ++v)
        points[v] = nodes[cell[v]];
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
} // namespace conetact

#endif
