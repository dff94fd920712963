// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_condenser_h
#define conetact_condensed_condenser_h

#include "conetact/condensed/schur_solver.h"

#include <memory>
#include <string>
#include <vector>

namespace conetact::condensed
{
  /**
   * A way to condense stiffness that a scene may name: one row of
   * condenser_table(). Rows live as long as the program.
   */
  struct Condenser
  {
    const char *name;
    const char *description;
    /**
     * See SchurSolver. Throws SingularMatrix, std::bad_alloc, InputError for a
     * system that is too large for it.
     */
    std::unique_ptr<SchurSolver> (*create)(
      const Eigen::SparseMatrix<double> &upper,
      const Eigen::Index                 n_schur,
      const std::vector<unsigned int>   &node_of);
    /** What that would take; nothing is factorised. Throws InputError. */
    FactorEstimate (*estimate)(const Eigen::SparseMatrix<double> &upper,
                               const Eigen::Index                 n_schur,
                               const std::vector<unsigned int>   &node_of);
  };
  const std::vector<Condenser> &
  condenser_table();

  /** The condenser of scenes that name none, the fastest one. */
  const Condenser &
  default_condenser();

  /** Throws std::invalid_argument for a name that condenser_table() has not. */
  const Condenser &
  condenser_named(const std::string &name);

  /** One that shares no step with it, to compare with. */
  const Condenser &
  independent_of(const Condenser &condenser);
} // namespace conetact::condensed

#endif
