// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_material_groups_h
#define conetact_bodies_continuum_material_groups_h

#include "conetact/bodies/continuum/material.h"
#include "conetact/bodies/groups.h"

#include <string>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class Triangulation;
}

namespace conetact::bodies
{
  /**
   * The material id of each cell becomes the place of its material in the
   * list; `groups` are the groups of cells by name. Throws InputError where a
   * cell has none or several.
   */
  template <int dim>
  void
  set_materials(dealii::Triangulation<dim, dim>     &mesh,
                const std::vector<MaterialOfGroups> &materials,
                const MeshGroups::Ids               &groups,
                const std::string                   &body);
} // namespace conetact::bodies

#endif
