// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/linear_map.h"

namespace conetact::contact
{
  Eigen::VectorXd
  LinearMap::expand(const Eigen::VectorXd &q) const
  {
    Eigen::VectorXd u(static_cast<Eigen::Index>(row_start.size()) - 1);
    for (Eigen::Index i = 0; i < u.size(); ++i)
      {
        double sum              = 0;
        const auto [begin, end] = row(i);
        for (const Entry *entry = begin; entry != end; ++entry)
          sum += entry->factor * q[entry->unknown];
        u[i] = sum;
      }
    return u;
  }

  Eigen::VectorXd LinearMap::restrict(const Eigen::VectorXd &f) const
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(columns);
    for (Eigen::Index i = 0; i < f.size(); ++i)
      {
        const auto [begin, end] = row(i);
        for (const Entry *entry = begin; entry != end; ++entry)
          result[entry->unknown] += entry->factor * f[i];
      }
    return result;
  }
} // namespace conetact::contact
