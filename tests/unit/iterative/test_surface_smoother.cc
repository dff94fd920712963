// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/surface_smoother.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace
{
  using namespace conetact::iterative;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  using Eigen::VectorXf;

  constexpr int    n_nodes = 6;
  constexpr double scale   = 4;

  MatrixXd
  random_positive_definite()
  {
    std::mt19937                     generator(5);
    std::uniform_real_distribution<> number(-1, 1);
    const MatrixXd                   a =
      MatrixXd::NullaryExpr(2 * n_nodes, 2 * n_nodes, [&](auto, auto) {
        return number(generator);
      });
    return a * a.transpose() + MatrixXd::Identity(2 * n_nodes, 2 * n_nodes);
  }

  SurfaceSmoother<2>
  make(const MatrixXd &K, const std::vector<int> &nodes)
  {
    RowByRow<2, 2, double> rows(false);
    std::vector<int>       columns(n_nodes);
    std::iota(columns.begin(), columns.end(), 0);
    for (int i = 0; i < n_nodes; ++i)
      {
        const MatrixXd row = K.middleRows(2 * i, 2); // column by column
        rows.append(columns.data(),
                    n_nodes,
                    std::vector<double>(row.data(), row.data() + row.size()));
      }
    return {{rows.finish(), {0, n_nodes}, conetact::Communicator()},
            scale,
            nodes,
            0,
            conetact::Communicator()};
  }
} // namespace



TEST(SurfaceSmoother, SolvesForItsNodesTogether)
{
  const MatrixXd     K     = random_positive_definite();
  SurfaceSmoother<2> given = make(K, {1, 3, 4});
  VectorXd           free  = VectorXd::Ones(2 * n_nodes);
  free[7]                  = 0; // of node 3
  auto added               = given.no_blocks();
  EXPECT_EQ(given.find(2), -1);
  added.col(given.find(4)) << .5, .25, .25, 2;
  given.factorize(free, added);

  // K, and its block of node 4 with what was added, where all of it is free
  const std::vector<int> places = {2, 3, 6, 8, 9};
  MatrixXd               part   = K(places, places) / scale;
  part.bottomRightCorner<2, 2>() +=
    (Eigen::Matrix2d() << .5, .25, .25, 2).finished();
  const VectorXf r = VectorXf::LinSpaced(2 * n_nodes, 1, 2);
  const VectorXd x = part.ldlt().solve(VectorXd(r(places).cast<double>()));

  VectorXf z = VectorXf::Constant(2 * n_nodes, 9);
  given.apply(r, z);
  for (std::size_t k = 0; k < places.size(); ++k)
    EXPECT_NEAR(z[places[k]], x[static_cast<Eigen::Index>(k)], 1e-5);
  EXPECT_EQ(z[7], 0); // held
  for (const int other : {0, 1, 4, 5, 10, 11})
    EXPECT_EQ(z[other], 9);
}



TEST(SurfaceSmoother, FollowsStates)
{
  const MatrixXd     K     = random_positive_definite();
  SurfaceSmoother<2> given = make(K, {0, 5});
  VectorXd           free  = VectorXd::Ones(2 * n_nodes);
  VectorXf           first = VectorXf::Zero(2 * n_nodes), last = first;
  const VectorXf     r = VectorXf::Ones(2 * n_nodes);
  given.factorize(free, given.no_blocks());
  given.apply(r, first);
  free.head<2>().setZero();
  given.factorize(free, given.no_blocks());
  given.apply(r, last);
  EXPECT_GT((first - last).norm(), 1e-3);
  free.setOnes();
  given.factorize(free, given.no_blocks());
  given.apply(r, last);
  EXPECT_EQ(first, last);
}
