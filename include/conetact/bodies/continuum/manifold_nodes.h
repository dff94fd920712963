// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_manifold_nodes_h
#define conetact_bodies_continuum_manifold_nodes_h

#include "conetact/bodies/continuum/cell_nodes.h"

namespace conetact::bodies
{
  /** Nodes of second order of all active cells, on the curved geometry that a
   * generator gave the mesh. Nothing where it has none. */
  template <int dim>
  CellNodes<dim>
  nodes_on_manifolds(const dealii::Triangulation<dim> &mesh);

  /** Moves vertices of a mesh that was divided from the straight centres of
   * lines, faces and cells of the whole one onto its curved geometry. */
  template <int dim>
  void
  bend_divided_cells(const dealii::Triangulation<dim> &whole,
                     dealii::Triangulation<dim>       &divided);
} // namespace conetact::bodies

#endif
