// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/multigrid.h"

#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/LU>

#include <algorithm>

namespace conetact::iterative
{
  namespace
  {
    /** Unknowns of a level of which each process has all: its products take
     * less time than the messages that they would need. */
    constexpr int few = 4000;

    /** Unknowns of a level that needs none below it: each state factorises a
     * full matrix of so many. */
    constexpr int few_enough = 240;

    /** The share of nodes that a level has of those above it at most, or it is
     * the last one: where nodes do not go together, levels without end would
     * follow. */
    constexpr double least_gain = .8;

    /**
     * Column by column: rows of one process are no contiguous piece of a matrix
     * that is kept by columns.
     */
    Eigen::MatrixXd
    gather_rows(const Eigen::MatrixXd &own, const Communicator &processes)
    {
      if (processes.size() == 1)
        return own;
      Eigen::MatrixXd all;
      for (Eigen::Index j = 0; j < own.cols(); ++j)
        {
          const Eigen::VectorXd column =
            processes.gather_all(Eigen::VectorXd(own.col(j)));
          all.conservativeResize(column.size(), own.cols());
          all.col(j) = column;
        }
      return all;
    }

    std::vector<int>
    gather_sides(const std::vector<int> &own, const Communicator &processes)
    {
      if (processes.size() == 1)
        return own;
      const Eigen::VectorXi all =
        processes.gather_all(Eigen::VectorXi(Eigen::Map<const Eigen::VectorXi>(
          own.data(), static_cast<Eigen::Index>(own.size()))));
      return {all.begin(), all.end()};
    }

    template <int size>
    Eigen::MatrixXd
    dense(const BlockMatrix<size, size, double> &A)
    {
      const auto      n = static_cast<Eigen::Index>(A.n_block_rows()) * size;
      Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
      for (std::size_t i = 0; i < A.n_block_rows(); ++i)
        for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
          result.block<size, size>(static_cast<Eigen::Index>(i) * size,
                                   Eigen::Index(A.column[k]) * size) =
            A.block(i, k);
      return result;
    }

    /** Pseudoinverse, as aggregates of few nodes have fewer motions than modes:
     * the others are columns of zeros in P, rows and columns of zeros here. */
    template <int size>
    Eigen::Matrix<float, size, size>
    inverse(const Eigen::Matrix<float, size, size> &block)
    {
      return block.template cast<double>()
        .completeOrthogonalDecomposition()
        .pseudoInverse()
        .template cast<float>();
    }

    /** The inverse diagonal blocks of a matrix. */
    template <int size>
    NodeBlocks<size>
    inverse_diagonal(const BlockMatrix<size, size, float> &A)
    {
      std::vector<Eigen::Matrix<float, size, size>> D(A.n_block_rows());
      for (std::size_t i = 0; i < D.size(); ++i)
        for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
          if (static_cast<std::size_t>(A.column[k]) == i)
            D[i] = inverse<size>(A.block(i, k));
      return NodeBlocks<size>(D);
    }
  } // namespace



  template <int fine, int coarse>
  CoarseLevels<fine, coarse>::CoarseLevels(const LevelAbove<fine> &finest,
                                           const Communicator     &p)
    : processes(p)
  {
    Assert(finest.unit > 0 && finest.largest > 0,
           dealii::ExcMessage(
             "Stiffness and eigenvalues of D A are positive."));
    AssertDimension(
      finest.modes.rows(),
      static_cast<Eigen::Index>(finest.A.own_part().n_block_rows()) * fine);
    // References to a level go on while others are put below it. There are
    // never as many: each has .8 of the nodes of that above it at most.
    below.reserve(100);
    LevelRows<coarse> rows;
    bool              is_last =
      add_level(aggregate<fine, coarse>(finest, processes), P, R, rows);
    while (!is_last)
      {
        Level             &level   = below.back();
        const Communicator sharing = sharers(level);
        const DistributedMatrix<coarse, coarse, double> A(std::move(rows.A),
                                                          rows.first,
                                                          sharing);
        make_smoother(level, A);
        const Eigen::MatrixXd  modes = std::move(rows.modes);
        const std::vector<int> side  = std::move(rows.side);
        is_last =
          add_level(aggregate<coarse, coarse>(
                      {A, 1., level.D, level.largest, modes, side}, sharing),
                    level.P,
                    level.R,
                    rows);
      }
    // It stays in double precision and without contact: each state adds its
    // change to a copy, and factorises that.
    coarsest_matrix = dense(rows.A);
  }



  /* P has the rows of the level above, and the columns of all aggregates. Where
     a level is the first whole one, each process still has only its part of the
     rows of P: maps to it give a part of the sum on each process. */
  template <int fine, int coarse>
  template <int size>
  bool
  CoarseLevels<fine, coarse>::add_level(
    CoarseLevel<size, coarse>             &&next,
    DistributedMatrix<size, coarse, float> &prolongator,
    TransposedMatrix<coarse, size, float>  &restriction,
    LevelRows<coarse>                      &rows)
  {
    const bool   above_is_whole = !below.empty() && below.back().is_whole;
    const double n_above        = (above_is_whole ? Communicator() : processes)
                             .sum(static_cast<double>(next.P.n_block_rows()));
    Level &level = below.emplace_back();
    rows         = std::move(next.rows);
    const int n  = rows.first.back();
    // Where aggregates hardly unite anything each further level would be as
    // dear as this one.
    const bool is_last   = n * coarse <= few_enough || n > least_gain * n_above;
    level.is_whole       = is_last || n * coarse <= few;
    level.is_first_whole = level.is_whole && !above_is_whole;
    if (level.is_first_whole)
      {
        rows.A     = gather_rows(std::move(rows.A), processes);
        rows.modes = gather_rows(rows.modes, processes);
        rows.side  = gather_sides(rows.side, processes);
        rows.first = {0, n};
      }
    const Communicator sharing = sharers(level);
    level.begin                = rows.first[at(sharing.rank())];
    const int n_own = rows.first[at(sharing.rank()) + 1] - level.begin;
    for (FloatVector *v : {&level.b, &level.r, &level.x, &level.c})
      v->setZero(Eigen::Index(n_own) * coarse);
    prolongator = {with_equal_rows(std::move(next.P)), rows.first, sharing};
    restriction = {prolongator, at(n_own)};
    return is_last;
  }



  /* Chebyshev's polynomial is small between a part of the largest eigenvalue of
     D A and that eigenvalue, and grows fast beyond it: an estimate that is too
     small would make the smoother diverge. */
  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::make_smoother(
    Level                                           &level,
    const DistributedMatrix<coarse, coarse, double> &A)
  {
    level.A       = A.template cast<float>();
    level.D       = inverse_diagonal(level.A.own_part());
    level.largest = largest_eigenvalue(
      [&](const FloatVector &x, FloatVector &y) {
        level.A.multiply(x.data(), y.data());
      },
      [&](const FloatVector &x, FloatVector &y) { level.D.multiply(x, y); },
      Eigen::Index(level.begin) * coarse,
      level.b.size(),
      sharers(level));
  }



  /* Levels keep rows that contacts may change as they are without contact, and
     leave them out of runs of equal rows. */
  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::follow(
    const DistributedMatrix<fine, fine, float> &A,
    const std::vector<int>                     &nodes,
    const std::vector<int>                     &first)
  {
    AssertDimension(first.size(), at(processes.size()) + 1);
    Assert(!shown,
           dealii::ExcMessage("Levels have states once they follow contacts."));
    contact = {A, nodes, first, P, processes};
    for (std::size_t l = 0; l + 1 < below.size(); ++l)
      {
        Level &level = below[l];
        contact.add_level(level.P, level.begin, sharers(level));
        const int        n_own = static_cast<int>(level.D.n_nodes());
        std::vector<int> changing;
        for (const int i : contact.pattern(static_cast<int>(l)).number)
          if (i >= level.begin && i < level.begin + n_own)
            {
              changing.push_back(i - level.begin);
              auto &row = level.free_rows.emplace_back();
              level.A.for_row(at(i - level.begin),
                              [&](const int, const auto &block) {
                                row.emplace_back(block);
                              });
            }
        level.runs = RowRuns<coarse, float>(level.A.own_part(), changing);
      }
  }



  /* All processes find the same: the change of levels sends messages, to which
     all must come. */
  template <int fine, int coarse>
  bool
  CoarseLevels<fine, coarse>::have_states_like(
    const std::vector<NodeState<fine>> &states) const
  {
    Assert(!shown || shown->size() == states.size(),
           dealii::ExcMessage("Contact nodes stay the same."));
    if (!shown)
      return false;
    const bool differ = !serve(*shown, states);
    return processes.sum(differ ? 1. : 0.) == 0;
  }



  /* The coarse matrices become P^T A' P of the matrix A' with contacts. Bounds
     of eigenvalues stay those of A. */
  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::set_states(
    const std::vector<NodeState<fine>> &states,
    const bool                          exactly)
  {
    AssertDimension(contact.n_levels(), static_cast<int>(below.size()));
    if (!exactly && have_states_like(states))
      return;
    shown              = states;
    const auto changes = contact.change(states);
    for (std::size_t l = 0; l + 1 < below.size(); ++l)
      change_rows(below[l], changes[l]);
    Eigen::MatrixXd last = coarsest_matrix;
    const auto     &rows = changes.back();
    for (std::size_t i = 0; i < rows.number.size(); ++i)
      rows.for_row(i, [&](const int j, const auto &block) {
        last.template block<coarse, coarse>(rows.number[i] * coarse,
                                            j * coarse) +=
          block.template cast<double>();
      });
    // The answer is zero where a pivot is, as for columns of zeros in P.
    coarsest.compute(last);
  }



  /* Each state begins with the rows of no contact: single precision would not
     bring them back from those of another state. */
  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::change_rows(
    Level                          &level,
    const SomeRows<coarse, coarse> &change)
  {
    const int n_own = static_cast<int>(level.D.n_nodes());
    auto      free  = level.free_rows.begin();
    for (std::size_t place = 0; place < change.number.size(); ++place)
      {
        const int i = change.number[place];
        if (i < level.begin || i >= level.begin + n_own)
          continue;
        auto from = (free++)->begin();
        level.A.for_row(at(i - level.begin), [&](const int column, auto block) {
          const int         j = level.A.number_of_column(column);
          const std::size_t k = change.find(place, j);
          block               = *from++;
          if (k < change.blocks.start[place + 1] &&
              change.blocks.column[k] == j)
            block += change.blocks.block(place, k);
          if (j == i)
            level.D.set(at(i - level.begin), inverse<coarse>(block));
        });
      }
  }



  /* Each process has a part of the residual, and so of the sums on the first
     level that is whole. */
  template <int fine, int coarse>
  template <typename Matrix>
  void
  CoarseLevels<fine, coarse>::restrict_to(Level             &level,
                                          const Matrix      &restriction,
                                          const FloatVector &r)
  {
    restriction.multiply(r.data(), level.b.data());
    if (level.is_first_whole)
      processes.sum(level.b.data(), level.b.size());
  }



  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::correct(const FloatVector &r, FloatVector &x)
  {
    AssertDimension(r.size(), x.size());
    Assert(shown, dealii::ExcMessage("Levels know the states of contacts."));
    restrict_to(below[0], R, r);
    cycle(0);
    P.multiply(below[0].x.data(), x.data());
  }



  /* A V-cycle: two steps of Chebyshev's method, the correction from below, two
     steps again. Work is a multiple of that on the first level, as each has a
     fraction of the unknowns above it. */
  template <int fine, int coarse>
  void
  CoarseLevels<fine, coarse>::cycle(const std::size_t l)
  {
    AssertIndexRange(l, below.size());
    Level &level = below[l];
    if (l + 1 == below.size())
      {
        level.x = coarsest.solve(level.b.template cast<double>())
                    .template cast<float>();
        return;
      }
    const auto multiply = [&](const FloatVector &x, FloatVector &y) {
      level.A.multiply(x.data(), y.data(), level.runs);
    };
    const auto scale =
      [&](const FloatVector &r, const auto &prepare, const auto &use) {
        level.D.for_products(r, prepare, use);
      };
    Chebyshev smoother(multiply, scale, level.largest, level.smoothing);
    level.r = level.b;
    smoother.smooth_first(level.r, level.x);
    restrict_to(below[l + 1], level.R, level.r);
    cycle(l + 1);
    level.P.multiply(below[l + 1].x.data(), level.c.data());
    level.x += level.c;
    smoother.smooth_last(level.b, level.r, level.x);
  }

  template class CoarseLevels<2, 3>;
  template class CoarseLevels<3, 6>;
} // namespace conetact::iterative
