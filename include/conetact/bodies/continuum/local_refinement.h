// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_local_refinement_h
#define conetact_bodies_continuum_local_refinement_h

#include "conetact/bodies/continuum/mesh_parameters.h"
#include "conetact/bodies/groups.h"

namespace dealii
{
  template <int dim, int spacedim>
  class Triangulation;
}

namespace conetact::bodies
{
  /**
   * Refines a mesh that is neither scaled, rotated, moved nor tagged yet: cells
   * in boxes first, then those beside boundaries. Throws InputError where a box
   * holds no cell or no face has the id of a boundary; `groups` name ids.
   */
  template <int dim>
  void
  refine_locally(dealii::Triangulation<dim, dim> &mesh,
                 const MeshParameters            &parameters,
                 const MeshGroups::Ids           &groups);

  /** Divides active cells by their numbers, once for each set of them. */
  template <int dim>
  void
  refine_elements(dealii::Triangulation<dim, dim> &mesh,
                  const Refinements               &refinements);
} // namespace conetact::bodies

#endif
