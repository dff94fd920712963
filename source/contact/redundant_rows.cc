// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/redundant_rows.h"

#include <Eigen/QR>

#include <algorithm>
#include <map>
#include <numeric>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    using Rows     = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    using Triplets = std::vector<Eigen::Triplet<double>>;

    /** Entries of rows and pivots, which are about one, are rounding below
     * this. */
    constexpr double zero = 1e-9;

    /**
     * A node tells all of its reactions by itself if its smallest pivot is
     * above this: far from rounding. Others are left to the rank of their
     * group.
     */
    constexpr double safe = 1e-4;

    /**
     * Nodes with rows, and who else has entries where they have. In H^T r = 0
     * the unknowns that only one node has tell its reactions, if they are
     * enough: these are 0, no dependence has a part of them, and the node is
     * taken away, which may leave others alone with their unknowns. Few remain,
     * and dense factors of them are small.
     */
    class Remaining
    {
    public:
      Remaining(const Rows &r, const std::vector<Index> &f)
        : rows(r)
        , first(f)
        , at_column(static_cast<std::size_t>(rows.cols()))
      {
        for (std::size_t i = 0; i + 1 < first.size(); ++i)
          for_entries(i, [&](const Index column, double) {
            if (at_column[at(column)].empty() ||
                at_column[at(column)].back() != i)
              at_column[at(column)].push_back(i);
          });
        taken.resize(first.size() - 1, false);
        for (std::size_t i = 0; i < taken.size(); ++i)
          take_if_alone(i);
      }

      /** Nodes that remain, those that share unknowns together. */
      std::vector<std::vector<std::size_t>>
      groups() const
      {
        std::vector<std::vector<std::size_t>> result;
        std::vector<bool>                     seen = taken;
        for (std::size_t i = 0; i < seen.size(); ++i)
          if (!seen[i])
            {
              result.emplace_back(1, i);
              seen[i] = true;
              for (std::size_t k = 0; k < result.back().size(); ++k)
                for_entries(result.back()[k], [&](const Index column, double) {
                  for (const std::size_t other : at_column[at(column)])
                    if (!seen[other])
                      {
                        seen[other] = true;
                        result.back().push_back(other);
                      }
                });
            }
        return result;
      }

    private:
      static std::size_t
      at(const Index i)
      {
        return static_cast<std::size_t>(i);
      }

      template <typename F>
      void
      for_entries(const std::size_t i, const F &f) const
      {
        for (Index row = first[i]; row < first[i + 1]; ++row)
          for (Rows::InnerIterator it(rows, row); it; ++it)
            if (std::abs(it.value()) > zero)
              f(it.col(), it.value());
      }

      /* Whoever shared unknowns with it may be alone then. */
      void
      take_if_alone(const std::size_t start)
      {
        std::vector<std::size_t> waiting(1, start);
        while (!waiting.empty())
          {
            const std::size_t i = waiting.back();
            waiting.pop_back();
            if (taken[i] || !is_told_alone(i))
              continue;
            taken[i] = true;
            for_entries(i, [&](const Index column, double) {
              std::vector<std::size_t> &there = at_column[at(column)];
              there.erase(std::remove(there.begin(), there.end(), i),
                          there.end());
              if (there.size() == 1)
                waiting.push_back(there.front());
            });
          }
      }

      /* Whether H^T r = 0 in the unknowns of this node alone says r = 0: its
         rows have full rank there. */
      bool
      is_told_alone(const std::size_t i) const
      {
        std::map<Index, Index> own;
        for_entries(i, [&](const Index column, double) {
          if (at_column[at(column)].size() == 1)
            own.emplace(column, static_cast<Index>(own.size()));
        });
        const Index n = first[i + 1] - first[i];
        if (static_cast<Index>(own.size()) < n)
          return false;
        MatrixXd local = MatrixXd::Zero(static_cast<Index>(own.size()), n);
        for (Index row = 0; row < n; ++row)
          for (Rows::InnerIterator it(rows, first[i] + row); it; ++it)
            if (const auto column = own.find(it.col()); column != own.end())
              local(column->second, row) += it.value();
        // Pivots fall: the last one tells whether columns are independent.
        const Eigen::ColPivHouseholderQR<MatrixXd> qr(local);
        return std::abs(qr.matrixR()(n - 1, n - 1)) > safe;
      }

      const Rows                           &rows;
      const std::vector<Index>             &first;
      std::vector<std::vector<std::size_t>> at_column; ///< nodes that remain
      std::vector<bool>                     taken;
    };

    /**
     * The rank of the rows of a group: H^T D P = Q R with the unit columns of
     * H^T D and pivots P of falling size. The first `rank` columns are
     * independent and imply the others.
     */
    class Group
    {
    public:
      Group(const Rows                     &rows,
            const std::vector<Index>       &first,
            const std::vector<std::size_t> &nodes)
      {
        for (const std::size_t i : nodes)
          for (Index row = first[i]; row < first[i + 1]; ++row)
            numbers.push_back(row);
        std::map<Index, Index> place;
        for (const Index row : numbers)
          for (Rows::InnerIterator it(rows, row); it; ++it)
            place.emplace(it.col(), static_cast<Index>(place.size()));
        const auto n     = static_cast<Index>(numbers.size());
        MatrixXd   dense = MatrixXd::Zero(static_cast<Index>(place.size()), n);
        size             = VectorXd::Zero(n);
        for (Index k = 0; k < n; ++k)
          {
            for (Rows::InnerIterator it(rows,
                                        numbers[static_cast<std::size_t>(k)]);
                 it;
                 ++it)
              dense(place[it.col()], k) += it.value();
            if (const double norm = dense.col(k).norm(); norm > zero)
              size[k] = 1 / norm;
          }
        dense *= size.asDiagonal();
        const Index least = std::min(dense.rows(), n);
        if (least > 0)
          qr.compute(dense);
        while (rank < least && std::abs(qr.matrixR()(rank, rank)) > zero)
          ++rank;
        order = Eigen::VectorXi::LinSpaced(n, 0, static_cast<int>(n) - 1);
        if (least > 0)
          order = qr.colsPermutation().indices();
      }

      void
      mark_independent(std::vector<bool> &independent) const
      {
        for (Index k = 0; k < order.size(); ++k)
          independent[static_cast<std::size_t>(number(k))] = k < rank;
      }

      /* Reactions r with H^T r = 0: those of the rows that others imply are
         chosen, r_2 = 1 one by one, the others follow, r_1 = -R_11^-1 R_12 r_2,
         all times D. Orthonormal columns make the least reaction a
         projection. */
      void
      append_open(Index &column, Triplets &entries) const
      {
        const Index n = order.size(), n_open = n - rank;
        if (n_open == 0)
          return;
        MatrixXd of_scaled(n, n_open);
        of_scaled.bottomRows(n_open).setIdentity();
        if (rank > 0)
          of_scaled.topRows(rank) =
            -qr.matrixR()
               .topLeftCorner(rank, rank)
               .triangularView<Eigen::Upper>()
               .solve(qr.matrixR().topRightCorner(rank, n_open));
        for (Index k = 0; k < n; ++k)
          if (size[order[k]] > 0)
            of_scaled.row(k) *= size[order[k]];
        const Eigen::HouseholderQR<MatrixXd> orthonormal(of_scaled);
        const MatrixXd                       basis =
          orthonormal.householderQ() * MatrixXd::Identity(n, n_open);
        for (Index j = 0; j < n_open; ++j, ++column)
          for (Index k = 0; k < n; ++k)
            if (basis(k, j) != 0)
              entries.emplace_back(number(k), column, basis(k, j));
      }

    private:
      Index
      number(const Index k) const
      {
        return numbers[static_cast<std::size_t>(order[k])];
      }

      std::vector<Index>                   numbers;
      VectorXd                             size; ///< factors; 0: nothing there
      Eigen::ColPivHouseholderQR<MatrixXd> qr;
      Eigen::VectorXi                      order;
      Index                                rank = 0;
    };

    /**
     * The rows H of what is bound, in unknowns that supports leave: what a
     * support holds has no column, so that a row of zeros is one that supports
     * imply.
     */
    Rows
    bound_rows(const model::Bodies &bodies,
               const ContactPoints &points,
               const Coordinates   &coordinates,
               const RigidMotions  &motions)
    {
      // A rigid body has no unknowns but its motions: they stand behind those
      // of the others.
      const auto           &body_of = motions.body_of_own();
      const auto            rigid   = std::find_if(body_of.begin(),
                                      body_of.end(),
                                      [&](const unsigned int body) {
                                        return bodies.is_rigid(body);
                                      });
      std::vector<VectorXd> fields;
      for (auto body = rigid; body != body_of.end(); ++body)
        fields.push_back(
          motions.field(motions.own().col(body - body_of.begin())));
      Triplets   entries;
      Index      row = 0;
      const auto add = [&](const ContactPoint &point,
                           const Tensor<1, 3> &dual) {
        pairing::for_each_side(
          *point.node,
          [&](const unsigned int body,
              const unsigned int node,
              const double       weight) {
            const Tensor<1, 3> d     = bodies.in_frame(body, weight * dual);
            const Index        first = coordinates.dof(body, node);
            for (unsigned int c = 0; c < bodies.dim; ++c)
              coordinates.for_row(
                first + c, [&](const Index unknown, const double factor) {
                  entries.emplace_back(row, unknown, d[c] * factor);
                });
            for (std::size_t j = 0; j < fields.size(); ++j)
              entries.emplace_back(row,
                                   coordinates.n_unknowns() +
                                     static_cast<Index>(j),
                                   coordinates.at_node(fields[j], body, node) *
                                     (weight * dual));
          });
        ++row;
      };
      for (std::size_t i = points.size(); i < points.all().size(); ++i)
        for (const Tensor<1, 3> &dual : points.all()[i].dual)
          add(points.all()[i], dual);
      Rows rows(points.n_bound_unknowns(),
                coordinates.n_unknowns() + static_cast<Index>(fields.size()));
      rows.setFromTriplets(entries.begin(), entries.end());
      return rows;
    }
  } // namespace

  RedundantRows
  find_redundant_rows(const Rows &rows, const std::vector<Index> &first)
  {
    const Remaining   remaining(rows, first);
    std::vector<bool> independent(static_cast<std::size_t>(rows.rows()), true);
    Triplets          entries;
    Index             n_open = 0;
    for (const auto &nodes : remaining.groups())
      {
        const Group group(rows, first, nodes);
        group.mark_independent(independent);
        group.append_open(n_open, entries);
      }
    RedundantRows result;
    for (Index row = 0; row < rows.rows(); ++row)
      if (independent[static_cast<std::size_t>(row)])
        result.independent.push_back(row);
    result.open.resize(rows.rows(), n_open);
    result.open.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  RedundantRows
  find_redundant_rows(const model::Bodies &bodies,
                      const ContactPoints &points,
                      const Coordinates   &coordinates,
                      const RigidMotions  &motions)
  {
    std::vector<Index> first;
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      first.push_back(points.all()[i].first - points.n_unknowns());
    first.push_back(points.n_bound_unknowns());
    return find_redundant_rows(bound_rows(bodies, points, coordinates, motions),
                               first);
  }
} // namespace conetact::contact
