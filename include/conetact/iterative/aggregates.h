// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_aggregates_h
#define conetact_iterative_aggregates_h

#include "conetact/iterative/distributed_matrix.h"

#include <vector>

namespace conetact::iterative
{
  /**
   * The aggregate of each own node: nodes all of whose neighbours are free yet
   * begin one with these, others join one of their neighbours', and those that
   * are left make what they can. Neighbours are on one `side`, of each own
   * node; less than 0: it stays alone. Empty: all are on one.
   */
  template <int size>
  std::vector<int>
  aggregates(const DistributedMatrix<size, size, double> &A,
             const std::vector<int>                      &side,
             int                                         &n_aggregates);

  /** The first aggregate of each process, and behind the last one, from the
   * number of each. */
  std::vector<int>
  first_numbers(const int n_own, const Communicator &processes);

  extern template std::vector<int>
  aggregates(const DistributedMatrix<2, 2, double> &,
             const std::vector<int> &,
             int &);
  extern template std::vector<int>
  aggregates(const DistributedMatrix<3, 3, double> &,
             const std::vector<int> &,
             int &);
  extern template std::vector<int>
  aggregates(const DistributedMatrix<6, 6, double> &,
             const std::vector<int> &,
             int &);
} // namespace conetact::iterative

#endif
