// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_linear_map_h
#define conetact_contact_linear_map_h

#include "conetact/base/counting_list.h"
#include "conetact/base/index.h"

#include <Eigen/Core>

#include <vector>

namespace conetact::contact
{
  /**
   * A sparse linear map @f$ u = C q @f$, written row by row. Most rows are one
   * unknown, as it is, and follow those before them, and take no memory.
   */
  class LinearMap
  {
  public:
    Eigen::Index
    n_unknowns() const
    {
      return columns;
    }
    Eigen::Index
    n_rows() const
    {
      return static_cast<Eigen::Index>(rows.size());
    }
    /** The unknown that row i is; negative if it is anything else. */
    Eigen::Index
    plain(const Eigen::Index i) const
    {
      return rows[at(i)];
    }
    /** Calls f(unknown, factor) for all entries of row i of C. */
    template <typename F>
    void
    for_row(const Eigen::Index i, const F &f) const
    {
      const int row = rows[at(i)];
      if (row >= 0)
        return f(Eigen::Index(row), 1.);
      const auto k = at(-1 - row);
      for (std::size_t e = start[k]; e < start[k + 1]; ++e)
        f(Eigen::Index(entries[e].unknown), entries[e].factor);
    }
    /** C q. */
    Eigen::VectorXd
    expand(const Eigen::VectorXd &q) const;
    /** C^T f. */
    Eigen::VectorXd restrict(const Eigen::VectorXd &f) const;
    /** The same of some rows: of the unknowns from the first one that they
     * have. */
    struct SomeUnknowns
    {
      Eigen::Index    first = 0;
      Eigen::VectorXd values;

      double
      operator[](const Eigen::Index unknown) const
      {
        return values[unknown - first];
      }
    };
    /** C^T f of rows `begin`, begin + 1, ... that have f. */
    SomeUnknowns
    restrict_rows(const Eigen::Index begin, const Eigen::VectorXd &f) const;

    /** Rows are written one after the other; an unknown may come twice. */
    void
    append(const Eigen::Index unknown, const double factor)
    {
      entries.push_back({static_cast<int>(unknown), factor});
    }
    void
    end_row();
    void
    set_n_unknowns(const Eigen::Index number)
    {
      columns = number;
    }

  private:
    struct Entry
    {
      int    unknown;
      double factor;
    };

    Eigen::Index             columns = 0;
    CountingList             rows;        ///< an unknown, or -1 - k: see start
    std::vector<Entry>       entries;     ///< of all other rows
    std::vector<std::size_t> start = {0}; ///< of the k-th of these
  };
} // namespace conetact::contact

#endif
