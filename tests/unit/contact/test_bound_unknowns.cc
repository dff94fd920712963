// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/bound_unknowns.h"

#include <gtest/gtest.h>

#include <random>

namespace
{
  using conetact::contact::BoundUnknowns;
  using conetact::contact::find_redundant_rows;
  using conetact::contact::RedundantRows;
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  /** Two contact unknowns, five that are bound, five motions, two of them
   * free together; bound rows 3 and 4 repeat row 0 and a sum. */
  class BoundTest : public ::testing::TestWithParam<double>
  {
  protected:
    static constexpr Index n_c = 2, n_t = 5, k = 5, n_free = 2;

    MatrixXd
    random(const Index rows, const Index cols)
    {
      return MatrixXd::NullaryExpr(rows, cols, [&] { return normal(engine); });
    }

    BoundTest()
    {
      const MatrixXd all = random(k, k).householderQr().householderQ();
      N                  = all.leftCols(n_free);
      M                  = all.rightCols(k - n_free);
      MatrixXd H         = random(n_c + n_t, 9);
      MatrixXd G         = random(n_c + n_t, k);
      for (MatrixXd *m : {&H, &G})
        {
          m->row(1) *= GetParam(); // of a stiffer body
          m->row(n_c + 1) *= GetParam();
          m->row(n_c + 3) = m->row(n_c);
          m->row(n_c + 4) = m->row(n_c + 1) - 2 * m->row(n_c + 2);
        }
      MatrixXd rows(n_t, H.cols() + G.cols());
      rows << H.bottomRows(n_t), G.bottomRows(n_t);
      const MatrixXd springs = random(k, 2);
      redundant = find_redundant_rows(rows.sparseView(), {0, 2, 4, 5});
      matrix.resize(n_c + n_t + k, n_c + n_t + k);
      matrix << H * H.transpose(), G, -G.transpose(),
        springs * springs.transpose();
      load          = random(matrix.rows(), 1);
      load[n_c + 3] = load[n_c];
      load[n_c + 4] = load[n_c + 1] - 2 * load[n_c + 2];
    }

    std::mt19937                     engine{3};
    std::normal_distribution<double> normal;
    MatrixXd                         matrix, N, M;
    VectorXd                         load;
    RedundantRows                    redundant;
  };

  TEST_P(BoundTest, EquationsHoldAndTheRestStays)
  {
    const BoundUnknowns bound(matrix, n_c, n_t, N, M, {}, redundant);
    const VectorXd      b    = bound.bound_part(load);
    const VectorXd      x    = random(n_c + n_free, 1);
    const VectorXd      all  = bound.complete(x, b);
    const VectorXd      v    = matrix * all + load;
    const double        size = all.norm();
    EXPECT_EQ(all.head(n_c), x.head(n_c));
    EXPECT_LT((N.transpose() * all.tail(k) - x.tail(n_free)).norm(),
              1e-13 * size);
    // against what each equation sums: rows of stiff bodies have large terms
    const VectorXd terms = matrix.cwiseAbs() * all.cwiseAbs() + load.cwiseAbs();
    EXPECT_LT(
      v.cwiseQuotient(terms).segment(n_c, n_t).lpNorm<Eigen::Infinity>(),
      1e-13);
    EXPECT_LT((M.transpose() * v.tail(k))
                .cwiseQuotient(M.cwiseAbs().transpose() * terms.tail(k))
                .lpNorm<Eigen::Infinity>(),
              1e-13);
    VectorXd seen(n_c + n_free);
    seen << v.head(n_c), N.transpose() * v.tail(k);
    const VectorXd form =
      bound.matrix() * x + bound.kept_part(load) + bound.effect(b);
    VectorXd terms_seen(n_c + n_free);
    terms_seen << terms.head(n_c), N.cwiseAbs().transpose() * terms.tail(k);
    EXPECT_LT((form - seen).cwiseQuotient(terms_seen).lpNorm<Eigen::Infinity>(),
              1e-12);
  }

  TEST_P(BoundTest, ReactionsAreTheLeastThatDoTheSame)
  {
    const BoundUnknowns bound(matrix, n_c, n_t, N, M, {}, redundant);
    const VectorXd      all =
      bound.complete(random(n_c + n_free, 1), bound.bound_part(load));
    const VectorXd r = all.segment(n_c, n_t);
    ASSERT_EQ(redundant.open.cols(), 2);
    MatrixXd same = MatrixXd::Zero(n_t, 2); // r that act on nothing
    same.col(0) << 1, 0, 0, -1, 0;
    same.col(1) << 0, 1, -2, 0, -1;
    EXPECT_LT((same.transpose() * r).norm(), 1e-12 * r.norm());
  }

  TEST_P(BoundTest, TheFormIsThatOfSolvers)
  {
    const MatrixXd K =
      BoundUnknowns(matrix, n_c, n_t, N, M, {}, redundant).matrix();
    EXPECT_EQ(K.topLeftCorner(n_c, n_c), K.topLeftCorner(n_c, n_c).transpose());
    EXPECT_EQ(K.topRightCorner(n_c, n_free),
              -K.bottomLeftCorner(n_free, n_c).transpose());
    EXPECT_EQ(K.bottomRightCorner(n_free, n_free),
              K.bottomRightCorner(n_free, n_free).transpose());
  }

  INSTANTIATE_TEST_SUITE_P(Contrasts,
                           BoundTest,
                           ::testing::Values(1., 1e-3, 1e3));

  TEST(BoundUnknowns, MotionsWithoutFoundationStayExact)
  {
    // two bodies on a line, tied to each other: only their difference is seen
    MatrixXd matrix(3, 3);
    matrix << 2, 1, -1, -1, 0, 0, 1, 0, 0;
    const double        s = std::sqrt(.5);
    const BoundUnknowns bound(matrix,
                              0,
                              1,
                              Eigen::Vector2d(s, s),
                              Eigen::Vector2d(s, -s),
                              {0},
                              {{0}, Eigen::SparseMatrix<double>(1, 0)});
    EXPECT_EQ(bound.matrix(), MatrixXd::Zero(1, 1));
    // pulled apart by 3 each: the tie carries it
    const VectorXd load = Eigen::Vector3d(0, -3, 3);
    const VectorXd x =
      bound.complete(VectorXd::Zero(1), bound.bound_part(load));
    EXPECT_NEAR(x[0], -3, 1e-14);
    EXPECT_NEAR(x[1] - x[2], 6, 1e-14);
  }
} // namespace
