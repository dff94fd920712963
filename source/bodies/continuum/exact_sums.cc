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

    /** Sum over the nodes but j of k's blocks in column j. */
    template <int dim>
    Eigen::Matrix<double, dim, dim>
    sum_of_others(const Eigen::MatrixXd &k, const Index j)
    {
      Eigen::Matrix<double, dim, dim> sum =
        Eigen::Matrix<double, dim, dim>::Zero();
      for (Index i = 0; i < k.rows(); i += dim)
        if (i != j)
          sum += k.block<dim, dim>(i, j);
      return sum;
    }

    /** Entries, of which this is the largest one, become whole multiples of a
     * power of two, so few bits that sums of them are exact, in whatever order;
     * returns the power. Units of 1e-280 are none. */
    double
    round_entries(Eigen::MatrixXd &k, const int dim, const double largest)
    {
      const int exponent = std::ilogb(largest) + 1 + dim - bits;
      // what is added rounds to the nearest whole number, in fewer bits
      constexpr double half = 1.5 * (std::size_t(1) << (bits - 1));
      const double     unit = std::ldexp(1., exponent),
                   per_unit = std::ldexp(1., -exponent);
      k                     = ((k.array() * per_unit + half) - half).matrix();
      return unit;
    }

    /* Each column of blocks is changed in its first block and in that on the
       diagonal, which no other column adds. The first column comes last: the
       others change it. */
    template <int dim>
    void
    balance_columns(Eigen::MatrixXd &k)
    {
      for (Index j = dim; j < k.cols(); j += dim)
        {
          Eigen::Matrix<double, dim, dim> sum = sum_of_others<dim>(k, j);
          // blocks on the diagonal will be symmetric: off the diagonal, what is
          // not adds up to zero at each node
          for (Index c = 0; c < dim; ++c)
            for (Index d = c + 1; d < dim; ++d)
              {
                const double excess = sum(c, d) - sum(d, c);
                k(c, j + d) -= excess;
                k(j + d, c) = k(c, j + d);
                sum(c, d) -= excess;
              }
          k.block<dim, dim>(j, j) = -sum;
        }
      k.topLeftCorner<dim, dim>() = -sum_of_others<dim>(k, 0);
    }
  } // namespace

  void
  make_sums_exact(Eigen::MatrixXd &k, const int dim)
  {
    const double largest = k.cwiseAbs().maxCoeff();
    if (!(largest > 0))
      return;
    const double unit = round_entries(k, dim, largest);
    if (dim == 2)
      balance_columns<2>(k);
    else
      balance_columns<3>(k);
    k *= unit;
  }

  void
  make_axial_sums_exact(Eigen::MatrixXd &k)
  {
    const double largest = k.cwiseAbs().maxCoeff();
    if (!(largest > 0))
      return;
    const double unit = round_entries(k, 2, largest);
    for (Index j = 0; j < k.cols(); j += 2)
      {
        // Symmetric: rows sum to zero over what moves along y, the coupling of
        // a node with itself takes the rest.
        const Eigen::Matrix2d sum = sum_of_others<2>(k, j);
        k(j, j + 1) = k(j + 1, j) = -sum(1, 0);
        k(j + 1, j + 1)           = -sum(1, 1);
      }
    k *= unit;
  }
} // namespace conetact::bodies
