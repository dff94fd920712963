// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_graphics_h
#define conetact_bodies_continuum_graphics_h

#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/elements.h"
#include "conetact/bodies/continuum/material.h"

namespace conetact::bodies
{
  /**
   * VTU of the undeformed mesh with nodal fields: `displacement` (3), `stress`
   * (9, the full tensor by rows; in plane strain with sigma_zz), `von_mises`
   * (1), and the time as field data TIME. The displacement is u, the stresses
   * are those of the deformation w, of the cells at their vertices less those
   * of the change of temperature there ([K], one a node), averaged at the
   * nodes; von Mises' is that of the averaged tensor. Throws WriteError.
   */
  template <int dim>
  void
  write_continuum(const ContinuumMesh<dim>    &mesh,
                  const Phases<dim>           &phases,
                  const Eigen::VectorXd       &u,
                  const Eigen::VectorXd       &w,
                  const Eigen::VectorXd       &temperature,
                  const double                 time,
                  const std::filesystem::path &file);
} // namespace conetact::bodies

#endif
