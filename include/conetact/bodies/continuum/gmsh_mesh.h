// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_gmsh_mesh_h
#define conetact_bodies_continuum_gmsh_mesh_h

#include "conetact/bodies/continuum/mesh_parameters.h"
#include "conetact/bodies/groups.h"

#include <string>

namespace dealii
{
  template <int dim, int spacedim>
  class Triangulation;
}

namespace conetact::bodies
{
  /**
   * Makes the cells of a Gmsh file (versions 2 and 4.1) a mesh, those of the
   * groups that are asked for. Physical groups of faces become boundary ids,
   * those of cells material ids. Throws InputError.
   */
  template <int dim>
  MeshGroups
  read_gmsh_mesh(const std::string               &contents,
                 const MeshParameters            &parameters,
                 dealii::Triangulation<dim, dim> &mesh);
} // namespace conetact::bodies

#endif
