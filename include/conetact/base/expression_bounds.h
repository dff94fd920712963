// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_expression_bounds_h
#define conetact_base_expression_bounds_h

#include <limits>
#include <map>
#include <set>
#include <string>

namespace conetact
{
  /** All numbers from low to high, which may be infinite. */
  struct Bounds
  {
    double low  = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    bool
    is_point() const
    {
      return low == high;
    }
  };

  /** What the text of an expression tells of its values. */
  struct ExpressionBounds
  {
    Bounds                values;
    std::set<std::string> names; ///< of variables that they depend on
  };

  /**
   * By the rules of interval arithmetic, part by part, from bounds of all
   * variables: no value is outside, and 0*v or min(0.3, 0.4 + s^2) depend on
   * nothing. Text that is not understood has infinite bounds and depends on
   * all variables. `text` is one that muParser takes.
   */
  ExpressionBounds
  bounds_of(const std::string                   &text,
            const std::map<std::string, Bounds> &variables);
} // namespace conetact

#endif
