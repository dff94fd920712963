// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/spread_force.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace conetact::bodies
{
  namespace
  {
    using PrincipalAxes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

    PrincipalAxes
    principal_axes(const Tensor<2, 3> &J)
    {
      Eigen::Matrix3d matrix;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          matrix(i, j) = J[i][j];
      return PrincipalAxes(matrix);
    }

    /** Faces on a line have no inertia about it, however it lies: it is left
     * out. */
    Tensor<2, 3>
    inverse(const Tensor<2, 3> &J)
    {
      constexpr double      none = 1e-12; // of the sum: rounding
      const PrincipalAxes   axes = principal_axes(J);
      const double          size = trace(J);
      const Eigen::Vector3d of_axes =
        axes.eigenvalues().unaryExpr([&](const double value) {
          return value > none * size ? 1 / value : 0.;
        });
      const Eigen::Matrix3d matrix = axes.eigenvectors() *
                                     of_axes.asDiagonal() *
                                     axes.eigenvectors().transpose();
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i][j] = matrix(i, j);
      return result;
    }
  } // namespace

  namespace
  {
    constexpr unsigned int component_y = 1;
  }

  double
  sum_along_y(const Structure &body, const Eigen::VectorXd &forces)
  {
    double sum = 0;
    for (unsigned int node = 0; node < body.n_nodes(); ++node)
      sum += forces[node * body.n_components() + component_y];
    return sum;
  }

  double
  area_of(const Structure &body, const BoundaryIds &ids)
  {
    return integral(body, ids, [](const Point<3> &, const Tensor<1, 3> &) {
      return 1.;
    });
  }

  double
  integral(const Structure    &body,
           const BoundaryIds  &ids,
           const FaceFunction &function)
  {
    Eigen::VectorXd f =
      Eigen::VectorXd::Zero(body.n_nodes() * body.n_components());
    body.add(Action::traction(ids,
                              [&](const Point<3>     &p,
                                  const Tensor<1, 3> &normal) {
                                Tensor<1, 3> traction;
                                traction[component_y] = function(p, normal);
                                return traction;
                              }),
             f);
    return sum_along_y(body, f);
  }

  SpreadForce::SpreadForce(const Structure   &of,
                           const BoundaryIds &on,
                           const std::string &in)
    : body(of)
    , ids(on)
    , where(in)
    , area(area_of(body, ids))
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

  /* On a plane all pressures have one direction. */
  void
  SpreadForce::refuse_across_plane(
    const Tensor<1, 3>                                &force,
    const std::function<double(const Tensor<1, 3> &)> &pressed) const
  {
    constexpr double plane = 1e-6, across = 1e-2; // of one and of the force
    const double     all =
      integral(body, ids, [&](const Point<3> &, const Tensor<1, 3> &normal) {
        return pressed(normal);
      });
    Tensor<1, 3> mean;
    for (unsigned int c = 0; c < 3; ++c)
      mean[c] =
        integral(body, ids, [&](const Point<3> &, const Tensor<1, 3> &normal) {
          return pressed(normal) * normal[c] / all;
        });
    const Tensor<1, 3> beside = force - (force * mean) * mean;
    if (mean.norm() > 1 - plane && beside.norm() > across * force.norm())
      throw InputError(where + "Value: the faces that " + to_text(force) +
                       " presses are plane with normal " + to_text(mean) +
                       ", and pressures on them carry nothing across it. Give "
                       "a force along the normal, and what acts across as a "
                       "Load of Kind = force.");
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
    refuse_across_plane(force, pressed);
    const double k    = force.norm() / squares;
    Tensor<1, 3> rest = force;
    for (unsigned int c = 0; c < 3; ++c)
      rest[c] -=
        integral(body, ids, [&](const Point<3> &, const Tensor<1, 3> &normal) {
          return -k * pressed(normal) * normal[c];
        });
    const auto pressure =
      [k, pressed, rest, area = area](const Point<3> &,
                                      const Tensor<1, 3> &normal) {
        return -k * pressed(normal) * normal + rest / area;
      };
    const Tensor<1, 3> turn = -turning(pressure);
    return
      [pressure, turn, *this](const Point<3> &p, const Tensor<1, 3> &normal) {
        return pressure(p, normal) + traction(p, Tensor<1, 3>(), turn);
      };
  }

  /* All normals of a bore lead through its axis, and so does the force of a
     pin: a moment about it is an error of integration on facets. With N = int n
     n^T the axis a is where N has nothing, and goes through the point c that
     int (1 - n n^T) (p - c) = 0 has. */
  Tensor<1, 3>
  SpreadForce::turning(const SurfaceField &field) const
  {
    constexpr double round = .01; // of the area: else faces are nearly plane
    Tensor<2, 3>     N;
    Tensor<1, 3>     of_points;
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j <= i; ++j)
          N[i][j] = N[j][i] =
            integral(body, ids, [&](const Point<3> &, const Tensor<1, 3> &n) {
              return n[i] * n[j];
            });
        of_points[i] =
          integral(body, ids, [&](const Point<3> &p, const Tensor<1, 3> &n) {
            return p[i] - n[i] * (n * Tensor<1, 3>(p));
          });
      }
    const PrincipalAxes axes = principal_axes(N);
    if (!(axes.eigenvalues()[1] > round * area))
      return {};
    Tensor<1, 3> axis;
    for (unsigned int d = 0; d < 3; ++d)
      axis[d] = axes.eigenvectors()(d, 0);
    const Tensor<2, 3> across =
      area * Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) - N;
    const Point<3> c(inverse(across) * of_points);
    return axis *
           integral(body, ids, [&](const Point<3> &p, const Tensor<1, 3> &n) {
             return axis * dealii::cross_product_3d(p - c, field(p, n));
           });
  }
} // namespace conetact::bodies
