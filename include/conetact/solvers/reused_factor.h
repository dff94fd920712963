// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_reused_factor_h
#define conetact_solvers_reused_factor_h

#include <Eigen/Dense>

#include <vector>

namespace conetact::solvers
{
  /**
   * Solves the large systems of a Newton iteration, A x = b, by GMRES in single
   * precision (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869);
   * Newton makes up for the lost digits. The preconditioner is the diagonal,
   * and once that is too slow the LU factors of an **earlier** matrix of the
   * iteration; a new factorisation is made only where the old one has become
   * too bad. Matrices of one iteration differ in size: each unknown has a
   * number, and numbers that the old matrix had not are preconditioned by their
   * diagonal entry.
   */
  class ReusedFactor
  {
  public:
    using Index  = Eigen::Index;
    using Matrix = Eigen::MatrixXf;
    using Vector = Eigen::VectorXf;

    /**
     * Relative precision of the result: 1e-2 to 1e-5, no more than single
     * precision can give. False if even a new factor is of no use (a singular
     * matrix). `numbers` are those of the rows, increasing.
     */
    bool
    solve(const Matrix             &A,
          const std::vector<Index> &numbers,
          const Vector             &b,
          const float               precision,
          Vector                   &x);

    unsigned int
    n_factorizations() const
    {
      return factorizations;
    }

  private:
    bool
    factorize(const Matrix &A, const std::vector<Index> &numbers);
    /** Where the rows of A stand in the factor, -1 if nowhere. */
    void
    match(const Matrix &A, const std::vector<Index> &numbers);
    bool
    worth_trying(const Index n) const;
    Vector
    precondition(const Vector &b) const;
    bool
    gmres(const Matrix &A,
          const Vector &b,
          const float   precision,
          Vector       &x) const;

    Matrix             factor;
    std::vector<int>   pivots;
    std::vector<Index> factor_numbers;
    std::vector<Index> position;
    Vector             inverse_diagonal;
    Index              n_new          = 0;
    unsigned int       factorizations = 0;
  };
} // namespace conetact::solvers

#endif
