// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_elements_h
#define conetact_backends_elements_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace conetact::backends
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
} // namespace conetact::backends

#endif
