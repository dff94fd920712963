// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/free_motion.h"

#include "conetact/condensed/schur_solver.h"

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <random>

namespace conetact::condensed
{
  namespace
  {
    // The energy v^T A v over the sum of the magnitudes of its terms: floating
    // bodies and mechanisms stay below 1e-17, whatever their size. At 1e-16 no
    // digit of the softest motion is right; a cantilever of 1 : 1000 has 1e-13.
    constexpr double rounding = 1e-16;
  } // namespace



  Eigen::VectorXd
  numbers_without_order(const Eigen::Index n)
  {
    // The generator is the same everywhere by the standard; distributions are
    // not, and differ from one library to another.
    std::minstd_rand random;
    constexpr double range = std::minstd_rand::max();
    Eigen::VectorXd  numbers(n);
    for (double &number : numbers)
      number = 2. * static_cast<double>(random()) / range - 1.;
    return numbers;
  }



  /* D^1/2 x with the diagonal D of A: random numbers x for D^-1/2 A D^-1/2,
     which knows neither units nor contrasts of stiffness. Without any order
     they have a part of every motion. */
  Eigen::VectorXd
  probe_load(const Eigen::VectorXd &diagonal)
  {
    return diagonal.cwiseSqrt().cwiseProduct(
      numbers_without_order(diagonal.size()));
  }



  void
  refuse_free_motion(const Eigen::SparseMatrix<double> &upper,
                     const Eigen::VectorXd             &v,
                     const std::vector<unsigned int>   &node_of)
  {
    AssertDimension(upper.rows(), upper.cols());
    // In long double: the ratio looked for is the rounding of double itself.
    long double  energy = 0., without_signs = 0.;
    double       largest = 0.;
    Eigen::Index where   = 0;
    for (Eigen::Index column = 0; column < v.size(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(upper, column);
           entry;
           ++entry)
        {
          const bool        diagonal = entry.row() == column;
          const long double term =
            (diagonal ? 1.L : 2.L) * v[column] * entry.value() * v[entry.row()];
          energy += term;
          without_signs += std::abs(term);
          // The unknown that moves most, by its own stiffness, names the node.
          if (diagonal && term > largest)
            {
              largest = static_cast<double>(term);
              where   = column;
            }
        }
    if (!(energy > rounding * without_signs)) // nor if it is not a number
      throw SingularMatrix(node_of[static_cast<std::size_t>(where)]);
  }
} // namespace conetact::condensed
