// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/surface_smoother.h"

#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::iterative
{
  using Eigen::Index;
  using Eigen::VectorXd;
  using Eigen::VectorXf;

  /* Each process brings the rows of its nodes, in columns of the surface alone,
     and gets those of all: the matrix of a surface is small beside that of a
     body. The order of elimination is found once, as all states have the same
     pattern. */
  template <int block>
  SurfaceSmoother<block>::SurfaceSmoother(
    const DistributedMatrix<block, block, double> &matrix,
    const double                                   scale,
    const std::vector<int>                        &nodes,
    const int                                      begin,
    const Communicator                            &all)
    : processes(all)
  {
    Assert(scale > 0, dealii::ExcMessage("A stiffness is positive."));
    Assert(std::is_sorted(nodes.begin(), nodes.end()),
           dealii::ExcMessage("Nodes of the surface are ascending."));
    const int        n_own = static_cast<int>(matrix.own_part().n_block_rows());
    std::vector<int> rows, columns;
    std::vector<double> values;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      {
        // Own nodes are contiguous among all, and those of the surface ascend:
        // the own part of a vector of the surface begins at `first`.
        const int i = nodes[k] - begin;
        if (i < 0 || i >= n_own)
          continue;
        if (own.empty())
          first = static_cast<Index>(k) * block;
        own.push_back(i);
        matrix.for_row(at(i), [&](const int column, const auto &a) {
          const auto it = std::lower_bound(nodes.begin(),
                                           nodes.end(),
                                           matrix.number_of_column(column));
          if (it == nodes.end() || *it != matrix.number_of_column(column))
            return;
          rows.push_back(static_cast<int>(k));
          columns.push_back(static_cast<int>(it - nodes.begin()));
          values.insert(values.end(), a.data(), a.data() + a.size());
        });
      }
    const auto gather = [&](const auto &x, auto vector) {
      vector = Eigen::Map<const decltype(vector)>(x.data(),
                                                  static_cast<Index>(x.size()));
      return processes.gather_all(vector);
    };
    const Eigen::VectorXi row    = gather(rows, Eigen::VectorXi()),
                          column = gather(columns, Eigen::VectorXi());
    const VectorXd value         = gather(values, VectorXd());

    std::vector<Eigen::Triplet<double>> entries;
    // Blocks come column by column.
    for (Index k = 0; k < value.size(); ++k)
      {
        const Index b = k / (block * block);
        const auto  r = static_cast<int>(k % block),
                   c  = static_cast<int>(k / block % block);
        entries.emplace_back(row[b] * block + r,
                             column[b] * block + c,
                             value[k] / scale);
      }
    const Index n = static_cast<Index>(nodes.size()) * block;
    whole.resize(n, n);
    whole.setFromTriplets(entries.begin(), entries.end());
    solver.analyzePattern(whole);
  }



  template <int block>
  VectorXf
  SurfaceSmoother<block>::part_of(const VectorXf &x) const
  {
    VectorXf part(static_cast<Index>(own.size()) * block);
    for (std::size_t k = 0; k < own.size(); ++k)
      part.segment<block>(static_cast<Index>(k) * block) =
        x.segment<block>(Index(own[k]) * block);
    return processes.gather_all(part);
  }



  /* Held unknowns keep a diagonal of one, and nothing else; their zeros stay in
     the pattern. Where a matrix has no factor the smoother of single nodes
     remains as it is: apply() does nothing then. */
  template <int block>
  void
  SurfaceSmoother<block>::factorize(const VectorXd &all_free,
                                    const Blocks   &own_added)
  {
    AssertDimension(own_added.cols(), static_cast<Index>(own.size()));
    free                 = part_of(all_free.cast<float>());
    const VectorXf added = processes.gather_all(
      VectorXf(Eigen::Map<const VectorXf>(own_added.data(), own_added.size())));
    Matrix matrix = whole;
    // A' = F (A + S) F + (1 - F) with F = 1 where unknowns are free, as on all
    // levels: smoother and levels must see the same state.
    for (Index column = 0; column < matrix.cols(); ++column)
      for (Matrix::InnerIterator entry(matrix, column); entry; ++entry)
        {
          const Index row = entry.row();
          if (row / block == column / block)
            entry.valueRef() +=
              static_cast<double>(added[column * block + row % block]);
          if (free[column] == 0 || free[row] == 0)
            entry.valueRef() = 0;
          if (row == column && entry.value() == 0)
            entry.valueRef() = 1;
        }
    // L D L^T is made without pivoting: there is none where a pivot vanishes,
    // as in a part of the surface that nothing holds.
    solver.factorize(matrix);
    is_solvable = solver.info() == Eigen::Success;
  }



  /* All processes solve for the whole surface, each for itself: to gather the
     right-hand side is the only message. */
  template <int block>
  void
  SurfaceSmoother<block>::apply(const VectorXf &r, VectorXf &z) const
  {
    AssertDimension(r.size(), z.size());
    if (!is_solvable)
      return;
    const VectorXf all = part_of(r);
    const VectorXd x   = solver.solve(VectorXd(all.cast<double>()));
    for (std::size_t k = 0; k < own.size(); ++k)
      {
        const Index row = first + static_cast<Index>(k) * block;
        z.segment<block>(Index(own[k]) * block) =
          x.segment<block>(row).template cast<float>().cwiseProduct(
            free.segment<block>(row));
      }
  }

  template class SurfaceSmoother<2>;
  template class SurfaceSmoother<3>;
} // namespace conetact::iterative
