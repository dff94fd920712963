// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_point_search_h
#define conetact_bodies_continuum_point_search_h

#include "conetact/bodies/continuum/continuum_mesh.h"

#include <deal.II/fe/fe.h>

#include <optional>
#include <vector>

namespace conetact::bodies
{
  /** A point of a body: its cell, and shape functions of the nodes there. */
  struct PlaceInCell
  {
    unsigned int        cell;
    std::vector<double> shapes;
  };

  /** The first cell that contains the point, up to round-off; its nodes are
   * those of a scalar element. Nothing if the point is in none. */
  template <int dim>
  std::optional<PlaceInCell>
  find_cell(const ContinuumMesh<dim>         &mesh,
            const dealii::FiniteElement<dim> &element,
            const dealii::Point<dim>         &p);
} // namespace conetact::bodies

#endif
