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
   * are left make what they can.
   */
  template <int size>
  std::vector<int>
  aggregates(const DistributedMatrix<size, size, double> &A, int &n_aggregates);

  /** The first aggregate of each process, and behind the last one, from the
   * number of each. */
  std::vector<int>
  first_numbers(const int n_own, const Communicator &processes);

  extern template std::vector<int>
  aggregates(const DistributedMatrix<2, 2, double> &, int &);
  extern template std::vector<int>
  aggregates(const DistributedMatrix<3, 3, double> &, int &);
  extern template std::vector<int>
  aggregates(const DistributedMatrix<6, 6, double> &, int &);
} // namespace conetact::iterative

#endif
