// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_cone_h
#define conetact_solvers_cone_h

#include <Eigen/Dense>

namespace conetact::solvers
{
  /** Vectors and matrices of one node live on the stack. */
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
  using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

  /**
   * Spectral decomposition: values l1 <= l2 and their vectors.
   *
   * Algebra of the cones of friction, without units. The second-order cone
   * @f$\{z = (z_0, z_1): z_0 \ge |z_1|\}@f$ has its axis first and dimension 1
   * (a half line), 2 or 3; @f$z = \lambda_1 u_1 + \lambda_2 u_2@f$ is its
   * spectral decomposition, and the smoothed projection replaces
   * @f$\max(\lambda, 0)@f$ by @f$(\sqrt{\lambda^2 + 4 m^2} + \lambda) / 2@f$
   * (Chen-Harker-Kanzow-Smale). Hayashi, Yamashita and Fukushima, SIAM J.
   * Optim. 15 (2005) 593-615, section 2.
   */
  struct Spectrum
  {
    double      l1 = 0, l2 = 0;
    SmallVector u1, u2;
  };
  Spectrum
  spectrum(const SmallVector &z);

  /** Projection on the second-order cone. */
  SmallVector
  project(const SmallVector &z);

  /** @f$m\,g(l/m) = (\sqrt{l^2+4m^2}+l)/2@f$, exact for l << -m. */
  double
  smoothed_positive_part(const double l, const double m);

  /**
   * Smoothed projection, its derivative D and I - D. The last is not the
   * difference of the other two: near the cone D is 1 up to m^2, and what is
   * left of it would be round-off. It follows from
   * @f$1 - g'(a) = g'(-a)@f$.
   */
  struct SmoothedProjection
  {
    SmallVector value;
    SmallMatrix derivative;
    SmallMatrix complement;
  };
  SmoothedProjection
  smoothed_projection(const SmallVector &z, const double m);

  /**
   * Nearest point of the friction cone @f$|r_t| \le \mu r_n@f$, with the axis
   * last: r = (r_t, r_n) as in ContactProblem. For mu = 0, or without
   * tangents, the cone is the half line of normal reactions.
   */
  SmallVector
  project_on_friction_cone(const SmallVector &r, const double mu);
} // namespace conetact::solvers

#endif
