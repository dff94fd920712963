// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/load_path.h"
#include "conetact/solvers/solver_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "q1_block.h"
#include "random_problem.h"

using namespace conetact;
using namespace conetact::load_path;
using namespace conetact::solvers;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  /** Follows stages and keeps the points of all, events and ends. */
  struct Path
  {
    Path(std::shared_ptr<const ContactSystem> system,
         const VectorXd                      &gap,
         const PathOptions                   &options = {})
      : follower(make_event_follower(system, gap, options))
      , load(VectorXd::Zero(system->n_unknowns()))
    {}

    PathResult
    follow(const VectorXd &rate, const double begin, const double end)
    {
      points.clear();
      const PathStage  stage{load, rate, begin, end};
      const PathResult result =
        follower->follow(stage, [this](const PathPoint &p) {
          EXPECT_LE(p.residual, 1e-10) << "at " << p.parameter;
          points.push_back(p);
        });
      load += (result.parameter - begin) * rate;
      return result;
    }

    std::vector<double>
    events() const
    {
      std::vector<double> result;
      for (const PathPoint &p : points)
        if (!p.changes.empty())
          result.push_back(p.parameter);
      return result;
    }

    std::unique_ptr<PathFollower> follower;
    VectorXd                      load;
    std::vector<PathPoint>        points;
  };

  /** The pair of dofs of tests/reference: x = R z + Rc + p Rv, f = .5. */
  std::shared_ptr<ContactSystem>
  pair()
  {
    auto system    = std::make_shared<ContactSystem>();
    system->first  = {0, 2};
    system->matrix = (MatrixXd(2, 2) << 1, .3, .3, 2).finished();
    system->mu     = VectorXd::Constant(1, .5);
    return system;
  }
  const Eigen::Vector2d pair_constant(0, -1), pair_variable(1, .4);

  PathOptions
  law(const PathLaw which)
  {
    PathOptions options;
    options.law = which;
    return options;
  }
} // namespace

TEST(EventFollower, PairLoadsAndUnloads)
{
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    {
      Path path(pair(), VectorXd::Zero(1), law(which));
      EXPECT_EQ(path.follow(pair_constant, 0, 1).outcome,
                PathOutcome::no_further_change);
      EXPECT_EQ(path.points.back().state[0], PathState::stick);

      EXPECT_EQ(path.follow(pair_variable, 0, 1).outcome,
                PathOutcome::target_reached);
      ASSERT_EQ(path.events().size(), 1u);
      EXPECT_NEAR(path.events()[0], 5. / 12, 1e-14);
      EXPECT_NEAR(path.points.back().v(0), 0.6086956521739131, 1e-14);
      EXPECT_NEAR(path.points.back().r(1), 0.782608695652174, 1e-14);
      EXPECT_EQ(path.points.back().state[0], PathState::slip_plus);

      // back from 1 to 0
      path.follow(-pair_variable, 0, 1);
      if (which == PathLaw::incremental)
        {
          ASSERT_EQ(path.events().size(), 2u);
          EXPECT_EQ(path.events()[0], 0);
          EXPECT_EQ(path.points[0].state[0], PathState::stick);
          EXPECT_NEAR(1 - path.events()[1], 0.021739130434782657, 1e-14);
          EXPECT_NEAR(path.points.back().v(0), 0.5882352941176471, 1e-14);
          EXPECT_NEAR(path.points.back().r(1), 1.1764705882352942, 1e-14);
          EXPECT_NEAR(path.points.back().r(0), 0.5882352941176471, 1e-14);
        }
      else
        {
          ASSERT_EQ(path.events().size(), 1u);
          EXPECT_NEAR(path.events()[0], 7. / 12, 1e-14);
          EXPECT_EQ(path.points.back().v(0), 0);
        }
    }
}

TEST(EventFollower, PairOpens)
{
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    {
      Path path(pair(), VectorXd::Zero(1), law(which));
      path.follow(pair_constant, 0, 1);
      EXPECT_EQ(path.follow(pair_variable, 0, 20).outcome,
                PathOutcome::no_further_change);
      ASSERT_EQ(path.events().size(), 2u);
      EXPECT_NEAR(path.events()[1], 10, 1e-12);
      EXPECT_NEAR(path.points.back().v(1), 0.5235602094240843, 1e-12);
      EXPECT_NEAR(path.points.back().v(0), 19.842931937172775, 1e-12);
      EXPECT_EQ(path.points.back().state[0], PathState::open);
    }
}

TEST(EventFollower, BlockSlidesOrTips)
{
  for (const double f : {.3, .8, 1.25, 2.})
    for (const double height : {.31, .77, .95})
      for (const Index nx : {4, 13})
        for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
          {
            const Q1Block block(2, 1, nx, 1 + nx / 2);
            Path path(block.system(f), VectorXd::Zero(nx + 1), law(which));
            const PathResult first =
              path.follow(block.condensed(block.weight(2000)), 0, 1);
            EXPECT_EQ(first.outcome, PathOutcome::no_further_change);
            const PathResult result =
              path.follow(block.condensed(block.push(2000, height)), 0, 10);
            EXPECT_EQ(result.outcome, PathOutcome::limit_load)
              << f << " " << height << " " << nx << " " << result.reason;
            const double limit = std::min(f, 1 / height);
            EXPECT_NEAR(result.parameter, limit, 1e-11 * limit)
              << f << " " << height << " " << nx;
          }
}

TEST(EventFollower, RefusesWhatItCannotDo)
{
  auto three_d   = std::make_shared<ContactSystem>();
  three_d->first = {0, 3};
  three_d->mu    = VectorXd::Ones(1);
  three_d->matrix.setIdentity(3, 3);
  EXPECT_THROW(make_event_follower(three_d, VectorXd::Zero(1), {}),
               std::invalid_argument);
  auto compliance  = pair();
  compliance->form = Form::compliance;
  EXPECT_THROW(make_event_follower(compliance, VectorXd::Zero(1), {}),
               std::invalid_argument);
  // the first stage must start without loads
  Path path(pair(), VectorXd::Zero(1));
  path.load = pair_constant;
  EXPECT_THROW(path.follow(pair_variable, 0, 1), std::invalid_argument);
}

namespace
{
  /** [P] Example 2: a bar on n - 1 supports, clamped at its start. */
  std::shared_ptr<const ContactSystem>
  bar_chain(const Index n, const double spring, const double mu)
  {
    auto system    = std::make_shared<ContactSystem>();
    system->matrix = MatrixXd::Zero(2 * (n - 1), 2 * (n - 1));
    system->mu     = VectorXd::Constant(n - 1, mu);
    for (Index i = 0; i < n - 1; ++i)
      {
        system->first.push_back(2 * (i + 1));
        system->matrix(2 * i, 2 * i) = i + 1 < n - 1 ? 2 * spring : spring;
        system->matrix(2 * i + 1, 2 * i + 1) = spring;
        if (i > 0)
          system->matrix(2 * i, 2 * i - 2) = system->matrix(2 * i - 2, 2 * i) =
            -spring;
      }
    return system;
  }
} // namespace

TEST(EventFollower, BarOnRoughSupports)
{
  const double L = 260, q = 3975, f = .3, force = 243750, EA = 1.95e9 * .0936;
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    for (const Index n : {5, 10, 40, 160})
      {
        const double h    = L / static_cast<double>(n - 1);
        VectorXd     down = VectorXd::Zero(2 * (n - 1)), pull = down;
        for (Index i = 0; i < n - 1; ++i)
          down(2 * i + 1) = -q * h * (i + 1 < n - 1 ? 1 : .5);
        pull(2 * (n - 2)) = force;
        Path path(bar_chain(n, EA / h, f), VectorXd::Zero(n - 1), law(which));
        path.follow(down, 0, 1);
        EXPECT_EQ(path.follow(pull, 0, 3).outcome,
                  PathOutcome::no_further_change);
        const std::vector<double> events = path.events();
        ASSERT_EQ(events.size(), static_cast<std::size_t>(n - 1));
        for (std::size_t j = 0; j < events.size(); ++j)
          {
            const double p = f * q * h * (static_cast<double>(j) + .5) / force;
            EXPECT_NEAR(events[j], p, 1e-12 * p);
            ASSERT_EQ(path.points[j].changes.size(), 1u);
            EXPECT_EQ(path.points[j].changes[0].node,
                      n - 2 - static_cast<Index>(j));
          }
      }
}

TEST(EventFollower, WhatComesAtOnceIsOneEvent)
{
  // forty pairs, not quite independent
  const Index n      = 40;
  auto        system = std::make_shared<ContactSystem>();
  VectorXd    constant(2 * n), variable(2 * n);
  system->matrix.setConstant(2 * n, 2 * n, 1e-3);
  for (Index i = 0; i < n; ++i)
    {
      system->first.push_back(2 * (i + 1));
      system->matrix.block<2, 2>(2 * i, 2 * i) += pair()->matrix;
      constant.segment<2>(2 * i) = pair_constant;
      variable.segment<2>(2 * i) = pair_variable;
    }
  system->mu = VectorXd::Constant(n, .5);
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    {
      Path path(system, VectorXd::Zero(n), law(which));
      path.follow(constant, 0, 1);
      path.follow(variable, 0, 1);
      ASSERT_EQ(path.events().size(), 1u);
      EXPECT_NEAR(path.events()[0], 5. / 12, 1e-12);
      EXPECT_EQ(path.points[0].changes.size(), 40u);
      path.follow(-variable, 0, 1);
      for (const PathPoint &p : path.points)
        EXPECT_EQ(p.changes.size(), p.parameter < 1 ? 40u : 0u);
    }
}

TEST(EventFollower, SymmetricStatesStaySymmetric)
{
  const Index   nx = 16;
  const Q1Block block(2, 1, nx, 6);
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    {
      Path path(block.system(.2), VectorXd::Zero(nx + 1), law(which));
      path.follow(block.condensed(block.weight(1)), 0, 1);
      VectorXd both                      = block.push(2, 1);
      both.tail(2 * (nx + 1)).tail(2)(0) = -2; // the other upper corner
      path.follow(block.condensed(both), 0, 1);
      EXPECT_GT(path.events().size(), 1u);
      for (const PathPoint &p : path.points)
        for (Index i = 0; i <= nx; ++i)
          {
            PathState mirrored = p.state[static_cast<std::size_t>(nx - i)];
            if (mirrored == PathState::slip_plus)
              mirrored = PathState::slip_minus;
            else if (mirrored == PathState::slip_minus)
              mirrored = PathState::slip_plus;
            EXPECT_EQ(p.state[static_cast<std::size_t>(i)], mirrored)
              << "node " << i << " at " << p.parameter;
          }
    }
}

TEST(EventFollower, CohesionAddsToTheLimit)
{
  const Index   nx = 9;
  const Q1Block block(2, 1, nx, 5);
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    for (const double f : {.1, .3, 3.})
      {
        PathOptions options = law(which);
        options.cohesion    = VectorXd::Constant(nx + 1, 20);
        Path path(block.system(f), VectorXd::Zero(nx + 1), options);
        path.follow(block.condensed(block.weight(2000)), 0, 1);
        const PathResult result =
          path.follow(block.condensed(block.push(2000, .8)), 0, 10);
        EXPECT_EQ(result.outcome, PathOutcome::limit_load);
        EXPECT_NEAR(result.parameter, std::min(f + .1, 1.25), 1e-10);
      }
}

TEST(EventFollower, MechanismsTellSlidingFromTipping)
{
  const Index   nx = 6;
  const Q1Block block(2, 1, nx, 3);
  for (const double f : {.4, 2.})
    {
      Path path(block.system(f), VectorXd::Zero(nx + 1));
      path.follow(block.condensed(block.weight(2000)), 0, 1);
      const PathResult result =
        path.follow(block.condensed(block.push(2000, 1)), 0, 10);
      for (Index i = 0; i <= nx; ++i)
        {
          const double slides = f < 1 ? 1 : 0;
          const double rises  = f < 1 ? 0 : 1 - block.x(i) / 2;
          EXPECT_NEAR(result.mechanism(2 * i), slides, 1e-8);
          EXPECT_NEAR(result.mechanism(2 * i + 1), rises, 1e-8);
        }
    }
}

TEST(EventFollower, WithoutFrictionNothingHoldsTheBlock)
{
  const Index   nx = 6;
  const Q1Block block(2, 1, nx, 3);
  Path          path(block.system(0), VectorXd::Zero(nx + 1));
  EXPECT_EQ(path.follow(block.condensed(block.weight(2000)), 0, 1).outcome,
            PathOutcome::no_further_change);
  EXPECT_EQ(path.points.back().state[0], PathState::slip);
  const PathResult result =
    path.follow(block.condensed(block.push(2000, .5)), 0, 1);
  EXPECT_EQ(result.outcome, PathOutcome::limit_load);
  EXPECT_EQ(result.parameter, 0);
}

TEST(EventFollower, FallsThroughItsGap)
{
  const Index   nx = 4;
  const Q1Block block(2, 1, nx, 3);
  VectorXd      gap(nx + 1);
  gap << .01, .02, .03, .02, .02;
  Path path(block.system(.5), gap);
  for (Index i = 0; i <= nx; ++i)
    path.load(2 * i + 1) = gap(i);
  path.load = block.system(.5)->matrix * path.load;
  path.follow(block.condensed(block.weight(2000)), 0, 1);
  EXPECT_TRUE(path.points.front().plateau);
  EXPECT_EQ(path.points.front().parameter, 0);
  const PathResult result =
    path.follow(block.condensed(block.push(2000, .5)), 0, 1);
  EXPECT_EQ(result.outcome, PathOutcome::limit_load);
  EXPECT_NEAR(result.parameter, .5, 1e-10);
}

namespace
{
  /** A node pressed on a floor it can lose by slipping: mu times coupling > 1.
   */
  std::shared_ptr<ContactSystem>
  losing_grip()
  {
    auto system    = std::make_shared<ContactSystem>();
    system->first  = {0, 2};
    system->matrix = (MatrixXd(2, 2) << 1, -.8, -.8, 1).finished();
    system->mu     = VectorXd::Constant(1, 2);
    return system;
  }
} // namespace

TEST(EventFollower, JumpsWhereTheIncrementalLawBreaksOff)
{
  Path path(losing_grip(), VectorXd::Zero(1));
  path.follow(Eigen::Vector2d(0, -1), 0, 1);
  EXPECT_EQ(path.follow(Eigen::Vector2d(1, 0), 0, 3).outcome,
            PathOutcome::no_further_change);
  ASSERT_EQ(path.points.size(), 3u); // where it breaks off, jump, end
  EXPECT_EQ(path.points[0].state[0], PathState::stick);
  const PathPoint &jump = path.points[1];
  EXPECT_TRUE(jump.jump);
  EXPECT_NEAR(jump.parameter, 2, 1e-14);
  EXPECT_EQ(jump.state[0], PathState::open);
  EXPECT_NEAR(jump.v(0), 1.2 / .36, 1e-12);
  EXPECT_NEAR(jump.v(1), .6 / .36, 1e-12);
}

TEST(EventFollower, HolonomicPathSnapsBack)
{
  // r_t = -2 r_n, r_n = 1 - .8 u: p = 2 - .6 u falls from 2 while it slips, to
  // u = 1/.8, where r_n = 0; from there it is a spring, u = (p - .8)/.36
  Path path(losing_grip(), VectorXd::Zero(1), law(PathLaw::holonomic));
  path.follow(Eigen::Vector2d(0, -1), 0, 1);
  EXPECT_EQ(path.follow(Eigen::Vector2d(1, 0), 0, 3).outcome,
            PathOutcome::no_further_change);
  ASSERT_EQ(path.points.size(), 3u);
  const PathPoint &falls = path.points[0], &rises = path.points[1];
  EXPECT_TRUE(falls.turn && rises.turn);
  EXPECT_EQ(falls.way, -1);
  EXPECT_NEAR(falls.parameter, 2, 1e-14);
  EXPECT_EQ(falls.state[0], PathState::slip_plus);
  EXPECT_EQ(rises.way, 1);
  EXPECT_NEAR(rises.parameter, 1.25, 1e-14);
  EXPECT_NEAR(rises.v(0), 1.25, 1e-14);
  EXPECT_EQ(rises.state[0], PathState::open);
  EXPECT_FALSE(path.points[2].turn);
  EXPECT_NEAR(path.points[2].v(0), 2.2 / .36, 1e-12);
  EXPECT_NEAR(path.points[2].v(1), 1.4 / .36, 1e-12);
}

TEST(EventFollower, LoadFallsAndGrowsTwice)
{
  // two such nodes, pressed by 1 and 1.5: turns at 2, 1.25 and 3, 1.875; and
  // two that are alike, which turn together
  auto system                              = std::make_shared<ContactSystem>();
  system->first                            = {0, 2, 4};
  system->matrix                           = MatrixXd::Zero(4, 4);
  const Eigen::Matrix2d one                = losing_grip()->matrix;
  system->matrix.topLeftCorner<2, 2>()     = one;
  system->matrix.bottomRightCorner<2, 2>() = one;
  system->mu                               = VectorXd::Constant(2, 2);
  for (const double second : {1., 1.5})
    {
      Path path(system, VectorXd::Zero(2), law(PathLaw::holonomic));
      path.follow(Eigen::Vector4d(0, -1, 0, -second), 0, 1);
      EXPECT_EQ(path.follow(Eigen::Vector4d(1, 0, 1, 0), 0, 4).outcome,
                PathOutcome::no_further_change);
      std::vector<double> turns;
      for (const PathPoint &p : path.points)
        if (p.turn)
          {
            EXPECT_EQ(p.way, turns.size() % 2 == 0 ? -1 : 1);
            EXPECT_EQ(p.changes.size(), second == 1 ? 2u : 1u);
            turns.push_back(p.parameter);
          }
      const std::vector<double> expected =
        second == 1 ? std::vector<double>{2, 1.25} :
                      std::vector<double>{2, 1.25, 3, 1.875};
      ASSERT_EQ(turns.size(), expected.size());
      for (std::size_t i = 0; i < turns.size(); ++i)
        EXPECT_NEAR(turns[i], expected[i], 1e-13);
      EXPECT_EQ(path.points.size(), turns.size() + 1);
    }
}

TEST(EventFollower, FallsBackToTheStartOfItsStage)
{
  // begun at 1.5, it turns at 2 and is back where 1.5 = 2 - .6 u
  const Eigen::Vector2d push(1, 0);
  Path path(losing_grip(), VectorXd::Zero(1), law(PathLaw::holonomic));
  path.follow(Eigen::Vector2d(0, -1), 0, 1);
  path.follow(push, 0, 1.5);
  const PathResult result = path.follow(push, 1.5, 3);
  EXPECT_EQ(result.outcome, PathOutcome::returned_to_start);
  EXPECT_EQ(result.parameter, 1.5);
  ASSERT_EQ(path.points.size(), 2u);
  EXPECT_NEAR(path.points[0].parameter, 2, 1e-14);
  EXPECT_NEAR(path.points[1].v(0), .5 / .6, 1e-14);
  // a stage that begins where the path turns
  Path corner(losing_grip(), VectorXd::Zero(1), law(PathLaw::holonomic));
  corner.follow(Eigen::Vector2d(0, -1), 0, 1);
  corner.follow(push, 0, 2);
  EXPECT_EQ(corner.follow(push, 2, 3).outcome, PathOutcome::turning_point);
}

TEST(EventFollower, FrictionThatFallsAsFastAsTheSpringPulls)
{
  // mu = K_tt / |K_tn|: slip at constant load, from 0 to 1/.8, then it opens
  const auto system = losing_grip();
  system->mu(0)     = 1.25;
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    {
      Path path(system, VectorXd::Zero(1), law(which));
      path.follow(Eigen::Vector2d(0, -1), 0, 1);
      EXPECT_EQ(path.follow(Eigen::Vector2d(1, 0), 0, 3).outcome,
                PathOutcome::no_further_change);
      ASSERT_EQ(path.points.size(), 3u);
      EXPECT_EQ(path.points[0].state[0], PathState::slip_plus);
      const PathPoint &open = path.points[1];
      EXPECT_TRUE(open.plateau);
      EXPECT_NEAR(open.parameter, 1.25, 1e-14);
      EXPECT_NEAR(open.v(0), 1.25, 1e-12);
      EXPECT_EQ(open.state[0], PathState::open);
      EXPECT_NEAR(path.points[2].v(0), 2.2 / .36, 1e-12);
    }
}

TEST(EventFollower, SlidesAtConstantLoadToItsStop)
{
  // a weight on a floor (t, n) and, half a unit ahead on a spring, a stop
  auto system          = std::make_shared<ContactSystem>();
  system->first        = {0, 2, 3};
  system->matrix       = MatrixXd::Zero(3, 3);
  system->matrix(0, 0) = system->matrix(0, 2) = 4;
  system->matrix(2, 0) = system->matrix(2, 2) = 4;
  system->mu                                  = Eigen::Vector2d(.5, 0);
  system->null_space                          = MatrixXd::Zero(3, 2);
  system->null_space.col(0) << 1, 0, -1;
  system->null_space(1, 1) = 1;
  for (const PathLaw which : {PathLaw::incremental, PathLaw::holonomic})
    {
      Path path(system, Eigen::Vector2d(0, .5), law(which));
      path.load = system->matrix.col(2) * .5;
      path.follow(Eigen::Vector3d(0, -1, 0), 0, 1);
      EXPECT_EQ(path.follow(Eigen::Vector3d(1, 0, 0), 0, 2).outcome,
                PathOutcome::no_further_change);
      ASSERT_EQ(path.points.size(), 3u);
      EXPECT_NEAR(path.points[0].parameter, .5, 1e-14);
      EXPECT_EQ(path.points[0].state[0], PathState::slip_plus);
      const PathPoint &stop = path.points[1];
      EXPECT_TRUE(stop.plateau);
      EXPECT_NEAR(stop.parameter, .5, 1e-14);
      EXPECT_NEAR(stop.v(0), .5, 1e-12);
      EXPECT_EQ(stop.state[1], PathState::stick);
      EXPECT_NEAR(path.points[2].v(0), .5 + 1.5 / 4, 1e-12);
      EXPECT_NEAR(path.points[2].r(2), 1.5, 1e-12);
    }
}

namespace
{
  struct RandomPath
  {
    std::shared_ptr<ContactSystem> system = std::make_shared<ContactSystem>();
    VectorXd                       gap, start, rate;

    explicit RandomPath(const unsigned int seed, const double friction = 1)
    {
      conetact::internal::Random random(seed);
      const auto                 n = static_cast<Index>(3 + seed % 8);
      MatrixXd                   none;
      const auto                 draw = [&](const double a, const double b) {
        return conetact::internal::uniform(random, a, b);
      };
      system->matrix =
        conetact::internal::random_operator(random, 2 * n, 0, .5, none);
      system->mu.resize(n);
      gap   = VectorXd::Zero(n);
      rate  = conetact::internal::random_matrix(random, 2 * n, 1);
      start = VectorXd::Zero(2 * n);
      for (Index i = 0; i < n; ++i)
        {
          system->first.push_back(2 * (i + 1));
          system->mu(i) = friction * draw(0, 1);
          if (draw(0, 1) < .5)
            gap(i) = draw(0, .3);
          start(2 * i + 1) = gap(i);
          rate(2 * i + 1) -= 1;
        }
      start = system->matrix * start;
    }
  };

  /** Reactions after so many equal increments of the SOCLCP. */
  VectorXd
  by_increments(const RandomPath &path, const VectorXd &turn, const int steps)
  {
    const auto   solver  = make_solver(SolverOptions());
    const Index  n       = path.start.size();
    VectorXd     slipped = VectorXd::Zero(n), gap = path.gap;
    ContactState state;
    state.r = slipped;
    for (int k = 1; k <= 2 * steps; ++k)
      {
        const double   s = static_cast<double>(k) / steps;
        ContactProblem problem;
        problem.system = path.system;
        problem.gap    = gap;
        problem.load   = path.start + std::min(s, 1.) * path.rate +
                       std::max(s - 1, 0.) * turn -
                       path.system->matrix * slipped;
        state.v = VectorXd::Zero(n);
        for (Index i = 0; i < gap.size(); ++i)
          state.v(2 * i + 1) = gap(i);
        EXPECT_TRUE(solver->solve(problem, state).converged);
        for (Index i = 0; i < gap.size(); ++i)
          {
            slipped(2 * i) += state.v(2 * i);
            gap(i) = std::max(0., state.v(2 * i + 1));
          }
      }
    return state.r;
  }
} // namespace

TEST(EventFollower, IncrementsConvergeToThePath)
{
  double coarse = 0, fine = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
    {
      const RandomPath random(seed);
      VectorXd         turn = VectorXd::Zero(random.rate.size());
      for (Index i = 0; i < turn.size(); i += 2)
        turn(i) = -random.rate(i);
      Path path(random.system, random.gap);
      path.load = random.start;
      path.follow(random.rate, 0, 1);
      path.follow(turn, 0, 1);
      const VectorXd &r = path.points.back().r;
      coarse += (by_increments(random, turn, 8) - r).norm() / r.norm();
      fine += (by_increments(random, turn, 64) - r).norm() / r.norm();
    }
  EXPECT_LT(fine, coarse / 5);
  EXPECT_LT(fine / 40, 2e-3);
}

namespace
{
  /** Largest violation of balance and of the holonomic law, by definition. */
  double
  violation(const ContactSystem &system,
            const VectorXd      &load,
            const VectorXd      &v,
            const VectorXd      &r)
  {
    double result = (system.matrix * v - r - load).lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const double u = v(2 * i), g = v(2 * i + 1), r_t = r(2 * i),
                     r_n = r(2 * i + 1), bound = system.mu(i) * r_n;
        result =
          std::max({result,
                    -g,
                    -r_n,
                    std::min(g, r_n),
                    std::abs(r_t) - bound,
                    std::min(std::abs(u), bound + (u > 0 ? r_t : -r_t))});
      }
    return result;
  }
} // namespace

TEST(EventFollower, RandomPathsAreChainsOfEquilibria)
{
  unsigned int turns = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
    {
      const RandomPath random(seed, 12);
      Path             path(random.system, random.gap, law(PathLaw::holonomic));
      path.load               = random.start;
      const PathResult result = path.follow(random.rate, 0, 1);
      EXPECT_TRUE(result.outcome == PathOutcome::target_reached ||
                  result.outcome == PathOutcome::no_further_change)
        << seed << ": " << result.reason;
      const auto at = [&](const double    p,
                          const VectorXd &v,
                          const VectorXd &r) {
        return violation(*random.system, random.start + p * random.rate, v, r) /
               (1 + r.lpNorm<Eigen::Infinity>());
      };
      for (std::size_t k = 0; k < path.points.size(); ++k)
        {
          const PathPoint &b = path.points[k];
          EXPECT_LE(at(b.parameter, b.v, b.r), 1e-10) << seed;
          turns += b.turn;
          if (k == 0)
            continue;
          // All between two points is in balance, too: they are connected.
          const PathPoint &a = path.points[k - 1];
          EXPECT_GE(a.way * (b.parameter - a.parameter), 0) << seed;
          EXPECT_EQ(b.turn, a.way != b.way) << seed;
          EXPECT_LE(at(.5 * (a.parameter + b.parameter),
                       .5 * (a.v + b.v),
                       .5 * (a.r + b.r)),
                    1e-10)
            << seed;
        }
    }
  EXPECT_GT(turns, 20u);
}

TEST(EventFollower, JumpsOfRoughBlocksLand)
{
  unsigned int jumps = 0;
  for (unsigned int seed = 0; seed < 60; ++seed)
    {
      internal::Random random(seed);
      const auto       draw = [&](const double a, const double b) {
        return internal::uniform(random, a, b);
      };
      const double  height = draw(.3, 2);
      const auto    nx = static_cast<Index>(2 + seed % 6), ny = 1 + nx / 2;
      const Q1Block block(draw(.5, 3), height, nx, ny);
      Path          path(block.system(draw(4, 20)), VectorXd::Zero(nx + 1));
      path.follow(block.condensed(block.weight(2000)), 0, 1);
      const double     side = height * draw(0, 1);
      const PathResult result =
        path.follow(block.condensed(block.push(2000, side) -
                                    block.weight(2000 * draw(0, 1))),
                    0,
                    20);
      EXPECT_EQ(result.outcome, PathOutcome::limit_load)
        << seed << ": " << result.reason;
      for (const PathPoint &p : path.points)
        jumps += p.jump;
    }
  EXPECT_GT(jumps, 5u);
}
