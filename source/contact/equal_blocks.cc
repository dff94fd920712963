// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/equal_blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Unknowns     = std::vector<Index>;

    // A body that is moved by many times its size has this error in the
    // coordinates of its nodes.
    constexpr double round_off = 1e-13;

    // Sets of bodies, each with a tree: a root is its own parent.
    unsigned int
    root_of(unsigned int body, std::vector<unsigned int> &parent)
    {
      while (parent[body] != body)
        body = parent[body] = parent[parent[body]];
      return body;
    }

    // Unknowns of bodies that are not coupled, in the order of the first.
    std::vector<Unknowns>
    uncoupled_parts(const SparseMatrix              &upper,
                    const std::vector<unsigned int> &body_of)
    {
      std::vector<unsigned int> parent(
        1 + *std::max_element(body_of.begin(), body_of.end()));
      std::iota(parent.begin(), parent.end(), 0);
      for (Index column = 0; column < upper.cols(); ++column)
        for (SparseMatrix::InnerIterator entry(upper, column); entry; ++entry)
          if (body_of[entry.row()] != body_of[column])
            {
              const unsigned int a   = root_of(body_of[entry.row()], parent),
                                 b   = root_of(body_of[column], parent);
              parent[std::max(a, b)] = std::min(a, b);
            }
      std::vector<Unknowns> parts(parent.size());
      for (Index i = 0; i < upper.cols(); ++i)
        parts[root_of(body_of[i], parent)].push_back(i);
      parts.erase(std::remove(parts.begin(), parts.end(), Unknowns()),
                  parts.end());
      return parts;
    }

    double
    largest_diagonal(const SparseMatrix &upper, const Unknowns &part)
    {
      double largest = 0;
      for (const Index i : part)
        for (SparseMatrix::InnerIterator entry(upper, i); entry; ++entry)
          if (entry.row() == i)
            largest = std::max(largest, entry.value());
      return largest;
    }

    // `place` of each unknown in its part.
    bool
    are_equal(const SparseMatrix       &upper,
              const Index               n_schur,
              const std::vector<Index> &place,
              const Unknowns           &a,
              const Unknowns           &b)
    {
      if (a.size() != b.size())
        return false;
      // a positive semidefinite matrix has its largest value there
      const double bound   = round_off * largest_diagonal(upper, a);
      const Index  n_first = upper.cols() - n_schur;
      for (std::size_t k = 0; k < a.size(); ++k)
        {
          SparseMatrix::InnerIterator i(upper, a[k]), j(upper, b[k]);
          for (; i && j; ++i, ++j)
            if (place[i.row()] != place[j.row()] ||
                !(std::abs(i.value() - j.value()) <= bound))
              return false;
          if (i || j || (a[k] < n_first) != (b[k] < n_first))
            return false;
        }
      return true;
    }

    void
    merge_single_blocks(std::vector<EqualBlocks> &groups)
    {
      const auto single = std::stable_partition(groups.begin(),
                                                groups.end(),
                                                [](const EqualBlocks &group) {
                                                  return group.size() > 1;
                                                });
      if (single == groups.end())
        return;
      Unknowns rest;
      for (auto group = single; group != groups.end(); ++group)
        rest.insert(rest.end(), (*group)[0].begin(), (*group)[0].end());
      std::sort(rest.begin(), rest.end());
      groups.erase(single, groups.end());
      if (!groups.empty())
        groups.push_back({rest});
    }
  } // namespace



  std::vector<EqualBlocks>
  find_equal_blocks(const SparseMatrix              &upper,
                    const Index                      n_schur,
                    const std::vector<unsigned int> &body_of)
  {
    if (std::all_of(body_of.begin(), body_of.end(), [&](const unsigned int b) {
          return b == body_of[0];
        }))
      return {};
    const std::vector<Unknowns> parts = uncoupled_parts(upper, body_of);
    std::vector<Index>          place(body_of.size());
    for (const Unknowns &part : parts)
      for (std::size_t k = 0; k < part.size(); ++k)
        place[part[k]] = static_cast<Index>(k);

    std::vector<EqualBlocks> groups;
    for (const Unknowns &part : parts)
      {
        const auto group = std::find_if(
          groups.begin(), groups.end(), [&](const EqualBlocks &other) {
            return are_equal(upper, n_schur, place, other[0], part);
          });
        if (group == groups.end())
          groups.push_back({part});
        else
          group->push_back(part);
      }
    merge_single_blocks(groups);
    return groups;
  }
} // namespace conetact
