// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_index_h
#define conetact_base_index_h

#include <cstddef>

namespace conetact
{
  /** A number that is not negative as containers count, where Eigen and MPI
   * count with signs. */
  constexpr std::size_t
  at(const std::ptrdiff_t i)
  {
    return static_cast<std::size_t>(i);
  }
} // namespace conetact

#endif
