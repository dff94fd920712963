// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_grids_h
#define conetact_bodies_continuum_grids_h

#include "conetact/bodies/continuum/cell_nodes.h"
#include "conetact/bodies/continuum/mesh_parameters.h"
#include "conetact/bodies/groups.h"

#include <memory>

namespace conetact::bodies
{
  /**
   * The finished mesh of quadrilaterals or hexahedra: generated or read,
   * refined on its curved geometry, then scaled, rotated, moved and tagged.
   * Its cells are straight-edged; hanging vertices lie on the straight edges
   * and faces of their coarser neighbours. `groups` are those that a file
   * names; they give zones their ids. `nodes` are those of a file of second
   * order, moved along. The last refinement of all cells may be left to
   * halved(), see MeshParameters::is_to_be_halved. Throws InputError.
   */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim, dim>>
  make_mesh(MeshParameters &parameters,
            MeshGroups     &groups,
            CellNodes<dim> &nodes);
} // namespace conetact::bodies

#endif
