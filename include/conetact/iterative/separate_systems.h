// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_separate_systems_h
#define conetact_iterative_separate_systems_h

#include "conetact/iterative/large_stiffness.h"

namespace conetact::iterative
{
  /**
   * The system of `given`, of which the nodes `direct` are factorised and all
   * others solved by iterations (make_large_system()). No element may have
   * nodes of both.
   */
  std::shared_ptr<const solvers::LargeSystem>
  make_separate_systems(LargeStiffness              &&given,
                        const std::set<unsigned int> &direct,
                        const unsigned int            dim);
} // namespace conetact::iterative

#endif
