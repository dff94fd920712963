// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_schur_solver_h
#define conetact_condensed_schur_solver_h

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <optional>
#include <stdexcept>
#include <vector>

namespace conetact::condensed
{
  /** The matrix is not positive definite on the eliminated unknowns. */
  struct SingularMatrix : std::runtime_error
  {
    explicit SingularMatrix(const std::optional<unsigned int> where)
      : std::runtime_error("the matrix is singular where it is eliminated")
      , node(where)
    {}
    /** A node that moves freely, if known: a value of `node_of`. */
    std::optional<unsigned int> node;
  };

  /** What a SchurSolver has done so far; solves are counted by columns. */
  struct SchurWork
  {
    unsigned int factorizations    = 0; ///< of A_FF
    unsigned int condensations     = 0; ///< Schur complements
    unsigned int reductions        = 0; ///< of loads to C
    unsigned int expansions        = 0; ///< from C to all unknowns
    unsigned int triangular_solves = 0; ///< with the factor

    SchurWork &
    operator+=(const SchurWork &other);
  };

  /** What a factorisation will take, known from the pattern alone. */
  struct FactorEstimate
  {
    double       factor_bytes  = 0;
    double       working_bytes = 0; ///< of the direct solver, factor included
    double       flops         = 0; ///< floating-point operations
    unsigned int n_shared      = 0; ///< equal parts that are not factorised

    FactorEstimate &
    operator+=(const FactorEstimate &other);
  };

  /**
   * Factorises the symmetric matrix
   * @f$ A = \begin{pmatrix} A_{FF} & A_{FC}\\ A_{CF} & A_{CC}\end{pmatrix} @f$
   * once and has its Schur complement
   * @f$ S = A_{CC} - A_{CF} A_{FF}^{-1} A_{FC} @f$. A_FF must be positive
   * definite, A and S may be singular. The unknowns C are the last ones of A.
   *
   * What is made of (Condenser::create): `upper`, the upper triangle of A
   * (column major), n x n; the last `n_schur` unknowns are C (0: a plain
   * factorisation). `node_of` names the node of each unknown (any non-negative
   * numbers, one node's unknowns share it). Rows of the columns C may stand in
   * any order.
   */
  class SchurSolver
  {
  public:
    SchurSolver()                    = default;
    virtual ~SchurSolver()           = default;
    SchurSolver(const SchurSolver &) = delete;
    SchurSolver &
    operator=(const SchurSolver &) = delete;

    /**
     * S, dense, both triangles filled. Handed over once: the solver keeps no
     * copy.
     */
    virtual Eigen::MatrixXd
    take_schur_complement() = 0;

    /** Columns b (n x k) -> b_C - A_CF A_FF^-1 b_F (n_schur x k). */
    virtual Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const = 0;

    /**
     * Columns b (n x k) and u_C (n_schur x k) -> u (n x k) with
     * A_FF u_F = b_F - A_FC u_C.
     */
    virtual Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const = 0;

    /** Memory of the factor [bytes], for the log; 0 if it is not known. */
    virtual double
    factor_bytes() const = 0;

    virtual const SchurWork &
    work() const = 0;
  };

  /** Throws std::invalid_argument for what no SchurSolver can be made of. */
  void
  check_schur_input(const Eigen::SparseMatrix<double> &upper,
                    const Eigen::Index                 n_schur,
                    const std::vector<unsigned int>   &node_of);

  /** The same matrix with ascending rows, without which it has no blocks. */
  Eigen::SparseMatrix<double>
  with_ascending_rows(const Eigen::SparseMatrix<double> &matrix);

  /** Throws SingularMatrix for an entry of A_FF's diagonal that is not > 0. */
  void
  refuse_empty_diagonal(const Eigen::VectorXd           &diagonal,
                        const std::vector<unsigned int> &node_of);

  /**
   * Factors between 1 and 2 that differ from unknown to unknown, 1 for C.
   * Equal cells are eliminated by equal operations: unscaled they round alike,
   * and their errors add up over the area of a mesh instead of cancelling each
   * other.
   */
  std::vector<double>
  uneven_scale(const Eigen::Index n_eliminated, const Eigen::Index n);
} // namespace conetact::condensed

#endif
