// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/spread_force.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>

namespace conetact::bodies
{
  namespace
  {
    using Function =
      std::function<double(const Point<3> &, const Tensor<1, 3> &)>;

    /** Of a function over the faces, as tractions are integrated. */
    double
    integral(const Structure   &body,
             const BoundaryIds &ids,
             const Function    &function)
    {
      constexpr unsigned int y = 1; // which bodies of revolution have as well
      Eigen::VectorXd        f =
        Eigen::VectorXd::Zero(body.n_nodes() * body.n_components());
      body.add_traction(
        ids,
        [&](const Point<3> &p, const Tensor<1, 3> &normal) {
          Tensor<1, 3> traction;
          traction[y] = function(p, normal);
          return traction;
        },
        f);
      double sum = 0;
      for (unsigned int node = 0; node < body.n_nodes(); ++node)
        sum += f[node * body.n_components() + y];
      return sum;
    }

    /** Faces on a line have no inertia about it, however it lies: it is left
     * out. */
    Tensor<2, 3>
    inverse(const Tensor<2, 3> &J)
    {
      constexpr double none = 1e-12; // of the sum: rounding
      Eigen::Matrix3d  matrix;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix(i, j) = J[i][j];
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix);
      const double                                         size = trace(J);
      const Eigen::Vector3d                                of_axes =
        axes.eigenvalues().unaryExpr([&](const double value) {
          return value > none * size ? 1 / value : 0.;
        });
      matrix = axes.eigenvectors() * of_axes.asDiagonal() *
               axes.eigenvectors().transpose();
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i][j] = matrix(i, j);
      return result;
    }
  } // namespace

  SpreadForce::SpreadForce(const Structure   &of,
                           const BoundaryIds &on,
                           const std::string &in)
    : body(of)
    , ids(on)
    , where(in)
    , area(integral(body, ids, [](const Point<3> &, const Tensor<1, 3> &) {
      return 1.;
    }))
  {
    if (!(area > 0))
      throw InputError(in + "Boundary ids: they have no faces that a force "
                            "could be spread over. Give those of faces of a "
                            "continuum, or choose a nodal force.");
    for (unsigned int d = 0; d < 3; ++d)
      centre[d] = integral(body,
                           ids,
                           [d](const Point<3> &p, const Tensor<1, 3> &) {
                             return p[d];
                           }) /
                  area;
    Tensor<2, 3> J;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        J[i][j] =
          integral(body, ids, [&](const Point<3> &p, const Tensor<1, 3> &) {
            const Tensor<1, 3> x = p - centre;
            return (i == j ? x * x : 0.) - x[i] * x[j];
          });
    inertia = inverse(J);
  }

  Tensor<1, 3>
  SpreadForce::traction(const Point<3>     &x,
                        const Tensor<1, 3> &force,
                        const Tensor<1, 3> &moment) const
  {
    return force / area +
           dealii::cross_product_3d(inertia * moment, x - centre);
  }

  SurfaceField
  SpreadForce::bearing(const Tensor<1, 3> &force) const
  {
    Assert(std::isfinite(force.norm()),
           dealii::ExcMessage("Forces are finite."));
    constexpr double least = 1e-6; // of the area: no face looks that way
    if (force.norm() == 0)
      return
        [](const Point<3> &, const Tensor<1, 3> &) { return Tensor<1, 3>(); };
    const Tensor<1, 3> d       = force / force.norm();
    const auto         pressed = [d](const Tensor<1, 3> &normal) {
      return std::max(0., -(normal * d));
    };
    const double squares =
      integral(body, ids, [&](const Point<3> &, const Tensor<1, 3> &normal) {
        return pressed(normal) * pressed(normal);
      });
    if (!(squares > least * area))
      throw InputError(where +
                       "Value: no face of the boundary ids looks "
                       "against " +
                       to_text(force) +
                       ". A bearing force presses faces whose outward normals "
                       "are against it.");
    const double k    = force.norm() / squares;
    Tensor<1, 3> rest = force;
    for (unsigned int c = 0; c < 3; ++c)
      rest[c] -=
        integral(body, ids, [&](const Point<3> &, const Tensor<1, 3> &normal) {
          return -k * pressed(normal) * normal[c];
        });
    return [k, pressed, rest, area = area](const Point<3> &,
                                           const Tensor<1, 3> &normal) {
      return -k * pressed(normal) * normal + rest / area;
    };
  }
} // namespace conetact::bodies
