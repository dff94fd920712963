// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_schur_solver_h
#define conetact_backends_schur_solver_h

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace conetact
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
   * once by MUMPS, with the unknowns C ordered last, and lets the solver
   * return the Schur complement
   * @f$ S = A_{CC} - A_{CF} A_{FF}^{-1} A_{FC} @f$ itself.
   * A_FF must be positive definite, A and S may be singular. The unknowns C
   * are the last ones of A.
   */
  class SchurSolver
  {
  public:
    /**
     * `upper`: upper triangle of A (column major), n x n; the last
     * `n_schur` unknowns are C (0: a plain factorisation). `node_of` names the
     * node of each unknown (any non-negative numbers, one node's unknowns
     * share it): the fill-reducing order is that of the node graph.
     * Throws SingularMatrix, std::bad_alloc.
     */
    SchurSolver(const Eigen::SparseMatrix<double> &upper,
                const Eigen::Index                 n_schur,
                const std::vector<unsigned int>   &node_of);
    ~SchurSolver();
    /** What that would take: orders and analyses, but does not factorise. */
    static FactorEstimate
    estimate(const Eigen::SparseMatrix<double> &upper,
             const Eigen::Index                 n_schur,
             const std::vector<unsigned int>   &node_of);
    SchurSolver(const SchurSolver &) = delete;
    SchurSolver &
    operator=(const SchurSolver &) = delete;

    /**
     * S, dense, both triangles filled. Handed over once: the solver keeps no
     * copy.
     */
    Eigen::MatrixXd
    take_schur_complement();

    /** Columns b (n x k) -> b_C - A_CF A_FF^-1 b_F (n_schur x k). */
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const;

    /**
     * Columns b (n x k) and u_C (n_schur x k) -> u (n x k) with
     * A_FF u_F = b_F - A_FC u_C.
     */
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const;

    /** Memory of the factor [bytes], for the log. */
    double
    factor_bytes() const;

    /** Operations of the factorisation. */
    double
    factor_operations() const;

    const SchurWork &
    work() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace conetact

#endif
