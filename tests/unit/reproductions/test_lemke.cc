// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/reproductions/lemke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::load_path;
using namespace conetact::reproductions;
using namespace conetact::solvers;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  /** [P] Example 1: a beam on three supports, Table 1. */
  std::shared_ptr<const ContactSystem>
  beam()
  {
    auto system               = std::make_shared<ContactSystem>();
    system->first             = {0, 2, 4, 6};
    system->mu                = VectorXd::Constant(3, .6);
    system->matrix            = MatrixXd::Zero(6, 6);
    const double normal[]     = {1, -2, 1, -2, 4, -2, 1, -2, 1};
    const double tangential[] = {1, -1, 0, -1, 2, -1, 0, -1, 1};
    for (Index i = 0; i < 3; ++i)
      for (Index j = 0; j < 3; ++j)
        {
          system->matrix(2 * i, 2 * j)         = .5 * tangential[3 * i + j];
          system->matrix(2 * i + 1, 2 * j + 1) = .1875 * normal[3 * i + j];
        }
    return system;
  }

  VectorXd
  beam_load()
  {
    VectorXd f = VectorXd::Zero(6);
    f(1)       = .09375;
    f(3)       = -.6875;
    f(5)       = -.40625;
    return f;
  }

  struct BeamRun
  {
    PathResult               result;
    std::vector<PathPoint>   points;
    std::vector<std::string> lines;

    BeamRun(const double weight, const double end)
    {
      LemkeOptions options;
      options.weight = weight;
      options.log    = [this](const std::string &s) { lines.push_back(s); };
      result         = make_lemke_follower(beam(), {}, options)
                 ->follow({VectorXd::Zero(6), beam_load(), 0, end},
                          [this](const PathPoint &p) { points.push_back(p); });
    }

    /** Numbers of the row of a variable in the table after so many steps. */
    std::vector<double>
    row(int table, const std::string &variable) const
    {
      for (const std::string &line : lines)
        {
          std::istringstream in(line);
          std::string        name;
          in >> name;
          table -= name == "basis" ? 1 : 0;
          if (table < 0 && name == variable)
            {
              std::vector<double> values;
              for (double x; in >> x;)
                values.push_back(x);
              return values;
            }
        }
      return {};
    }
  };

  void
  expect_row(const std::vector<double> &row,
             const std::vector<double> &z,
             const double               p,
             const double               right)
  {
    ASSERT_EQ(row.size(), 20u);
    for (std::size_t j = 0; j < 9; ++j)
      EXPECT_NEAR(row[9 + j], z[j], 2e-4) << j;
    EXPECT_NEAR(row[18], p, 2e-4);
    EXPECT_NEAR(row[19], right, 2e-3);
  }
} // namespace

TEST(Lemke, TablesOfTheBeam)
{
  const BeamRun run(1, 20);
  // Table 1
  expect_row(run.row(0, "xn1"),
             {-.1875, .375, -.1875, 0, 0, 0, 0, 0, 0},
             .09375,
             1);
  expect_row(run.row(0, "xt2+"),
             {.225, -.45, .225, .5, -1, .5, -.5, 1, -.5},
             -.4125,
             1);
  expect_row(run.row(0, "xt3-"),
             {-.1125, .225, -.1125, 0, -.5, .5, 0, .5, -.5},
             -.24375,
             1);
  // Table 2
  expect_row(run.row(1, "p"), {-2, 4, -2, 0, 0, 0, 0, 0, 0}, 1, 10.667);
  expect_row(run.row(1, "xn2"), {-1, 2, -1, 0, 0, 0, 0, 0, 0}, 0, 8.3333);
  expect_row(run.row(1, "xn3"), {-1, 2, -1, 0, 0, 0, 0, 0, 0}, 0, 5.3333);
  expect_row(run.row(1, "xt1+"), {0, 0, 0, -.5, .5, 0, .5, -.5, 0}, 0, .4);
  expect_row(run.row(1, "xt3+"),
             {-.6, 1.2, -.6, 0, .5, -.5, 0, -.5, .5},
             0,
             3.6);
  // Table 3
  expect_row(run.row(2, "zn1"), {1, -2, 1, 0, 0, 0, 0, 0, 0}, -.5, -5.3333);
  expect_row(run.row(2, "xn2"), {0, 0, 0, 0, 0, 0, 0, 0, 0}, -.5, 3);
  expect_row(run.row(2, "xn3"), {0, 0, 0, 0, 0, 0, 0, 0, 0}, -.5, 0);
  expect_row(run.row(2, "xt2-"), {0, 0, 0, -.5, 1, -.5, .5, -1, .5}, -.3, 2.2);
}

TEST(Lemke, BeamLiftsOffItsSupport)
{
  const BeamRun run(1, 20);
  EXPECT_EQ(run.result.outcome, PathOutcome::no_further_change);
  ASSERT_EQ(run.points.size(), 2u);
  EXPECT_NEAR(run.points[0].parameter, 32. / 3, 1e-12);
  EXPECT_EQ(run.points[0].changes[0].node, 0);
  EXPECT_EQ(run.points[0].changes[0].to, PathState::open);
  const PathPoint &end = run.points[1];
  EXPECT_NEAR(end.v(1), 10, 1e-12); // p / 2
  EXPECT_NEAR(end.r(3), 10, 1e-12);
  EXPECT_NEAR(end.r(5), 10, 1e-12);
  EXPECT_LE(end.residual, 1e-14);
  // the weight is artificial: the event is proportional to it
  EXPECT_NEAR(BeamRun(3, 100).points[0].parameter, 32, 1e-12);
}

TEST(Lemke, StopsAtItsTarget)
{
  const BeamRun run(1, 5);
  EXPECT_EQ(run.result.outcome, PathOutcome::target_reached);
  ASSERT_EQ(run.points.size(), 1u);
  EXPECT_NE(run.lines.back().find("criterion 1"), std::string::npos);
  // without the tightening it is no solution, and says so
  EXPECT_GT(run.points[0].residual, .01);
}

TEST(Lemke, NamesAMechanism)
{
  // a node pulled along the floor that nothing else holds
  auto system    = std::make_shared<ContactSystem>();
  system->first  = {0, 2};
  system->mu     = VectorXd::Constant(1, .5);
  system->matrix = MatrixXd::Zero(2, 2);
  LemkeOptions options;
  options.weight = 2;
  const PathResult result =
    make_lemke_follower(system, {}, options)
      ->follow({Eigen::Vector2d(0, -1), Eigen::Vector2d(1, 0), 0, 9}, {});
  EXPECT_EQ(result.outcome, PathOutcome::limit_load);
  EXPECT_NEAR(result.parameter, .5 + 2, 1e-14);
  EXPECT_NEAR(result.mechanism(0), 1, 1e-14);
}

TEST(Lemke, RefusesWhatItCannotStart)
{
  LemkeOptions options;
  const auto   lift = make_lemke_follower(beam(), {}, options)
                      ->follow({2 * VectorXd::Ones(6), beam_load(), 0, 1}, {});
  EXPECT_EQ(lift.outcome, PathOutcome::not_converged);
  EXPECT_NE(lift.reason.find("tightening weight"), std::string::npos);
  auto compliance  = std::make_shared<ContactSystem>(*beam());
  compliance->form = Form::compliance;
  EXPECT_THROW(make_lemke_follower(compliance, {}, options),
               std::invalid_argument);
}



TEST(Lemke, PivotsWhereTheEventFollowerHasItsEvents)
{
  // Pressed, stuck nodes with much friction: p falls and grows. With cohesion
  // nothing is degenerate, so that each event is one pivot.
  unsigned int turns = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
    {
      internal::Random random(seed);
      const auto       n      = static_cast<Index>(1 + seed % 6);
      auto             system = std::make_shared<ContactSystem>();
      MatrixXd         none;
      system->matrix = internal::random_operator(random, 2 * n, 0, .5, none);
      system->mu     = VectorXd::Constant(n, 1. + seed % 7);
      const VectorXd rate  = internal::random_matrix(random, 2 * n, 1);
      VectorXd       press = VectorXd::Zero(2 * n);
      for (Index i = 0; i < n; ++i)
        {
          system->first.push_back(2 * (i + 1));
          press(2 * i + 1) = -internal::uniform(random, .5, 1.5);
        }
      PathOptions path;
      path.law      = PathLaw::holonomic;
      path.cohesion = VectorXd::Constant(n, .01);
      std::vector<double> events, pivots;
      const auto          follower =
        make_event_follower(system, VectorXd::Zero(n), path);
      follower->follow({VectorXd::Zero(2 * n), press, 0, 1}, {});
      follower->follow({press, rate, 0, 1e3}, [&](const PathPoint &point) {
        turns += point.turn;
        if (!point.changes.empty())
          events.push_back(point.parameter);
      });
      LemkeOptions options;
      options.weight = 0;
      make_lemke_follower(system, path, options)
        ->follow({press, rate, 0, 1e3}, [&](const PathPoint &point) {
          if (!point.changes.empty())
            pivots.push_back(point.parameter);
        });
      ASSERT_EQ(events.size(), pivots.size()) << seed;
      for (std::size_t k = 0; k < events.size(); ++k)
        EXPECT_NEAR(events[k], pivots[k], 1e-9 * (1 + std::abs(pivots[k])))
          << seed;
    }
  EXPECT_GT(turns, 10u);
}
