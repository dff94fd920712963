// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_grid_sources_h
#define conetact_bodies_continuum_grid_sources_h

#include "conetact/bodies/continuum/cell_nodes.h"
#include "conetact/bodies/continuum/mesh_parameters.h"
#include "conetact/bodies/groups.h"

#include <memory>

namespace conetact::bodies
{
  /**
   * The coarse mesh of quadrilaterals or hexahedra, by a generator's name (with
   * its curved geometry) or from a file, which may name groups and
   * have nodes of second order. Large blocks
   * get more global refinements instead of their cells. Throws InputError.
   */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim, dim>>
  generate_or_read(MeshParameters &parameters,
                   MeshGroups     &groups,
                   CellNodes<dim> &nodes);
} // namespace conetact::bodies

#endif
