// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/quadrature.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

namespace conetact
{
  using dealii::GeometryInfo;
  using dealii::QGauss;

  namespace
  {
    /** d-linear image of a point of the unit cell of dimension d. */
    template <int d>
    struct Image
    {
      std::array<double, (1u << d)> shape;
      Point<3>                      position;
      std::array<Tensor<1, 3>, d>   tangents;

      template <int dim>
      Image(const Point<d>                            &unit,
            const ContinuumMesh<dim>                  &mesh,
            const std::array<unsigned int, (1u << d)> &nodes)
      {
        for (unsigned int v = 0; v < nodes.size(); ++v)
          {
            const Point<3> p = to_space(mesh.nodes[nodes[v]]);
            shape[v] = GeometryInfo<d>::d_linear_shape_function(unit, v);
            position += shape[v] * Tensor<1, 3>(p);
            const Tensor<1, d> gradient =
              GeometryInfo<d>::d_linear_shape_function_gradient(unit, v);
            for (unsigned int i = 0; i < d; ++i)
              tangents[i] += gradient[i] * p;
          }
      }

      /** Normal of the size of the area element. */
      Tensor<1, 3>
      normal() const
      {
        if constexpr (d == 1)
          return Tensor<1, 3>({tangents[0][1], -tangents[0][0], 0});
        else
          return cross_product_3d(tangents[0], tangents[1]);
      }

      double
      volume() const
      {
        if constexpr (d == 2)
          return cross_product_3d(tangents[0], tangents[1])[2];
        else
          return cross_product_3d(tangents[0], tangents[1]) * tangents[2];
      }
    };
  } // namespace

  template <int dim>
  CellPoints<dim>
  gauss_points(const ContinuumMesh<dim>                     &mesh,
               const typename ContinuumMesh<dim>::CellNodes &cell)
  {
    static const QGauss<dim> gauss(2);
    CellPoints<dim>          points;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Image<dim> image(gauss.point(q), mesh, cell);
        points.push_back({image.shape,
                          image.position,
                          Tensor<1, 3>(),
                          gauss.weight(q) * image.volume()});
      }
    return points;
  }

  template <int dim>
  FacePoints<dim>
  gauss_points(const ContinuumMesh<dim>                &mesh,
               const typename ContinuumMesh<dim>::Face &face)
  {
    static const QGauss<dim - 1> gauss(3);
    FacePoints<dim>              points;
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Image<dim - 1> image(gauss.point(q), mesh, face.nodes);
        const Tensor<1, 3>   normal = image.normal();
        const double         area   = normal.norm();
        points.push_back({image.shape,
                          image.position,
                          normal / (face.inward ? -area : area),
                          gauss.weight(q) * area});
      }
    return points;
  }

  template CellPoints<2>
  gauss_points<2>(const ContinuumMesh<2> &,
                  const ContinuumMesh<2>::CellNodes &);
  template CellPoints<3>
  gauss_points<3>(const ContinuumMesh<3> &,
                  const ContinuumMesh<3>::CellNodes &);
  template FacePoints<2>
  gauss_points<2>(const ContinuumMesh<2> &, const ContinuumMesh<2>::Face &);
  template FacePoints<3>
  gauss_points<3>(const ContinuumMesh<3> &, const ContinuumMesh<3>::Face &);
} // namespace conetact
