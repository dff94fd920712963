// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/exact_sums.h"

#include <cmath>
#include <limits>

namespace conetact::bodies
{
  namespace
  {
    using Eigen::Index;

    /** Whole numbers below this power of two are exact. */
    constexpr int bits = std::numeric_limits<double>::digits;

    /** Sum over the nodes but j of k's blocks in column j, entry (c, d). */
    double
    sum_of_others(const Eigen::Ref<Eigen::MatrixXd> &k,
                  const Index                        dim,
                  const Index                        j,
                  const Index                        c,
                  const Index                        d)
    {
      double sum = 0;
      for (Index i = 0; i < k.rows(); i += dim)
        if (i != j)
          sum += k(i + c, j + d);
      return sum;
    }

    /** Entries become whole multiples of a power of two, so few bits that sums
     * of them are exact; returns the power. Units of 1e-280 are none. */
    double
    round_entries(Eigen::Ref<Eigen::MatrixXd> k, const int dim)
    {
      const int exponent = std::ilogb(k.cwiseAbs().maxCoeff()) + 1 + dim - bits;
      // what is added rounds to the nearest whole number, in fewer bits
      constexpr double half = 1.5 * (std::size_t(1) << (bits - 1));
      const double     unit = std::ldexp(1., exponent),
                   per_unit = std::ldexp(1., -exponent);
      k                     = k.unaryExpr(
        [&](const double x) { return (x * per_unit + half) - half; });
      return unit;
    }
  } // namespace

  void
  make_sums_exact(Eigen::Ref<Eigen::MatrixXd> k, const int dim)
  {
    if (!(k.cwiseAbs().maxCoeff() > 0))
      return;
    const double unit = round_entries(k, dim);

    // blocks on the diagonal will be symmetric: off the diagonal, what is not
    // adds up to zero at each node
    for (Index j = dim; j < k.cols(); j += dim)
      for (Index c = 0; c < dim; ++c)
        for (Index d = c + 1; d < dim; ++d)
          {
            k(c, j + d) -=
              sum_of_others(k, dim, j, c, d) - sum_of_others(k, dim, j, d, c);
            k(j + d, c) = k(c, j + d);
          }
    for (Index j = 0; j < k.cols(); j += dim)
      for (Index c = 0; c < dim; ++c)
        for (Index d = 0; d < dim; ++d)
          k(j + c, j + d) = -sum_of_others(k, dim, j, c, d);
    k *= unit;
  }

  void
  make_axial_sums_exact(Eigen::Ref<Eigen::MatrixXd> k)
  {
    if (!(k.cwiseAbs().maxCoeff() > 0))
      return;
    const double unit = round_entries(k, 2);
    for (Index j = 0; j < k.cols(); j += 2)
      {
        // Symmetric: rows sum to zero over what moves along y, the coupling of
        // a node with itself takes the rest.
        k(j, j + 1) = k(j + 1, j) = -sum_of_others(k, 2, j, 1, 0);
        k(j + 1, j + 1)           = -sum_of_others(k, 2, j, 1, 1);
      }
    k *= unit;
  }
} // namespace conetact::bodies
