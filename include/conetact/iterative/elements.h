// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_elements_h
#define conetact_iterative_elements_h

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace conetact::iterative
{
  /** The elements of a stiffness. */
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
    /** Those that have some of these unknowns, of all of which it is said
     * whether they are meant, and maybe others: what many processes share. None
     * if all are looked at. */
    std::function<Elements(const std::vector<bool> &unknowns)> that_have;
  };

  /** Of all elements, those that are needed for some unknowns. */
  inline Elements
  needed_for(const std::vector<bool> &unknowns, const Elements &all)
  {
    return all.that_have ? all.that_have(unknowns) : all;
  }
} // namespace conetact::iterative

#endif
