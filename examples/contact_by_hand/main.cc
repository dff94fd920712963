// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact problem by hand: two nodes on springs above a floor, pressed by
// 10 and pulled along it by 2 and 5, with a friction coefficient of 0.3.

#include "conetact/solvers/solver_table.h"

#include <cstdio>

using namespace conetact;
using namespace conetact::solvers;

int
main()
{
  // unknowns of each node: along the floor, then away from it
  auto system   = std::make_shared<ContactSystem>();
  system->first = {0, 2, 4};
  system->mu    = Eigen::Vector2d(.3, .3);
  // v = u + (0, gap), K u = r + loads
  system->matrix = Eigen::Vector4d(100, 100, 100, 100).asDiagonal();
  const Eigen::Vector4d loads(2, -10, 5, -10);

  ContactProblem problem;
  problem.system = system;
  problem.gap    = Eigen::Vector2d(0, .02);
  problem.load   = loads + 100 * Eigen::Vector4d(0, 0, 0, .02); // K (0, gap)

  ContactState state;
  state.v = Eigen::Vector4d(0, 0, 0, .02);
  state.r = Eigen::Vector4d::Zero();

  const SolverReport report = make_solver({})->solve(problem, state);
  if (!report.converged)
    {
      std::printf("not solved: %s\n", report.reason.c_str());
      return 1;
    }
  const char *names[] = {"open", "stick", "slip"};
  for (int i = 0; i < 2; ++i)
    std::printf(
      "node %d: r_t = %g, r_n = %g, %s by %g\n",
      i,
      state.r[2 * i],
      state.r[2 * i + 1],
      names[static_cast<int>(state.node[static_cast<std::size_t>(i)])],
      state.v[2 * i]);
}
