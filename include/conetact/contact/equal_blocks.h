// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_equal_blocks_h
#define conetact_contact_equal_blocks_h

#include <Eigen/SparseCore>

#include <vector>

namespace conetact
{
  /** Diagonal blocks with the same matrix: the unknowns of each, ascending. */
  using EqualBlocks = std::vector<std::vector<Eigen::Index>>;

  /**
   * Splits a matrix into diagonal blocks that are not coupled and puts those
   * together that are equal: as many unknowns, as many of them among the last
   * `n_schur`, the same pattern, and values that differ by round-off at most
   * (1e-13 of the largest one). `upper` is the upper triangle. The
   * unknowns of a body, of which `body_of` is the number, stay together. What
   * has no equal is one block, the last; the result is empty if nothing has
   * one.
   */
  std::vector<EqualBlocks>
  find_equal_blocks(const Eigen::SparseMatrix<double> &upper,
                    const Eigen::Index                 n_schur,
                    const std::vector<unsigned int>   &body_of);
} // namespace conetact

#endif
