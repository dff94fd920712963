// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// The innermost pieces of an increment under Google Benchmark, one thread:
// cone projections of one node, one Newton step of n nodes (all factored
// anew), the condensation of block-press-shear.prm with n^3 elements.

#include "conetact/application/scene.h"
#include "conetact/base/process.h"
#include "conetact/contact/contact_model.h"
#include "conetact/solvers/node_sets.h"

#include <benchmark/benchmark.h>

#include "random_problem.h"

namespace
{
  using namespace conetact;
  using namespace conetact::application;
  using namespace conetact::contact;
  using namespace conetact::solvers;

  /** Vectors of `size` in and around the cone. */
  std::vector<SmallVector>
  points(const Eigen::Index size)
  {
    std::mt19937             random(1);
    std::vector<SmallVector> result(1024, SmallVector(size));
    for (SmallVector &z : result)
      for (Eigen::Index i = 0; i < size; ++i)
        z[i] = internal::uniform(random, -1, 1);
    return result;
  }

  void
  friction_cone(benchmark::State &state)
  {
    const auto  z = points(state.range(0));
    std::size_t i = 0;
    for (auto _ : state)
      benchmark::DoNotOptimize(project_on_friction_cone(z[++i % 1024], .3));
  }
  BENCHMARK(friction_cone)->ArgName("size")->Arg(2)->Arg(3);

  void
  smoothed_cone_and_derivative(benchmark::State &state)
  {
    const auto  z = points(state.range(0));
    std::size_t i = 0;
    for (auto _ : state)
      benchmark::DoNotOptimize(smoothed_projection(z[++i % 1024], 1e-3));
  }
  BENCHMARK(smoothed_cone_and_derivative)->ArgName("size")->Arg(2)->Arg(3);

  void
  newton_step(benchmark::State &state)
  {
    RandomOptions options;
    options.n_nodes = state.range(0);
    options.open = options.slip = 1. / 3;
    const RandomProblem random  = random_problem(options);
    LinearRelation      relation(random.problem.system);
    relation.set_load(random.problem);
    Eigen::VectorXd p, d, dp;
    relation.to_scaled(random.solution, p, d);
    const auto laws =
      linearized_laws(relation, sets_of_point(relation, p, d), p, d);
    const Eigen::VectorXd rho = 1e-3 * Eigen::VectorXd::Ones(p.size());
    for (auto _ : state)
      if (!NewtonSystem().solve(relation, laws, rho, 1e-4, dp))
        state.SkipWithError("singular");
  }
  BENCHMARK(newton_step)
    ->ArgName("nodes")
    ->Arg(50)
    ->Arg(200)
    ->Arg(800)
    ->Unit(benchmark::kMillisecond);

  void
  condensation(benchmark::State &state)
  {
    const std::string n = std::to_string(state.range(0));
    CommandLine       line;
    line.scene     = CONETACT_SCENE;
    line.overrides = {"Body block/Mesh/Arguments=" + n + ", " + n + ", " + n +
                      " : 0, 0, 0 : 1, 1, 1 : true"};
    Scene scene(line);
    scene.build();
    for (auto _ : state)
      ContactModel(scene.bodies, scene.times).condense();
  }
  BENCHMARK(condensation)
    ->ArgName("n")
    ->Arg(8)
    ->Arg(16)
    ->Arg(24)
    ->Unit(benchmark::kMillisecond);
} // namespace

int
main(int argc, char **argv)
{
  const ProcessSession process(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
