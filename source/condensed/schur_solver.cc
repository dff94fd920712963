// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/schur_solver.h"

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace conetact::condensed
{
  using Eigen::Index;
  using SparseMatrix = Eigen::SparseMatrix<double>;

  SchurWork &
  SchurWork::operator+=(const SchurWork &other)
  {
    factorizations += other.factorizations;
    condensations += other.condensations;
    reductions += other.reductions;
    expansions += other.expansions;
    triangular_solves += other.triangular_solves;
    return *this;
  }



  FactorEstimate &
  FactorEstimate::operator+=(const FactorEstimate &other)
  {
    factor_bytes += other.factor_bytes;
    working_bytes += other.working_bytes;
    flops += other.flops;
    n_shared += other.n_shared;
    return *this;
  }



  void
  check_schur_input(const SparseMatrix              &upper,
                    const Index                      n_schur,
                    const std::vector<unsigned int> &node_of)
  {
    if (upper.rows() != upper.cols() || n_schur < 0 || n_schur > upper.cols() ||
        node_of.size() != static_cast<std::size_t>(upper.cols()))
      throw std::invalid_argument("The sizes of a matrix, of its Schur "
                                  "complement and of its nodes disagree.");
    for (Index column = 0; column < upper.cols(); ++column)
      for (SparseMatrix::InnerIterator entry(upper, column); entry; ++entry)
        if (entry.row() > column)
          throw std::invalid_argument("Only the upper triangle is wanted.");
  }



  // Each change of the storage order sorts.
  SparseMatrix
  with_ascending_rows(const SparseMatrix &matrix)
  {
    AssertDimension(matrix.rows(), matrix.cols());
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = matrix;
    return by_rows;
  }



  void
  refuse_empty_diagonal(const Eigen::VectorXd           &diagonal,
                        const std::vector<unsigned int> &node_of)
  {
    Assert(static_cast<std::size_t>(diagonal.size()) <= node_of.size(),
           dealii::ExcMessage("Each unknown has a node."));
    for (Index i = 0; i < diagonal.size(); ++i)
      // A comparison with what is not a number is false: it is refused as well.
      if (!(diagonal[i] > 0.))
        throw SingularMatrix(node_of[static_cast<std::size_t>(i)]);
  }



  std::vector<double>
  uneven_scale(const Index n_eliminated, const Index n)
  {
    Assert(n_eliminated >= 0 && n_eliminated <= n,
           dealii::ExcMessage("What is eliminated is a part of all."));
    constexpr double    golden_ratio = 0.6180339887498949;
    std::vector<double> scale(n, 1.);
    for (Index i = 0; i < n_eliminated; ++i)
      {
        // Its multiples modulo 1 are spread evenly, and no two neighbours are
        // alike.
        const double x = golden_ratio * static_cast<double>(i + 1);
        scale[i] += x - std::floor(x);
      }
    return scale;
  }
} // namespace conetact::condensed
