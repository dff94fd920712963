// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_elements_h
#define conetact_backends_elements_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace conetact::backends
{
  /**
   * Calls back with all elements of a stiffness: the unknowns of each, which
   * are as many as its matrix has rows [force/length].
   */
  using Elements = std::function<void(
    const std::function<void(const std::vector<Eigen::Index> &unknowns,
                             const double                    *matrix)> &visit)>;
} // namespace conetact::backends

#endif
