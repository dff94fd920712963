// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/linear_map.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::contact
{
  /* A row with the one entry 1 is written as the number of its unknown, and its
     entry is given up: most rows are such. */
  void
  LinearMap::end_row()
  {
    if (entries.size() == start.back() + 1 && entries.back().factor == 1)
      {
        rows.push_back(entries.back().unknown);
        entries.pop_back();
        return;
      }
    rows.push_back(-static_cast<int>(start.size()));
    start.push_back(entries.size());
  }

  /* u = C q: displacements of all dofs from unknowns. */
  Eigen::VectorXd
  LinearMap::expand(const Eigen::VectorXd &q) const
  {
    AssertDimension(q.size(), n_unknowns());
    Eigen::VectorXd u(n_rows());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      {
        double sum = 0;
        for_row(i, [&](const Eigen::Index unknown, const double factor) {
          sum += factor * q[unknown];
        });
        u[i] = sum;
      }
    return u;
  }

  /* C^T f: forces on unknowns do the same work as those on all dofs. */
  Eigen::VectorXd LinearMap::restrict(const Eigen::VectorXd &f) const
  {
    AssertDimension(f.size(), n_rows());
    Eigen::VectorXd result = Eigen::VectorXd::Zero(columns);
    for (Eigen::Index i = 0; i < f.size(); ++i)
      for_row(i, [&](const Eigen::Index unknown, const double factor) {
        result[unknown] += factor * f[i];
      });
    return result;
  }

  /* C^T f with zeros in all other rows: a first pass finds the range of
     unknowns that these rows have, so that no vector of all of them is
     needed. */
  LinearMap::SomeUnknowns
  LinearMap::restrict_rows(const Eigen::Index     begin,
                           const Eigen::VectorXd &f) const
  {
    Assert(begin + f.size() <= n_rows(), dealii::ExcMessage("Rows are some."));
    Eigen::Index first = columns, end = 0;
    for (Eigen::Index i = 0; i < f.size(); ++i)
      for_row(begin + i, [&](const Eigen::Index unknown, double) {
        first = std::min(first, unknown);
        end   = std::max(end, unknown + 1);
      });
    SomeUnknowns result{
      first, Eigen::VectorXd::Zero(std::max<Eigen::Index>(end - first, 0))};
    for (Eigen::Index i = 0; i < f.size(); ++i)
      for_row(begin + i, [&](const Eigen::Index unknown, const double factor) {
        result.values[unknown - first] += factor * f[i];
      });
    return result;
  }
} // namespace conetact::contact
