// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_quadrature_h
#define conetact_bodies_continuum_quadrature_h

#include "conetact/bodies/continuum/continuum_mesh.h"

#include <vector>

namespace conetact
{
  /** Gauss point of a cell or face with n nodes. */
  template <unsigned int n>
  struct GaussPoint
  {
    std::array<double, n> shape; ///< values of the nodes' shape functions
    Point<3>              position;
    Tensor<1, 3>          normal; ///< outward unit normal; of faces only
    double                weight; ///< volume or area that it stands for
  };

  template <int dim>
  using CellPoints = std::vector<GaussPoint<ContinuumMesh<dim>::n_cell_nodes>>;
  template <int dim>
  using FacePoints = std::vector<GaussPoint<ContinuumMesh<dim>::n_face_nodes>>;

  /** 2^dim points: exact for fields up to the second degree. */
  template <int dim>
  CellPoints<dim>
  gauss_points(const ContinuumMesh<dim>                     &mesh,
               const typename ContinuumMesh<dim>::CellNodes &cell);

  /** 3^(dim-1) points: exact for fields up to the fourth degree. */
  template <int dim>
  FacePoints<dim>
  gauss_points(const ContinuumMesh<dim>                &mesh,
               const typename ContinuumMesh<dim>::Face &face);
} // namespace conetact

#endif
