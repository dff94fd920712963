// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_backends_separate_systems_h
#define conetact_backends_separate_systems_h

#include "conetact/backends/large_stiffness.h"

namespace conetact::backends
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
} // namespace conetact::backends

#endif
