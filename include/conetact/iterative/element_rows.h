// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_element_rows_h
#define conetact_iterative_element_rows_h

#include "conetact/base/communicator.h"
#include "conetact/iterative/block_matrix.h"
#include "conetact/iterative/elements.h"

namespace conetact::iterative
{
  /**
   * The rows of its own nodes, which each process makes from the elements that
   * touch them; columns are the nodes of all processes. The first process alone
   * knows elements and places of unknowns, and sends the others theirs: process
   * p has the places from first[p] on, `block` of them a node.
   */
  template <int block>
  BlockMatrix<block, block, double>
  rows_of_elements(const Elements         &elements,
                   const std::vector<int> &places,
                   const std::vector<int> &first,
                   const Communicator     &processes);

  extern template BlockMatrix<2, 2, double>
  rows_of_elements<2>(const Elements         &elements,
                      const std::vector<int> &places,
                      const std::vector<int> &first,
                      const Communicator     &processes);
  extern template BlockMatrix<3, 3, double>
  rows_of_elements<3>(const Elements         &elements,
                      const std::vector<int> &places,
                      const std::vector<int> &first,
                      const Communicator     &processes);
} // namespace conetact::iterative

#endif
