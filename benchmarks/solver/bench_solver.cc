// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Contact solves of the condensed 3D block beside one dense LU factorisation
// of the same size, all in one run with one thread, medians of CPU seconds:
//   bench-solver [n = 32] [runs = 5] [method = automatic]
// - cold: pressed and sheared in one increment, nothing known before;
// - warm: after pressing, sheared so far that a third of the nodes change
// state.

#include "conetact/application/scene.h"
#include "conetact/base/process.h"
#include "conetact/contact/contact_model.h"
#include "conetact/solvers/solver_table.h"

#include <lapacke.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>

namespace
{
  using namespace conetact;
  using namespace conetact::application;
  using namespace conetact::bodies;
  using namespace conetact::contact;
  using namespace conetact::solvers;

  double
  cpu_seconds()
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }

  template <typename Run>
  double
  median_time(const unsigned int runs, const Run &run)
  {
    std::vector<double> times(runs);
    for (double &time : times)
      time = run();
    std::sort(times.begin(), times.end());
    return times[runs / 2];
  }

  CommandLine
  block(const int n)
  {
    const std::string m = std::to_string(n);
    CommandLine       line;
    line.scene     = CONETACT_SCENE;
    line.overrides = {"Body block/Mesh/Arguments=" + m + ", " + m + ", " + m +
                        " : 0, 0, 0 : 1, 1, 1 : true",
                      "Support top/Displacement=0.02 * (t - 1) ; 0 ; -0.01",
                      "Time/End=2",
                      "Time/Increments=2"};
    return line;
  }

  /** The block pressed, and sheared by 0.02 (t - 1). */
  class Block
  {
  public:
    explicit Block(const int n)
      : scene(block(n))
    {
      scene.build();
      model = std::make_unique<ContactModel>(scene.bodies, scene.times);
    }
    Condensation::Load
    load(const double t)
    {
      return model->condense().reduce(scene.nodal_loads().at(t),
                                      model->coordinates.prescribed(t));
    }
    const Eigen::MatrixXd &
    K()
    {
      return model->condense().system()->matrix;
    }
    ContactHistory
    history()
    {
      return ContactHistory(*model);
    }

  private:
    Scene                         scene;
    std::unique_ptr<ContactModel> model;
  };

  SolverReport
  checked_solve(ContactSolver        &solver,
                const ContactProblem &problem,
                ContactState         &state)
  {
    const SolverReport report = solver.solve(problem, state);
    if (!report.converged)
      throw std::runtime_error("not solved: " + report.reason);
    return report;
  }

  double
  time_lu(const Eigen::MatrixXd &K)
  {
    Eigen::MatrixXd         LU = K;
    std::vector<lapack_int> pivots(static_cast<std::size_t>(K.rows()));
    const auto              n     = static_cast<lapack_int>(K.rows());
    const double            start = cpu_seconds();
    LAPACKE_dgetrf(LAPACK_COL_MAJOR, n, n, LU.data(), n, pivots.data());
    return cpu_seconds() - start;
  }

  double
  time_cold(Block &block, const SolverOptions &options, SolverReport &report)
  {
    ContactHistory       history = block.history();
    const ContactProblem problem = history.problem(block.load(2));
    ContactState         state   = history.start();
    const double         start   = cpu_seconds();
    report = checked_solve(*make_solver(options), problem, state);
    return cpu_seconds() - start;
  }

  struct Warm
  {
    double       seconds = 0;
    double       changed = 0; ///< part of the nodes
    SolverReport report;
  };

  Warm
  warm_increment(Block &block, const SolverOptions &options, const double t)
  {
    const auto     solver  = make_solver(options);
    ContactHistory history = block.history();
    ContactState   state   = history.start();
    checked_solve(*solver, history.problem(block.load(1)), state);
    history.advance(state);
    const std::vector<NodeState> before = state.node;

    const ContactProblem problem = history.problem(block.load(t));
    state                        = history.start();
    Warm         result;
    const double start = cpu_seconds();
    result.report      = checked_solve(*solver, problem, state);
    result.seconds     = cpu_seconds() - start;
    for (std::size_t i = 0; i < before.size(); ++i)
      result.changed += before[i] != state.node[i];
    result.changed /= static_cast<double>(before.size());
    return result;
  }

  /** The shear at which a third of the nodes change state. */
  double
  find_third(Block &block, const SolverOptions &options)
  {
    double low = 1, high = 1;
    do
      high += .05;
    while (warm_increment(block, options, high).changed < 1. / 3 && high < 2);
    for (int i = 0; i < 8; ++i)
      {
        const double middle = .5 * (low + high);
        (warm_increment(block, options, middle).changed < 1. / 3 ? low : high) =
          middle;
      }
    return high;
  }

  void
  print(const char         *name,
        const double        seconds,
        const double        lu,
        const SolverReport &report)
  {
    std::printf("| %s | %.4f | %.2f | %s | %u | %u | %.1e |\n",
                name,
                seconds,
                seconds / lu,
                report.solver.c_str(),
                report.iterations,
                report.factorizations,
                report.residual);
  }
} // namespace

int
main(int argc, char **argv)
{
  const int  n = argc > 1 ? std::atoi(argv[1]) : 32;
  const auto runs =
    static_cast<unsigned int>(argc > 2 ? std::atoi(argv[2]) : 5);
  ProcessSession process(1);
  SolverOptions  options;
  if (argc > 3)
    options.method = argv[3];
  Block        block(n);
  const auto   size = block.K().rows();
  const double lu   = median_time(runs, [&] { return time_lu(block.K()); });
  std::printf("%ld contact nodes, a dense LU of that size: %.4f s\n\n"
              "| solve | s | LU | solver | linear solves | factorisations | "
              "residual |\n|---|---|---|---|---|---|---|\n",
              static_cast<long>(size / 3),
              lu);

  SolverReport report;
  for (const double tolerance : {1e-8, 1e-10})
    {
      options.tolerance = tolerance;
      const double cold =
        median_time(runs, [&] { return time_cold(block, options, report); });
      print(tolerance > 1e-9 ? "cold 1e-8" : "cold 1e-10", cold, lu, report);
    }

  const double t = find_third(block, options);
  Warm         warm;
  const double seconds = median_time(runs, [&] {
    warm = warm_increment(block, options, t);
    return warm.seconds;
  });
  print("warm 1e-10", seconds, lu, warm.report);
  std::printf("\nwarm: %.0f %% of the nodes change state\n",
              100 * warm.changed);
  return 0;
}
