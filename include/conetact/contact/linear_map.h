// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_linear_map_h
#define conetact_contact_linear_map_h

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace conetact::contact
{
  /** A sparse linear map @f$ u = C q @f$, written row by row. */
  class LinearMap
  {
  public:
    struct Entry
    {
      Eigen::Index unknown;
      double       factor;
    };

    Eigen::Index
    n_unknowns() const
    {
      return columns;
    }
    /** Row i of C: its first entry and one past its last. */
    std::pair<const Entry *, const Entry *>
    row(const Eigen::Index i) const
    {
      const auto k = static_cast<std::size_t>(i);
      return {entries.data() + row_start[k], entries.data() + row_start[k + 1]};
    }
    /** C q. */
    Eigen::VectorXd
    expand(const Eigen::VectorXd &q) const;
    /** C^T f. */
    Eigen::VectorXd restrict(const Eigen::VectorXd &f) const;

    /** Rows are written one after the other; an unknown may come twice. */
    void
    append(const Eigen::Index unknown, const double factor)
    {
      entries.push_back({unknown, factor});
    }
    void
    end_row()
    {
      row_start.push_back(entries.size());
    }
    void
    set_n_unknowns(const Eigen::Index number)
    {
      columns = number;
    }
    void
    reserve(const std::size_t n_rows)
    {
      entries.reserve(n_rows);
      row_start.reserve(n_rows + 1);
    }

  private:
    Eigen::Index             columns = 0;
    std::vector<Entry>       entries;
    std::vector<std::size_t> row_start = {0};
  };
} // namespace conetact::contact

#endif
