// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/load_path.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace conetact;
using namespace conetact::load_path;
using namespace conetact::solvers;
using Eigen::VectorXd;

namespace
{
  VectorXd
  vector(const std::vector<double> &x)
  {
    return VectorXd::Map(x.data(), static_cast<Eigen::Index>(x.size()));
  }

  /** A path from nothing: what it visits, stage by stage. */
  struct Path
  {
    std::shared_ptr<ContactSystem> system = std::make_shared<ContactSystem>();
    std::vector<PathPoint>         points;
    std::unique_ptr<PathFollower>  follower;

    Path(const Eigen::MatrixXd &K, const int n_tangents, const double mu)
    {
      system->matrix = K;
      for (Eigen::Index i = n_tangents + 1; i <= K.rows(); i += n_tangents + 1)
        system->first.push_back(i);
      system->mu = VectorXd::Constant(system->n_nodes(), mu);
    }
    PathResult
    follow(const std::vector<double> &load,
           const std::vector<double> &rate,
           double                     begin,
           double                     end)
    {
      if (!follower)
        follower = make_bracketing_follower(system,
                                            VectorXd::Zero(system->n_nodes()),
                                            {});
      return follower->follow({vector(load), vector(rate), begin, end},
                              [&](const PathPoint &p) {
                                EXPECT_LE(p.residual, 1e-10);
                                points.push_back(p);
                              });
    }
    std::vector<const PathPoint *>
    events() const
    {
      std::vector<const PathPoint *> result;
      for (const PathPoint &p : points)
        if (!p.changes.empty())
          result.push_back(&p);
      return result;
    }
  };

  // The `pair` of tests/reference, (t, n) with the signs of K v = r + f.
  Eigen::Matrix2d
  pair_stiffness()
  {
    Eigen::Matrix2d K;
    K << 1, .3, .3, 2;
    return K;
  }
  const std::vector<double> pair_constant = {0, -1}, pair_rate = {1, .4};
} // namespace



TEST(BracketingFollower, PairSlipsAndOpens)
{
  Path path(pair_stiffness(), 1, .5);
  path.follow({0, 0}, pair_constant, 0, 1);
  path.points.clear();
  const PathResult result = path.follow(pair_constant, pair_rate, 0, 20);
  EXPECT_EQ(result.outcome, PathOutcome::target_reached);
  const auto events = path.events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_NEAR(events[0]->parameter, .5 / 1.2, 2e-7);
  EXPECT_EQ(events[0]->changes[0].from, PathState::stick);
  EXPECT_EQ(events[0]->changes[0].to, PathState::slip);
  EXPECT_NEAR(events[1]->parameter, 10, 2e-7);
  EXPECT_EQ(events[1]->changes[0].to, PathState::open);
  EXPECT_NEAR(path.points.back().v[0], 19.842931937172775, 1e-9);
  EXPECT_NEAR(path.points.back().v[1], .5235602094240843, 1e-9);
}



TEST(BracketingFollower, PairRemembersItsSlipWhenUnloaded)
{
  Path path(pair_stiffness(), 1, .5);
  path.follow({0, 0}, pair_constant, 0, 1);
  path.follow(pair_constant, pair_rate, 0, 1);
  EXPECT_NEAR(path.points.back().v[0], .6086956521739131, 1e-9);
  EXPECT_NEAR(path.points.back().r[1], .782608695652174, 1e-9);
  path.points.clear();
  path.follow({1, -.6}, {-1, -.4}, 1, 2);
  const auto events = path.events();
  ASSERT_EQ(events.size(), 2u); // it sticks at once, then slips back
  EXPECT_EQ(events[0]->parameter, 1);
  EXPECT_EQ(events[0]->changes[0].to, PathState::stick);
  EXPECT_NEAR(events[1]->parameter, 2 - .021739130434782657, 2e-8);
  EXPECT_NEAR(path.points.back().v[0], .5882352941176471, 1e-9);
  EXPECT_NEAR(path.points.back().r[1], 1.1764705882352942, 1e-9);
}



TEST(BracketingFollower, SlipTurnsWithTheLoad)
{
  // a node on equal springs, drawn along t1, then along t2: reactions follow
  // the tractrix, |r_t| = mu N and d(angle)/ds = sin(angle) k/(mu N)
  Path path(Eigen::Matrix3d::Identity(), 2, .5);
  path.follow({0, 0, 0}, {0, 0, -2}, 0, 1);
  path.follow({0, 0, -2}, {3, 0, 0}, 0, 1);
  EXPECT_NEAR(path.points.back().v[0], 2, 1e-10);
  path.points.clear();
  EXPECT_EQ(path.follow({3, 0, -2}, {0, 2, 0}, 0, 1).outcome,
            PathOutcome::target_reached);
  EXPECT_TRUE(path.events().empty());
  const VectorXd &r = path.points.back().r;
  EXPECT_NEAR(r.head(2).norm(), 1, 1e-10);
  const double exact = 2 * std::atan(std::exp(-2.)); // from the load's way
  EXPECT_NEAR(std::atan2(-r[0], -r[1]), exact, .02);
}



TEST(BracketingFollower, RigidBodySlidesAtItsLimit)
{
  Path path(Eigen::Matrix3d::Zero(), 2, .5);
  path.system->null_space = Eigen::Matrix3d::Identity();
  path.follow({0, 0, 0}, {0, 0, -2}, 0, 1);
  const PathResult result = path.follow({0, 0, -2}, {3, 4, 0}, 0, 1);
  EXPECT_EQ(result.outcome, PathOutcome::limit_load);
  EXPECT_NEAR(result.parameter, .2, 1e-9);
  EXPECT_NEAR(result.mechanism[0], .75, 1e-6);
  EXPECT_NEAR(result.mechanism[1], 1, 1e-6);
  EXPECT_NEAR(result.mechanism[2], 0, 1e-6);
}



TEST(BracketingFollower, GapClosesThenSticks)
{
  Path path(Eigen::Matrix3d::Identity(), 2, .5);
  path.follower =
    make_bracketing_follower(path.system, VectorXd::Constant(1, 1.), {});
  // f = K (0, g) - p (0, 0, 4): closed at p = 1/4
  const PathResult result = path.follow({0, 0, 1}, {0, 0, -4}, 0, 1);
  EXPECT_EQ(result.outcome, PathOutcome::target_reached);
  const auto events = path.events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0]->parameter, .25, 2e-8);
  EXPECT_EQ(events[0]->changes[0].from, PathState::open);
  EXPECT_EQ(events[0]->changes[0].to, PathState::stick);
  EXPECT_NEAR(path.points.back().r[2], 3, 1e-10);
}



TEST(BracketingFollower, TellsOfAJump)
{
  // slip takes the pressure off faster than the spring pulls: nothing next to
  // stick holds more than p = 2, where the open node is at u = 1.2/.36
  Eigen::Matrix2d K;
  K << 1, -.8, -.8, 1;
  Path path(K, 1, 2);
  path.follow({0, 0}, {0, -1}, 0, 1);
  path.points.clear();
  EXPECT_EQ(path.follow({0, -1}, {1, 0}, 0, 3).outcome,
            PathOutcome::target_reached);
  const auto events = path.events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_TRUE(events[0]->jump);
  EXPECT_NEAR(events[0]->parameter, 2, 1e-7);
  EXPECT_NEAR(events[0]->v[0], 1.2 / .36, 1e-6);
  EXPECT_EQ(events[0]->state[0], PathState::open);
  EXPECT_FALSE(path.points.back().jump);
}
