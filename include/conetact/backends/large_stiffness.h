// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_large_stiffness_h
#define conetact_backends_large_stiffness_h

#include "conetact/solvers/contact_problem.h"
#include "conetact/solvers/large_system.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace conetact::backends
{
  /** What a LargeSystem is made of. */
  struct LargeStiffness
  {
    Eigen::SparseMatrix<double> upper;   ///< triangle of K, column major
    std::vector<unsigned int>   node_of; ///< of each unknown, any numbers
    Eigen::MatrixXd             modes;   ///< rigid motions, a column for each
    solvers::ContactSystem      contact; ///< layout of the last unknowns
  };

  /**
   * Solves the linear systems of Newton's method by GMRES (Saad, SIAM J. Sci.
   * Comput. 14 (1993) 461-469, with a preconditioner that may vary). Unknowns
   * that a law determines by itself (closed gaps, stuck slips) are eliminated,
   * slipping and open nodes have rows
   * @f$(K\,\delta u)_i + S_i\,\delta u_i + q_i (K\,\delta u)_n = h_i@f$.
   *
   * The preconditioner is one cycle of multigrid in single precision. Its
   * coarse levels are made once, with all contact nodes held: they are too
   * stiff where nodes slip or open, which costs a few iterations, where a new
   * hierarchy would cost thirty. The finest level is that of the step: its
   * smoother, Chebyshev's method on the blocks of nodes, leaves out what is
   * held and knows S. Nodes have `dim` unknowns at most, 2 or 3.
   */
  std::shared_ptr<const solvers::LargeSystem>
  make_large_system(LargeStiffness given, const unsigned int dim);
} // namespace conetact::backends

#endif
