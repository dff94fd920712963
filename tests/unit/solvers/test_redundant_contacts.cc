// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Rigid blocks on several contacts a face: W of low rank, reactions that are
// not unique, unsymmetric where bodies spin.

#include "conetact/solvers/interior_point.h"
#include "conetact/solvers/redundant_contacts.h"
#include "conetact/solvers/solver_table.h"

#include <gtest/gtest.h>

#include <string>

#include "rigid_bodies.h"

using namespace conetact;
using namespace conetact::solvers;
using Eigen::VectorXd;

namespace
{
  constexpr double tolerance = 1e-10;

  SolverReport
  solve(const ContactProblem &problem, ContactState &state)
  {
    SolverOptions options;
    options.tolerance    = tolerance;
    options.max_substeps = 1;
    state.v = state.r = VectorXd::Zero(problem.load.size());
    return make_solver(options)->solve(problem, state);
  }

  void
  expect_solved(const std::string &name, const RigidBodies &bodies)
  {
    const ContactProblem problem = bodies.problem();
    ContactState         state;
    const SolverReport   report = solve(problem, state);
    EXPECT_TRUE(report.converged) << name << ": " << report.reason;
    EXPECT_LE(contact_residual(problem, state), tolerance) << name;
    EXPECT_EQ(report.residual, contact_residual(problem, state)) << name;
    // how many it takes where starts fail depends on the processor's rounding
    EXPECT_LT(report.factorizations, 5000u) << name;
  }
} // namespace



TEST(RedundantContacts, BodiesAtRest)
{
  for (const int dim : {2, 3})
    {
      expect_solved("tower", tower(dim, 8));
      expect_solved("leaning tower", tower(dim, 8, .02));
      expect_solved("wall", wall(dim, 4, 4));
      expect_solved("arch", arch(dim, 12));
    }
}



TEST(RedundantContacts, BodiesThatMoveAndSpin)
{
  for (const int dim : {2, 3})
    for (const double mu : {.1, .5})
      for (RigidBodies bodies : {tower(dim, 8), wall(dim, 3, 3), arch(dim, 12)})
        {
          bodies.mu = mu;
          shake(bodies, .05, 1);
          expect_solved(std::to_string(bodies.blocks.size()) + " blocks, mu " +
                          std::to_string(mu),
                        bodies);
        }
}



TEST(RedundantContacts, LongChain)
{
  // 2020 contacts in the plane: no work that grows with their square
  expect_solved("tower of 1010", tower(2, 1010));
}



TEST(RedundantContacts, ForcesBalance)
{
  const RigidBodies    bodies  = wall(3, 3, 3);
  const ContactProblem problem = bodies.problem();
  ContactState         state;
  ASSERT_TRUE(solve(problem, state).converged);
  // Reactions carry the weight of every body. The foundation, a million times
  // heavier, gives way a little.
  const VectorXd rest = bodies.directions() * state.r + bodies.load();
  EXPECT_LT(rest.tail(rest.size() - 6).norm(), 1e-5 * bodies.load().norm());
}



TEST(RedundantContacts, StopsWhenToldTo)
{
  RigidBodies bodies = wall(3, 3, 3);
  shake(bodies, 1, 5);
  const ContactProblem problem = bodies.problem();
  SolverOptions        options;
  unsigned int         asked = 0;
  options.stop               = [&] { return ++asked > 3; };
  ContactState state;
  state.v = state.r = VectorXd::Zero(problem.load.size());
  const SolverReport report =
    make_redundant_contacts(options)->solve(problem, state);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("limit of time"), std::string::npos);
  EXPECT_EQ(report.residual, contact_residual(problem, state));
  EXPECT_LT(asked, 20u);
}



TEST(InteriorPoint, GoesToASolution)
{
  const ContactProblem problem = wall(2, 3, 3).problem();
  LinearRelation       relation(problem.system);
  relation.set_load(problem);
  const SparseRelation sparse(relation);
  InteriorPoint        iteration(sparse, true);
  for (unsigned int i = 0; i < 60 && iteration.complementarity() > 1e-12; ++i)
    ASSERT_TRUE(iteration.step());
  EXPECT_LT(iteration.complementarity(), 1e-12);
  EXPECT_LT(iteration.defect(), 1e-5);
}
