// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_halved_cells_h
#define conetact_bodies_continuum_halved_cells_h

#include "conetact/bodies/continuum/boundary_face.h"
#include "conetact/bodies/continuum/continuum_mesh.h"

#include <vector>

namespace conetact::bodies
{
  /**
   * The mesh after one more refinement of all its cells, quadrilaterals or
   * hexahedra of first degree without hanging nodes: new nodes are in the
   * middle of edges, faces and cells. Cells and nodes are numbered as after
   * deal.II's refine_global(1), which takes ten times the memory.
   */
  template <int dim>
  ContinuumMesh<dim>
  halved(const ContinuumMesh<dim> &mesh);

  /** Its boundary faces, with the ids of those that they are parts of: these
   * come cell by cell. */
  template <int dim>
  std::vector<BoundaryFace>
  halved(const std::vector<BoundaryFace> &faces,
         const ContinuumMesh<dim>        &halved_mesh);
} // namespace conetact::bodies

#endif
