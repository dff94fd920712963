// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_cell_topology_h
#define conetact_base_cell_topology_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /** Edges and quadrilateral faces of a kind of element, by the numbers of
   * corners, in the order in which files have their middle nodes: section "Node
   * ordering" of Gmsh's reference manual. */
  struct CellTopology
  {
    std::vector<std::vector<unsigned int>> edges;
    /** Once round; a quadrilateral has itself. */
    std::vector<std::vector<unsigned int>> quads;
    /** Triangular faces; a triangle has itself. */
    std::vector<std::vector<unsigned int>> triangles;
  };

  /** Of lines, triangles, quadrilaterals, tetrahedra, pyramids, wedges and
   * hexahedra. */
  const CellTopology &
  topology_of(const unsigned int dim, const std::size_t n_corners);
} // namespace conetact

#endif
