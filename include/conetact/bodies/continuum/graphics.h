// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_graphics_h
#define conetact_bodies_continuum_graphics_h

#include "conetact/bodies/continuum/cell_shapes.h"
#include "conetact/bodies/continuum/elements.h"
#include "conetact/bodies/continuum/material.h"

namespace conetact::bodies
{
  /**
   * The undeformed mesh with nodal fields: `displacement` (3), `stress` (9, the
   * full tensor by rows; in plane strain with sigma_zz), `von_mises` (1),
   * `strain` (9, the whole one, with the initial one),
   * `principal_stresses` and `principal_strains` (3, the largest first); and
   * `material_id` of the cells. The displacement is u. The stresses are those
   * of the deformation w, of the cells at their vertices less those of the
   * initial strains there (one a node; none given: there are none), averaged at
   * the nodes of each material; all else follows from these means.
   */
  template <int dim>
  VtuGrid
  draw_continuum(const ContinuumMesh<dim>         &mesh,
                 const Phases<dim>                &phases,
                 const CellShapes<dim>            &shapes,
                 const Eigen::VectorXd            &u,
                 const Eigen::VectorXd            &w,
                 const std::vector<InitialStrain> &initial);
} // namespace conetact::bodies

#endif
