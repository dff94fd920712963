// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_smoothed_aggregation_h
#define conetact_iterative_smoothed_aggregation_h

#include "conetact/iterative/distributed_matrix.h"
#include "conetact/iterative/node_blocks.h"

#include <Eigen/Dense>

#include <vector>

namespace conetact::iterative
{
  /** What a process has of a level; columns are those of all processes. */
  template <int size>
  struct LevelRows
  {
    BlockMatrix<size, size, double> A;
    Eigen::MatrixXd                 modes;
    std::vector<int> first; ///< process p has nodes first[p], first[p] + 1, ...
    std::vector<int> side;  ///< of own nodes, see aggregates()
  };

  /** A coarse level and the map from it to the level above it. */
  template <int size, int coarse>
  struct CoarseLevel
  {
    LevelRows<coarse>                rows;
    BlockMatrix<size, coarse, float> P;
  };

  /** A level as aggregation sees it. */
  template <int size>
  struct LevelAbove
  {
    const DistributedMatrix<size, size, double> &A;
    double                                       unit; ///< A over it is meant
    const NodeBlocks<size>                      &D; ///< inverse of its blocks
    float                                        largest; ///< eigenvalue of D A
    const Eigen::MatrixXd                       &modes;
    std::vector<int> side = {}; ///< of own nodes, see aggregates()
  };

  /**
   * Smoothed aggregation (Vanek, Mandel, Brezina, Computing 56 (1996) 179-196)
   * for a symmetric matrix with `size` unknowns a node: nodes are put together
   * to aggregates, whose motions are those of the modes (rigid ones), smoothed
   * by one step of Jacobi's method with blocks. An aggregate is a node with as
   * many unknowns as there are modes; the matrix of aggregates is P^T A P. Each
   * process makes aggregates of its own nodes. A node that stays alone has one
   * unknown, the first, which no mode moves and many nodes see: it is the same
   * on all levels, and nothing is smoothed into it, or all that see it would
   * see each other there.
   */
  template <int size, int coarse>
  CoarseLevel<size, coarse>
  aggregate(const LevelAbove<size> &above, const Communicator &processes);

  extern template CoarseLevel<2, 3>
  aggregate(const LevelAbove<2> &, const Communicator &);
  extern template CoarseLevel<3, 3>
  aggregate(const LevelAbove<3> &, const Communicator &);
  extern template CoarseLevel<3, 6>
  aggregate(const LevelAbove<3> &, const Communicator &);
  extern template CoarseLevel<6, 6>
  aggregate(const LevelAbove<6> &, const Communicator &);
} // namespace conetact::iterative

#endif
