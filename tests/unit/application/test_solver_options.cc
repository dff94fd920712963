// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/solver_options.h"
#include "conetact/solvers/solver_table.h"

#include <gtest/gtest.h>

using namespace conetact;
using namespace conetact::application;
using namespace conetact::load_path;
using namespace conetact::solvers;

namespace
{
  struct Options
  {
    SolverOptions solver;
    PathSettings  path;

    explicit Options(const std::string &entries)
    {
      dealii::ParameterHandler prm;
      declare_solver(prm);
      prm.parse_input_from_string(entries);
      solver = create_solver_options(prm);
      path   = create_path_settings(prm);
    }
  };
} // namespace



TEST(SolverOptions, DefaultsAreThoseOfTheSolvers)
{
  const Options       options("");
  const SolverOptions defaults;
  EXPECT_EQ(options.solver.method, defaults.method);
  EXPECT_EQ(options.solver.tolerance, defaults.tolerance);
  EXPECT_EQ(options.solver.smoothing.rho, defaults.smoothing.rho);
  EXPECT_EQ(options.solver.smoothing.beta0, defaults.smoothing.beta0);
  EXPECT_EQ(options.solver.smoothing.max_iterations,
            defaults.smoothing.max_iterations);
  EXPECT_FALSE(options.path.follows);
}



TEST(SolverOptions, EveryEntryArrives)
{
  const Options options("set Method = smoothing\nset Tolerance = 1e-7\n"
                        "subsection Smoothing\n"
                        "set sigma = 0.25\nset Maximal iterations = 9\nend");
  EXPECT_EQ(options.solver.method, "smoothing");
  EXPECT_EQ(options.solver.tolerance, 1e-7);
  EXPECT_EQ(options.solver.smoothing.sigma, .25);
  EXPECT_EQ(options.solver.smoothing.max_iterations, 9);
}



TEST(SolverOptions, AllMethodsOfTheTableMayBeChosen)
{
  for (const SolverRow &row : solver_table())
    EXPECT_EQ(Options("set Method = " + std::string(row.name)).solver.method,
              row.name);
}



TEST(SolverOptions, PathsLeaveTheSolverAlone)
{
  const Options options("set Method = load path\nset Law = holonomic");
  EXPECT_TRUE(options.path.follows);
  EXPECT_EQ(options.path.law, PathLaw::holonomic);
  EXPECT_EQ(options.solver.method, SolverOptions().method);
}
