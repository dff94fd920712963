// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_element_rows_h
#define conetact_iterative_element_rows_h

#include "conetact/iterative/block_matrix.h"
#include "conetact/iterative/elements.h"

namespace conetact::iterative
{
  /**
   * The rows of a process, which has the places from `begin` to before `end`,
   * `block` of them a node: it adds up the elements that touch its nodes.
   * Columns are the nodes of all processes. `places` are those of all unknowns.
   */
  template <int block>
  BlockMatrix<block, block, double>
  rows_of_elements(const Elements         &elements,
                   const std::vector<int> &places,
                   const int               begin,
                   const int               end);

  extern template BlockMatrix<2, 2, double>
  rows_of_elements<2>(const Elements         &elements,
                      const std::vector<int> &places,
                      const int               begin,
                      const int               end);
  extern template BlockMatrix<3, 3, double>
  rows_of_elements<3>(const Elements         &elements,
                      const std::vector<int> &places,
                      const int               begin,
                      const int               end);
} // namespace conetact::iterative

#endif
