// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/interface_sum.h"

#include <algorithm>
#include <map>
#include <set>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Map          = Substructure::Map;
    using SparseMatrix = Eigen::SparseMatrix<double>;

    // Columns that have an entry, ascending.
    std::vector<Index>
    columns_of(const Map &map)
    {
      std::vector<bool> has_entry(map.cols(), false);
      for (Index row = 0; row < map.rows(); ++row)
        for (Map::InnerIterator entry(map, row); entry; ++entry)
          has_entry[entry.col()] = true;
      std::vector<Index> columns;
      for (Index column = 0; column < map.cols(); ++column)
        if (has_entry[column])
          columns.push_back(column);
      return columns;
    }

    // Of each unknown the lists that have it.
    std::vector<std::vector<std::size_t>>
    transposed(const std::vector<std::vector<Index>> &lists, const Index n)
    {
      std::vector<std::vector<std::size_t>> lists_of(n);
      for (std::size_t k = 0; k < lists.size(); ++k)
        for (const Index i : lists[k])
          lists_of[i].push_back(k);
      return lists_of;
    }

    // T^T, columns without an entry left out.
    SparseMatrix
    compressed(const Map &T, const std::vector<Index> &columns)
    {
      std::vector<int> number(T.cols());
      for (std::size_t k = 0; k < columns.size(); ++k)
        number[columns[k]] = static_cast<int>(k);
      std::vector<Eigen::Triplet<double>> entries;
      for (Index row = 0; row < T.rows(); ++row)
        for (Map::InnerIterator entry(T, row); entry; ++entry)
          entries.emplace_back(number[entry.col()], row, entry.value());
      SparseMatrix result(static_cast<Index>(columns.size()), T.rows());
      result.setFromTriplets(entries.begin(), entries.end());
      return result;
    }
    using Clique = std::set<Index>; // of classes

    // What is coupled with a class, itself included.
    Clique
    front_of(const Index c, const std::vector<Clique> &cliques)
    {
      Clique front;
      for (const Clique &clique : cliques)
        if (clique.count(c) > 0)
          front.insert(clique.begin(), clique.end());
      return front;
    }

    // Classes of these sizes, those below n_E one after the other.
    FactorEstimate
    eliminate(std::map<Index, double> size,
              std::vector<Clique>     cliques,
              const Index             n_E)
    {
      std::map<Index, double> width; // of the fronts
      const auto              update = [&](const Index c) {
        width[c] = 0;
        for (const Index other : front_of(c, cliques))
          width[c] += size[other];
      };
      double n_entries = 0, widest = 0; // of the upper triangle, of a front
      for (const auto &[c, own] : size)
        {
          update(c);
          n_entries += own * width[c] / 2;
        }
      width.erase(width.lower_bound(n_E), width.end());

      FactorEstimate result;
      while (!width.empty())
        {
          const auto   next = std::min_element(width.begin(),
                                             width.end(),
                                             [](const auto &a, const auto &b) {
                                               return a.second < b.second;
                                             });
          const Index  c    = next->first;
          const double own = size[c], rest = next->second - own;
          result.flops += own * (own * own / 3 + own * rest + rest * rest);
          result.factor_bytes += sizeof(double) * own * (own / 2 + rest);
          widest = std::max(widest, next->second);

          Clique front = front_of(c, cliques);
          cliques.erase(std::remove_if(cliques.begin(),
                                       cliques.end(),
                                       [c](const Clique &clique) {
                                         return clique.count(c) > 0;
                                       }),
                        cliques.end());
          front.erase(c);
          width.erase(next);
          cliques.push_back(front);
          for (const Index other : front)
            if (other < n_E)
              update(other);
        }
      // entries here and twice in the direct solver, a front and what is left
      // of the one before
      constexpr double bytes_an_entry = 12 + 8 + 16;
      result.working_bytes = result.factor_bytes + bytes_an_entry * n_entries +
                             2 * sizeof(double) * widest * widest;
      return result;
    }
  } // namespace



  InterfaceSum::InterfaceSum(const std::vector<Map> &maps)
  {
    for (const Map &T : maps)
      columns.push_back(columns_of(T));
    std::map<std::vector<std::size_t>, Index> classes;
    for (const auto &uses : transposed(columns, maps[0].cols()))
      first.push_back(
        classes.emplace(uses, static_cast<Index>(first.size())).first->second);
  }



  SparseMatrix
  InterfaceSum::pattern() const
  {
    const auto         n       = static_cast<Index>(first.size());
    const auto         uses_of = transposed(columns, n);
    std::vector<Index> last_seen(n, -1), rows;
    SparseMatrix       upper(n, n);
    for (Index column = 0; column < n; ++column)
      {
        rows.assign(1, column);
        last_seen[column] = column;
        for (const std::size_t use : uses_of[column])
          for (const Index row : columns[use])
            if (row < column && last_seen[row] != column)
              {
                last_seen[row] = column;
                rows.push_back(row);
              }
        std::sort(rows.begin(), rows.end());
        upper.startVec(column);
        for (const Index row : rows)
          upper.insertBackByOuterInner(column, row) = 0;
      }
    upper.finalize();
    return upper;
  }



  void
  InterfaceSum::add(const std::size_t use,
                    const Map        &T,
                    const MatrixXd   &S,
                    SparseMatrix     &upper) const
  {
    const std::vector<Index> &seen = columns[use];
    const SparseMatrix        T_T  = compressed(T, seen);
    const MatrixXd            half = T_T * S;
    const MatrixXd            part = T_T * half.transpose();
    for (Index j = 0; j < part.cols(); ++j)
      {
        SparseMatrix::InnerIterator entry(upper, seen[j]);
        for (Index i = 0; i <= j; ++i)
          {
            while (entry.row() != seen[i])
              ++entry;
            entry.valueRef() += part(i, j);
          }
      }
  }



  FactorEstimate
  InterfaceSum::estimate(const Index n_schur) const
  {
    const auto n_E      = static_cast<Index>(first.size()) - n_schur;
    const auto class_of = [&](const Index i) {
      return i < n_E ? first[i] : n_E + first[i]; // E and C apart
    };
    std::map<Index, double> size;
    for (Index i = 0; i < n_E + n_schur; ++i)
      ++size[class_of(i)];
    std::vector<Clique> cliques;
    for (const std::vector<Index> &list : columns)
      {
        cliques.emplace_back();
        for (const Index i : list)
          cliques.back().insert(class_of(i));
      }
    return eliminate(std::move(size), std::move(cliques), n_E);
  }
} // namespace conetact
