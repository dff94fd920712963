// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_column_groups_h
#define conetact_solvers_column_groups_h

#include "conetact/solvers/contact_problem.h"

#include <Eigen/Dense>

#include <vector>

namespace conetact::solvers
{
  /** Columns of a matrix, and those blocks of its rows in which they are not
   * zero; both sorted. */
  struct ColumnGroup
  {
    std::vector<Eigen::Index> columns, blocks;
  };

  /**
   * The least groups of columns that have no block of rows in common: motions
   * of bodies that do not meet each other. Block i has the rows from first[i]
   * to first[i + 1] - 1. What is done to all columns is then done group by
   * group, in the sum of cubes in place of the cube of the sum. The groups
   * stand in the order of their first columns; a column of zeros has one
   * without blocks.
   */
  std::vector<ColumnGroup>
  column_groups(const Eigen::MatrixXd           &matrix,
                const std::vector<Eigen::Index> &first);

  /** Where the rows of contact nodes begin, and where the last one ends. */
  std::vector<Eigen::Index>
  nodes_of(const ContactSystem &system);

  /** The same with each row as a block. */
  std::vector<ColumnGroup>
  column_groups(const Eigen::MatrixXd &matrix);
} // namespace conetact::solvers

#endif
