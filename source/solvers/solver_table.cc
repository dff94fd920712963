// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/solver_table.h"

#include "conetact/solvers/active_set.h"
#include "conetact/solvers/automatic.h"
#include "conetact/solvers/gauss_seidel.h"
#include "conetact/solvers/smoothing_newton.h"

#include <stdexcept>

namespace conetact::solvers
{
  const std::vector<SolverRow> &
  solver_table()
  {
    static const std::vector<SolverRow> table = {
      {"automatic",
       "active set, then smoothing, then the increment in parts",
       &make_automatic},
      {"active set",
       "semismooth Newton on the contact states, fast from a good start",
       &make_active_set},
      {"smoothing",
       "smoothing and regularisation of the cones, robust from any start",
       &make_smoothing_newton},
      {"gauss-seidel",
       "node by node, slow: a baseline to compare with",
       &make_gauss_seidel},
    };
    return table;
  }



  std::unique_ptr<ContactSolver>
  make_solver(const SolverOptions &options)
  {
    std::string names;
    for (const SolverRow &row : solver_table())
      {
        if (options.method == row.name)
          return row.create(options);
        names += (names.empty() ? "" : ", ") + std::string(row.name);
      }
    throw std::invalid_argument("there is no solver '" + options.method +
                                "'; there are: " + names);
  }
} // namespace conetact::solvers
