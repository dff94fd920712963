// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_cell_stresses_h
#define conetact_bodies_continuum_cell_stresses_h

#include "conetact/bodies/continuum/cell_shapes.h"
#include "conetact/bodies/continuum/elements.h"

#include <functional>

namespace conetact::bodies
{
  /** A cell and its stresses, a column for each node. */
  template <int dim>
  using StressVisitor = std::function<
    void(const unsigned int cell,
         const Eigen::Ref<const typename ElementFormulation<dim>::Strains> &)>;

  /**
   * Stresses of all cells as they see them at their nodes: of the displacements
   * w, less those of initial strains, one a node (none given: there are none).
   * They are linear in both: of many cells that are copies of each other one
   * matrix tells them.
   */
  template <int dim>
  void
  for_each_stress(const ContinuumMesh<dim>         &mesh,
                  const Phases<dim>                &phases,
                  const CellShapes<dim>            &shapes,
                  const Eigen::VectorXd            &w,
                  const std::vector<InitialStrain> &initial,
                  const StressVisitor<dim>         &visit);
} // namespace conetact::bodies

#endif
