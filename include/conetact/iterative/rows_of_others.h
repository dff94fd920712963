// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_rows_of_others_h
#define conetact_iterative_rows_of_others_h

#include "conetact/base/index.h"
#include "conetact/iterative/distributed_matrix.h"

#include <cstring>
#include <vector>

namespace conetact::iterative
{
  /** As ints, which processes exchange. */
  template <typename Number>
  void
  pack(const int         i,
       const int        *columns,
       const std::size_t n_columns,
       const Number     *values,
       const std::size_t n_values,
       std::vector<int> &list)
  {
    static_assert(sizeof(Number) % sizeof(int) == 0);
    list.push_back(i);
    list.push_back(static_cast<int>(n_columns));
    list.insert(list.end(), columns, columns + n_columns);
    const std::size_t end = list.size();
    list.resize(end + n_values * sizeof(Number) / sizeof(int));
    if (n_values > 0)
      std::memcpy(list.data() + end, values, n_values * sizeof(Number));
  }

  /** Calls f(number, columns, how many, values) for all that was packed. */
  template <typename Number, typename F>
  void
  unpack(const std::vector<int> &list, const std::size_t block_size, const F &f)
  {
    std::vector<Number> values;
    for (std::size_t k = 0; k < list.size();)
      {
        const int         i = list[k];
        const std::size_t n = at(list[k + 1]);
        values.resize(n * block_size);
        if (!values.empty())
          std::memcpy(values.data(),
                      list.data() + k + 2 + n,
                      values.size() * sizeof(Number));
        f(i, list.data() + k + 2, n, values.data());
        k += 2 + n + values.size() * sizeof(Number) / sizeof(int);
      }
  }

  /** Behind own rows of a matrix those of others that A needs. */
  template <int size, int coarse>
  void
  append_rows_of_others(const DistributedMatrix<size, size, double> &A,
                        const Communicator                          &processes,
                        BlockMatrix<size, coarse, float>            &rows)
  {
    if (processes.size() == 1)
      return;
    std::vector<std::vector<int>> lists(at(processes.size()));
    for (const HaloPlan::Side &side : A.halo_plan().sides)
      for (const int i : side.sent)
        {
          const std::size_t begin = rows.start[at(i)],
                            n     = rows.start[at(i) + 1] - begin;
          pack(i,
               rows.column.data() + begin,
               n,
               rows.block(begin).data(),
               n * rows.block_size,
               lists[at(side.rank)]);
        }
    lists             = processes.exchange(lists);
    std::size_t n_all = rows.column.size();
    for (const std::vector<int> &list : lists)
      unpack<float>(list,
                    rows.block_size,
                    [&](const int, const int *, const std::size_t more, auto) {
                      n_all += more;
                    });
    // A vector that grows takes up to three times its memory.
    rows.column.reserve(n_all);
    rows.value.reserve((n_all + 1) * rows.block_size);
    for (const std::vector<int> &list : lists)
      unpack<float>(list,
                    rows.block_size,
                    [&](const int,
                        const int        *columns,
                        const std::size_t n,
                        const float      *values) {
                      rows.column.insert(rows.column.end(),
                                         columns,
                                         columns + n);
                      rows.value.insert(rows.value.end(),
                                        values,
                                        values + n * rows.block_size);
                      rows.start.push_back(rows.column.size());
                    });
  }
} // namespace conetact::iterative

#endif
