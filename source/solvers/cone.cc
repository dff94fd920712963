// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/cone.h"

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    /**
     * Derivative of the smoothed projection with respect to z, from the values
     * at -l or +l: b and c are half sum and half difference of the derivatives
     * at both eigenvalues, a is the divided difference.
     */
    SmallMatrix
    assemble_derivative(const SmallVector &direction,
                        const double       a,
                        const double       b,
                        const double       c)
    {
      const Eigen::Index n = direction.size();
      SmallMatrix        result(n + 1, n + 1);
      result(0, 0) = b;
      for (Eigen::Index i = 0; i < n; ++i)
        {
          result(0, i + 1) = result(i + 1, 0) = c * direction(i);
          for (Eigen::Index j = 0; j < n; ++j)
            result(i + 1, j + 1) =
              (b - a) * direction(i) * direction(j) + (i == j ? a : 0.);
        }
      return result;
    }

    /** Any unit vector will do where z is on the axis. */
    SmallVector
    direction_of(const SmallVector &tangential, const double norm)
    {
      if (norm > 0)
        return tangential / norm;
      SmallVector unit = SmallVector::Zero(tangential.size());
      if (unit.size() > 0)
        unit(0) = 1;
      return unit;
    }
  } // namespace



  Spectrum
  spectrum(const SmallVector &z)
  {
    eigen_assert(z.size() >= 1);
    const Eigen::Index n    = z.size() - 1;
    const SmallVector  tail = z.tail(n);
    const double       norm = tail.stableNorm();
    const SmallVector  w    = direction_of(tail, norm);

    Spectrum result;
    result.l1 = z(0) - norm;
    result.l2 = z(0) + norm;
    result.u1.resize(n + 1);
    result.u2.resize(n + 1);
    result.u1 << .5, -.5 * w;
    result.u2 << .5, .5 * w;
    return result;
  }



  SmallVector
  project(const SmallVector &z)
  {
    const Spectrum s = spectrum(z);
    if (s.l1 >= 0)
      return z;
    if (s.l2 <= 0)
      return SmallVector::Zero(z.size());
    // Neither in the cone nor in its polar: the nearest point lies on the
    // mantle.
    return s.l2 * s.u2;
  }



  double
  smoothed_positive_part(const double l, const double m)
  {
    eigen_assert(m >= 0);
    const double root = std::hypot(l, 2 * m);
    if (l >= 0)
      return .5 * (root + l);
    // For l < 0 root + l would cancel. Its product with root - l is 4 m^2.
    return 2 * m * (m / (root - l));
  }



  /* With g(l) = (sqrt(l^2 + 4 m^2) + l) / 2, g' = g / sqrt(l^2 + 4 m^2), and
     h(l) = g(-l) = g(l) - l, all terms are positive or differences of small
     ones: value and derivatives keep their digits as m goes to zero. */
  SmoothedProjection
  smoothed_projection(const SmallVector &z, const double m)
  {
    eigen_assert(m >= 0);
    eigen_assert(z.size() >= 1);
    const Spectrum s  = spectrum(z);
    const double   s1 = std::hypot(s.l1, 2 * m), s2 = std::hypot(s.l2, 2 * m);
    const double   g1 = smoothed_positive_part(s.l1, m),
                 g2   = smoothed_positive_part(s.l2, m);
    const double h1   = smoothed_positive_part(-s.l1, m),
                 h2   = smoothed_positive_part(-s.l2, m);
    // The derivatives at both eigenvalues are g / s, and 1 - g / s = h / s.
    // Their difference is taken between the two small ones.
    const double slope =
      .5 * (s.l1 >= 0 ? h1 / s1 - h2 / s2 : g2 / s2 - g1 / s1);

    SmoothedProjection result;
    result.value = g1 * s.u1 + g2 * s.u2;
    if (z.size() == 1)
      {
        result.derivative = SmallMatrix::Constant(1, 1, g1 / s1);
        result.complement = SmallMatrix::Constant(1, 1, h1 / s1);
        return result;
      }
    const SmallVector w = 2 * s.u2.tail(z.size() - 1);
    result.derivative   = assemble_derivative(w,
                                            // (g2 - g1) / (l2 - l1), without a
                                            // division by zero on the axis
                                            (g1 + g2) / (s1 + s2),
                                            .5 * (g1 / s1 + g2 / s2),
                                            slope);
    result.complement   = assemble_derivative(w,
                                            (h1 + h2) / (s1 + s2),
                                            .5 * (h1 / s1 + h2 / s2),
                                            -slope);
    return result;
  }



  SmallVector
  project_on_friction_cone(const SmallVector &r, const double mu)
  {
    eigen_assert(mu >= 0);
    eigen_assert(r.size() >= 1);
    const Eigen::Index n      = r.size() - 1;
    const double       normal = r(n);
    SmallVector        result = SmallVector::Zero(n + 1);
    const double       norm   = r.head(n).stableNorm();
    if (norm == 0 || mu == 0)
      {
        result(n) = std::max(normal, 0.);
        return result;
      }
    if (norm <= mu * normal)
      return r;
    // In the polar cone nothing is nearer than the vertex.
    if (normal + mu * norm <= 0)
      return result;
    // On the mantle, along the ray (mu r_t / |r_t|, 1).
    result(n)      = (normal + mu * norm) / (1 + mu * mu);
    result.head(n) = (mu * result(n) / norm) * r.head(n);
    return result;
  }
} // namespace conetact::solvers
