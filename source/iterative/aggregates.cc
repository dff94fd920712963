// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/aggregates.h"

#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Core>

#include <algorithm>
#include <map>
#include <numeric>

namespace conetact::iterative
{
  namespace
  {
    /**
     * Two nodes are neighbours if their block is at least this much of the
     * geometric mean of their diagonal blocks,
     * @f$|A_{ij}| \ge weak \sqrt{|A_{ii}| |A_{jj}|}@f$ in Frobenius' norm.
     * Where a hard body meets a soft one this fails from a contrast of about
     * weak^-2 = 2500 on: in an aggregate across them the motions of the soft
     * one would have the energy of the hard one.
     */
    constexpr double weak = .02;
  } // namespace



  /* The passes are those of Vanek, Mandel and Brezina. The second one counts
     votes of what the first one has made: nodes that it gives away itself must
     not draw others, or aggregates would grow along the order of nodes.
     Aggregates end at the border of a process, so that no messages are needed
     to make them; work grows with the number of blocks. */
  template <int size>
  std::vector<int>
  aggregates(const DistributedMatrix<size, size, double> &A,
             const std::vector<int>                      &side,
             int                                         &n_aggregates)
  {
    const int        n    = static_cast<int>(A.own_part().n_block_rows());
    constexpr int    none = -1;
    std::vector<int> of(at(n), none);
    Eigen::VectorXd  least = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < n; ++i)
      A.for_row(at(i), [&](const int j, const auto &block) {
        if (j == i)
          least[i] = weak * block.norm();
      });
    // Nodes of different sides may be tied by a stiff block, and still must not
    // move as one.
    const auto together = [&](const int i, const int j) {
      return i == j || side.empty() ||
             (side[at(i)] == side[at(j)] && side[at(i)] >= 0);
    };
    const auto neighbours = [&](const int i, const auto &f) {
      A.for_row(at(i), [&](const int j, const auto &block) {
        if (j < n && together(i, j) &&
            block.squaredNorm() >= least[i] * least[j])
          f(j);
      });
    };
    const auto begin_with = [&](const int i) {
      of[at(i)] = n_aggregates;
      neighbours(i, [&](const int j) {
        if (of[at(j)] == none)
          of[at(j)] = n_aggregates;
      });
      ++n_aggregates;
    };
    n_aggregates = 0;
    for (int i = 0; i < n; ++i)
      {
        bool free = of[at(i)] == none;
        neighbours(i, [&](const int j) { free &= of[at(j)] == none; });
        if (free)
          begin_with(i);
      }
    // Votes are read from `of` and written to `joined`, or the order of nodes
    // would decide.
    std::vector<int>   joined = of;
    std::map<int, int> votes;
    for (int i = 0; i < n; ++i)
      if (of[at(i)] == none)
        {
          votes.clear();
          neighbours(i, [&](const int j) {
            if (of[at(j)] != none)
              ++votes[of[at(j)]];
          });
          const auto most = std::max_element(votes.begin(),
                                             votes.end(),
                                             [](const auto &a, const auto &b) {
                                               return a.second < b.second;
                                             });
          if (most != votes.end())
            joined[at(i)] = most->first;
        }
    // What is left has no neighbour in any aggregate. It begins one of its own:
    // a node in none would have an empty row of P, and no level would correct
    // it.
    of.swap(joined);
    for (int i = 0; i < n; ++i)
      if (of[at(i)] == none)
        begin_with(i);
    return of;
  }



  /* A prefix sum: numbers of a process are contiguous and ascend with its rank,
     so that the owner of a number is found by bisection and no table of owners
     is kept. */
  std::vector<int>
  first_numbers(const int n_own, const Communicator &processes)
  {
    Assert(n_own >= 0, dealii::ExcMessage("A process has rows, or none."));
    const Eigen::VectorXi n = processes.gather_all(
      Eigen::VectorXi(Eigen::VectorXi::Constant(1, n_own)));
    std::vector<int> first(at(static_cast<int>(n.size())) + 1, 0);
    std::partial_sum(n.begin(), n.end(), first.begin() + 1);
    return first;
  }

  template std::vector<int>
  aggregates(const DistributedMatrix<2, 2, double> &,
             const std::vector<int> &,
             int &);
  template std::vector<int>
  aggregates(const DistributedMatrix<3, 3, double> &,
             const std::vector<int> &,
             int &);
  template std::vector<int>
  aggregates(const DistributedMatrix<6, 6, double> &,
             const std::vector<int> &,
             int &);
} // namespace conetact::iterative
