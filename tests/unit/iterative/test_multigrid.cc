// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/multigrid.h"

#include <gtest/gtest.h>

using namespace conetact;
using namespace conetact::iterative;

namespace
{
  /** Of a diagonal A with entries from 0 to 2, but for one, and D = 1 / 2. */
  float
  largest_with(const float one)
  {
    constexpr Eigen::Index n = 300000;
    FloatVector            A(n);
    for (Eigen::Index i = 0; i < n; ++i)
      A[i] = 2 * static_cast<float>(i) / n;
    A[n / 3] = one;
    return largest_eigenvalue(
      [&](const FloatVector &x, FloatVector &y) { y = A.cwiseProduct(x); },
      [](const FloatVector &x, FloatVector &y) { y = x / 2; },
      0,
      n,
      Communicator());
  }
} // namespace



TEST(Multigrid, LargestEigenvaluesOfAFewNodesAreFound)
{
  EXPECT_NEAR(largest_with(1.f), 1.f * 1.1f, .03f);
  EXPECT_NEAR(largest_with(3.f), 1.5f * 1.1f, .01f);
  EXPECT_NEAR(largest_with(8.f), 4.f * 1.1f, .01f);
}



TEST(Multigrid, NoEnergyIsNoError)
{
  EXPECT_EQ(
    largest_eigenvalue([](const FloatVector &, FloatVector &y) { y.setZero(); },
                       [](const FloatVector &x, FloatVector &y) { y = x; },
                       0,
                       30,
                       Communicator()),
    1.f);
}
