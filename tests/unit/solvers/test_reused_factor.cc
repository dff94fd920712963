// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/reused_factor.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  using Index  = Eigen::Index;
  using Matrix = Eigen::MatrixXf;
  using Vector = Eigen::VectorXf;

  std::vector<Index>
  numbers_of(const Matrix &A)
  {
    std::vector<Index> numbers(static_cast<std::size_t>(A.rows()));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }
} // namespace



// The first direction is the result, to the last bit.
TEST(ReusedFactor, ADiagonalMatrixNeedsNoFactor)
{
  const Matrix A = Vector{{2.f, 4.f, -8.f, .5f}}.asDiagonal();
  const Vector exact{{0.f, 3.f, 0.f, 0.f}};
  ReusedFactor factor;
  Vector       x;
  ASSERT_TRUE(factor.solve(A, numbers_of(A), A * exact, 1e-2f, x));
  EXPECT_EQ(x, exact);
  EXPECT_EQ(factor.n_factorizations(), 0u);
}



TEST(ReusedFactor, ASingularMatrixIsRefused)
{
  Matrix A = Matrix::Zero(3, 3);
  A(0, 0) = A(1, 1) = 1;
  ReusedFactor factor;
  Vector       x;
  EXPECT_FALSE(factor.solve(A, numbers_of(A), Vector::Ones(3), 1e-2f, x));
  EXPECT_FALSE(factor.solve(A, numbers_of(A), Vector::Unit(3, 2), 1e-2f, x));
}
