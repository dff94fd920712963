// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_block_schur_h
#define conetact_contact_block_schur_h

#include "conetact/contact/equal_blocks.h"
#include "conetact/contact/schur_solver.h"

namespace conetact
{
  /**
   * A SchurSolver that factorises a body used several times once: the same
   * mesh, material, supports and contact nodes, moved. Such bodies are equal
   * diagonal blocks of the matrix, find_equal_blocks(); loads of the others
   * are more right-hand sides of the first one. Turned bodies have other
   * matrices and are not shared, nor are bodies in contact with each other,
   * which are one block. Without equal blocks it is a SchurSolver.
   */
  class BlockSchurSolver
  {
  public:
    /**
     * As SchurSolver; `body_of` is the number of the body of each unknown.
     * Empty: there is only one. Throws SingularMatrix, std::bad_alloc.
     */
    BlockSchurSolver(const Eigen::SparseMatrix<double> &upper,
                     const Eigen::Index                 n_schur,
                     const std::vector<unsigned int>   &node_of,
                     const std::vector<unsigned int>   &body_of);
    static FactorEstimate
    estimate(const Eigen::SparseMatrix<double> &upper,
             const Eigen::Index                 n_schur,
             const std::vector<unsigned int>   &node_of,
             const std::vector<unsigned int>   &body_of);

    /** As those of SchurSolver. */
    Eigen::MatrixXd
    take_schur_complement();
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const;
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const;

    /** Sums over the factors at hand. */
    double
    factor_bytes() const;
    double
    factor_operations() const;
    SchurWork
    work() const;

    /** Numbers in `body_of`, and those whose block equals an earlier one. */
    unsigned int
    n_bodies() const
    {
      return n_all_bodies;
    }
    unsigned int
    n_shared_bodies() const
    {
      return n_shared;
    }

  private:
    struct Member
    {
      std::vector<Eigen::Index> unknowns, schur; ///< rows of b, of u_C
    };
    /** Equal blocks; no members: the whole matrix. */
    struct Part
    {
      std::unique_ptr<SchurSolver> solver;
      std::vector<Member>          members;
    };
    /** A column of right-hand sides, as far as a member sees it. */
    struct Column
    {
      const Member *member;
      Eigen::Index  column;
    };

    void
    append(const Eigen::SparseMatrix<double> &upper,
           const std::vector<unsigned int>   &node_of,
           const EqualBlocks                 &blocks);
    static std::vector<Column>
    loaded_columns(const Part            &part,
                   const Eigen::MatrixXd &b,
                   const Eigen::MatrixXd &u_C);

    Eigen::Index      n, n_schur;
    std::vector<Part> parts;
    unsigned int      n_all_bodies = 0, n_shared = 0;
  };
} // namespace conetact

#endif
