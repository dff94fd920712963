// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_file_cells_h
#define conetact_bodies_continuum_file_cells_h

#include "conetact/base/file_mesh.h"
#include "conetact/bodies/continuum/cell_nodes.h"
#include "conetact/bodies/continuum/mesh_parameters.h"
#include "conetact/bodies/groups.h"

namespace conetact::bodies
{
  /**
   * Makes the cells of a file a mesh, those of the groups that are asked for.
   * Groups of faces become boundary ids, those of cells material ids; `nodes`
   * are those of second order. Throws InputError.
   */
  template <int dim>
  MeshGroups
  make_cells(const FileMesh                  &file,
             const MeshParameters            &parameters,
             dealii::Triangulation<dim, dim> &mesh,
             CellNodes<dim>                  &nodes);
} // namespace conetact::bodies

#endif
