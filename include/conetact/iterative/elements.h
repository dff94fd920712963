// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_elements_h
#define conetact_iterative_elements_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace conetact::iterative
{
  /** All elements of a stiffness. */
  struct Elements
  {
    /** The unknowns of each, which are as many as its matrix has rows
     * [force/length]. */
    std::function<void(
      const std::function<void(const std::vector<Eigen::Index> &unknowns,
                               const double *matrix)> &visit)>
      for_each;
    /** The same, in the same order, without matrices. */
    std::function<void(const std::function<void(
                         const std::vector<Eigen::Index> &unknowns)> &visit)>
      for_each_connection;
  };
} // namespace conetact::iterative

#endif
