// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/spread_force.h"

#include "conetact/base/errors.h"

#include <functional>

namespace conetact::bodies
{
  namespace
  {
    using Function = std::function<double(const Point<3> &)>;

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
        [&](const Point<3> &p, const Tensor<1, 3> &) {
          Tensor<1, 3> traction;
          traction[y] = function(p);
          return traction;
        },
        f);
      double sum = 0;
      for (unsigned int node = 0; node < body.n_nodes(); ++node)
        sum += f[node * body.n_components() + y];
      return sum;
    }

    /** Of faces on a line, or in the plane, what has no inertia is left out. */
    Tensor<2, 3>
    inverse(Tensor<2, 3> J)
    {
      const double size = trace(J);
      for (unsigned int d = 0; d < 3; ++d)
        if (J[d][d] <= 1e-12 * size)
          J[d][d] = size;
      return invert(J);
    }
  } // namespace

  SpreadForce::SpreadForce(const Structure   &body,
                           const BoundaryIds &ids,
                           const std::string &in)
    : area(integral(body, ids, [](const Point<3> &) { return 1.; }))
  {
    if (!(area > 0))
      throw InputError(in + "Boundary ids: they have no faces that a force "
                            "could be spread over. Give those of faces of a "
                            "continuum, or choose a nodal force.");
    for (unsigned int d = 0; d < 3; ++d)
      centre[d] =
        integral(body, ids, [d](const Point<3> &p) { return p[d]; }) / area;
    Tensor<2, 3> J;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        J[i][j] = integral(body, ids, [&](const Point<3> &p) {
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
} // namespace conetact::bodies
