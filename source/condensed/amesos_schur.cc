// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/amesos_schur.h"

#include "conetact/condensed/free_motion.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <new>

namespace conetact::condensed
{
  namespace
  {
    // Right-hand sides of one solve: each is as long as A_FF is large, and
    // dense.
    constexpr Eigen::Index columns_a_solve = 64;

    // This part of the diagonal, added to it, makes any singular stiffness
    // regular, and is so small that one step of inverse iteration still finds
    // what moves freely.
    constexpr double small_shift = 1e-10;
  } // namespace



  AmesosSchur::AmesosSchur(const std::string  &solver,
                           const SparseMatrix &matrix,
                           const Index         n_schur_unknowns,
                           const Nodes        &node_of)
    : n_schur(n_schur_unknowns)
    , n_eliminated(matrix.cols() - n_schur)
  {
    check_schur_input(matrix, n_schur, node_of);
    const SparseMatrix upper = with_ascending_rows(matrix);
    // A_CC, from which A_CF A_FF^-1 A_FC is taken away.
    S    = MatrixXd(upper.bottomRightCorner(n_schur, n_schur));
    S    = MatrixXd(S.selfadjointView<Eigen::Upper>());
    A_FC = upper.topRightCorner(n_eliminated, n_schur);
    if (n_eliminated == 0)
      return;
    const auto uneven = uneven_scale(n_eliminated, upper.cols());
    scale             = Eigen::Map<const VectorXd>(uneven.data(), n_eliminated);
    factorise(solver, upper, node_of);
    condense();
  }



  void
  AmesosSchur::factorise(const std::string  &solver,
                         const SparseMatrix &upper,
                         const Nodes        &node_of)
  {
    refuse_empty_diagonal(upper.diagonal().head(n_eliminated), node_of);
    factor = std::make_unique<Amesos>(solver, eliminated_block(upper, 0));
    if (!factor->is_factorised())
      explain_failure(solver, upper, node_of);
    ++done.factorizations;
    // A factor without zero pivots is no proof: see free_motion.h.
    refuse_free_motion(upper, probe(*factor, upper), node_of);
    done.triangular_solves += 2;
  }



  // Amesos says the same of a pivot that is zero and of memory that does not
  // suffice. A shift takes away the former and not the latter.
  void
  AmesosSchur::explain_failure(const std::string  &solver,
                               const SparseMatrix &upper,
                               const Nodes        &node_of) const
  {
    const Amesos held(solver, eliminated_block(upper, small_shift));
    if (!held.is_factorised())
      throw std::bad_alloc();
    refuse_free_motion(upper, probe(held, upper), node_of);
    throw SingularMatrix(std::nullopt);
  }



  Eigen::SparseMatrix<double, Eigen::RowMajor>
  AmesosSchur::eliminated_block(const SparseMatrix &upper,
                                const double        shift) const
  {
    const SparseMatrix block = upper.topLeftCorner(n_eliminated, n_eliminated);
    Eigen::SparseMatrix<double, Eigen::RowMajor> both(n_eliminated,
                                                      n_eliminated);
    both = block.selfadjointView<Eigen::Upper>();
    for (Index i = 0; i < n_eliminated; ++i)
      for (decltype(both)::InnerIterator entry(both, i); entry; ++entry)
        // D (A_FF + shift diag A_FF) D, D uneven.
        entry.valueRef() *=
          scale[i] * scale[entry.col()] * (entry.col() == i ? 1 + shift : 1);
    return both;
  }



  Eigen::VectorXd
  AmesosSchur::probe(const Amesos &by, const SparseMatrix &upper) const
  {
    const VectorXd load = probe_load(upper.diagonal().head(n_eliminated));
    return scale.cwiseProduct(by.solve(scale.cwiseProduct(load)).col(0));
  }



  /* A_FF^-1 = D (D A_FF D)^-1 D with the uneven scale D, which the factor
     has. */
  Eigen::MatrixXd
  AmesosSchur::solve(const MatrixXd &b) const
  {
    AssertDimension(b.rows(), n_eliminated);
    done.triangular_solves += 2 * static_cast<unsigned int>(b.cols());
    return scale.asDiagonal() * factor->solve(scale.asDiagonal() * b);
  }



  void
  AmesosSchur::condense()
  {
    if (n_schur == 0)
      return;
    for (Index first = 0; first < n_schur; first += columns_a_solve)
      {
        const Index count = std::min(columns_a_solve, n_schur - first);
        S.middleCols(first, count) -=
          A_FC.transpose() * solve(MatrixXd(A_FC.middleCols(first, count)));
      }
    // Column by column the two triangles round differently.
    S = .5 * (S + S.transpose()).eval();
    ++done.condensations;
  }



  Eigen::MatrixXd
  AmesosSchur::take_schur_complement()
  {
    AssertDimension(S.rows(), n_schur); // or it was taken before
    return std::move(S);
  }



  Eigen::MatrixXd
  AmesosSchur::reduce(const MatrixXd &b) const
  {
    AssertDimension(b.rows(), n_eliminated + n_schur);
    MatrixXd reduced = b.bottomRows(n_schur);
    // Loads on contact nodes alone, as reactions are, need no solve.
    if (reduced.size() == 0 || b.topRows(n_eliminated).isZero(0.))
      return reduced;
    for (Index first = 0; first < b.cols(); first += columns_a_solve)
      {
        const Index count = std::min(columns_a_solve, b.cols() - first);
        reduced.middleCols(first, count) -=
          A_FC.transpose() *
          solve(b.topRows(n_eliminated).middleCols(first, count));
      }
    done.reductions += static_cast<unsigned int>(b.cols());
    return reduced;
  }



  Eigen::MatrixXd
  AmesosSchur::expand(const MatrixXd &b, const MatrixXd &u_C) const
  {
    AssertDimension(b.rows(), n_eliminated + n_schur);
    AssertDimension(u_C.rows(), n_schur);
    AssertDimension(u_C.cols(), b.cols());
    MatrixXd u(b.rows(), b.cols());
    u.bottomRows(n_schur) = u_C;
    if (n_eliminated == 0)
      return u;
    for (Index first = 0; first < b.cols(); first += columns_a_solve)
      {
        const Index count = std::min(columns_a_solve, b.cols() - first);
        MatrixXd    load  = b.topRows(n_eliminated).middleCols(first, count);
        load -= A_FC * u_C.middleCols(first, count);
        u.topRows(n_eliminated).middleCols(first, count) = solve(load);
      }
    done.expansions += static_cast<unsigned int>(b.cols());
    return u;
  }


} // namespace conetact::condensed
