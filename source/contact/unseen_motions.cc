// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/unseen_motions.h"

#include "conetact/solvers/column_groups.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <vector>

namespace conetact::contact
{
  namespace
  {
    constexpr double zero_of_rows = 1e-12, nearly_unseen = 1e-3;

    /** Rows and motions of bodies that meet. */
    struct Seen
    {
      Eigen::MatrixXd                                rows;
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares;
    };

    /** The motions that rows do not see, where entries are about `most`. */
    Eigen::MatrixXd
    unseen_by(const Seen &seen, const double most)
    {
      const Eigen::MatrixXd &rows   = seen.rows;
      const Eigen::VectorXd &values = seen.squares.eigenvalues();
      const Eigen::Index     n =
        (values.array() <= std::pow(nearly_unseen * most, 2)).count();
      if (n == 0)
        return {rows.cols(), 0};
      const Eigen::MatrixXd near = seen.squares.eigenvectors().leftCols(n);
      // Rows of zeros are added: a thin SVD has as many right vectors as
      // columns then.
      Eigen::MatrixXd some      = Eigen::MatrixXd::Zero(rows.rows() + n, n);
      some.topRows(rows.rows()) = rows * near;
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(some, Eigen::ComputeThinV);
      const Eigen::Index                      n_seen =
        (svd.singularValues().array() > zero_of_rows * most).count();
      return near * svd.matrixV().rightCols(n - n_seen);
    }
  } // namespace

  /* Squares of rows are small and cheap, but know singular values to the root
     of rounding only: they choose motions that may be unseen (`nearly_unseen`),
     and the rows themselves tell which of these are (`zero_of_rows`). */
  Eigen::MatrixXd
  forget_unseen(Eigen::MatrixXd &rows)
  {
    if (rows.size() == 0)
      return {rows.cols(), 0};
    const auto        groups = solvers::column_groups(rows);
    std::vector<Seen> seen;
    // Entries are about one, or all of them are rounding: where ties take every
    // motion that contacts would see.
    double most = 1;
    for (const solvers::ColumnGroup &group : groups)
      {
        const Eigen::MatrixXd own = rows(group.blocks, group.columns);
        seen.push_back({own,
                        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                          own.transpose() * own)});
        most = std::max(most,
                        std::sqrt(std::max(
                          seen.back().squares.eigenvalues().maxCoeff(), 0.)));
      }
    Eigen::MatrixXd unseen = Eigen::MatrixXd::Zero(rows.cols(), rows.cols());
    Eigen::Index    n      = 0;
    for (std::size_t g = 0; g < groups.size(); ++g)
      {
        const Eigen::MatrixXd own = unseen_by(seen[g], most);
        if (own.cols() == 0)
          continue;
        unseen(groups[g].columns, Eigen::seqN(n, own.cols())) = own;
        n += own.cols();
        rows(groups[g].blocks, groups[g].columns) -=
          (seen[g].rows * own).eval() * own.transpose();
      }
    // What is left of a motion that nothing sees is rounding, which solvers
    // would take for a way to hold it.
    for (Eigen::Index j = 0; j < rows.cols() && n > 0; ++j)
      if (rows.col(j).norm() <= zero_of_rows * most)
        rows.col(j).setZero();
    return unseen.leftCols(n);
  }
} // namespace conetact::contact
