// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_mesh_files_h
#define conetact_bodies_continuum_mesh_files_h

#include "conetact/bodies/continuum/cell_nodes.h"
#include "conetact/bodies/continuum/mesh_parameters.h"
#include "conetact/bodies/groups.h"

namespace conetact::bodies
{
  /**
   * Reads the file of these parameters, whose extension says what it is. Gmsh's
   * files of version 2 and 4.1 have groups and a reader of their own; all
   * others are read by deal.II in a process apart, since its readers do not
   * check what they are told. `nodes` are those of second order. Throws
   * InputError.
   */
  template <int dim>
  MeshGroups
  read_mesh_file(const MeshParameters            &parameters,
                 dealii::Triangulation<dim, dim> &mesh,
                 CellNodes<dim>                  &nodes);
} // namespace conetact::bodies

#endif
