// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Rigid bodies on floors, walls and grooves, whose limits are known in closed
// form.

#include "conetact/solvers/existence.h"
#include "conetact/solvers/null_space.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace conetact;
using namespace conetact::solvers;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace
{
  /** A rigid body with contact nodes at points of space. */
  struct Body
  {
    std::shared_ptr<ContactSystem> system = std::make_shared<ContactSystem>();
    std::vector<ExistenceCheck::Frame> frames;
    std::vector<Vector3d>              points;
    MatrixXd                           rigid; ///< n x 6, motions about 0

    void
    add(const Vector3d &x, const ExistenceCheck::Frame &frame, const double mu)
    {
      const Eigen::Index n = system->n_unknowns(), m = frame.cols();
      system->first.push_back(n + m);
      system->mu.conservativeResize(system->n_nodes());
      system->mu[system->n_nodes() - 1] = mu;
      points.push_back(x);
      frames.push_back(frame);
      rigid.conservativeResize(n + m, 6);
      for (Eigen::Index j = 0; j < m; ++j)
        {
          rigid.row(n + j) << frame.col(j).transpose(),
            x.cross(Vector3d(frame.col(j))).transpose();
        }
    }
    /** K is the projection on what is not rigid. */
    void
    close()
    {
      const MatrixXd R   = orthonormal_basis(rigid);
      system->null_space = rigid;
      system->matrix =
        MatrixXd::Identity(rigid.rows(), rigid.rows()) - R * R.transpose();
    }
    /** Nodal loads with the resultant of a force at a point. */
    VectorXd
    force(const Vector3d &f, const Vector3d &at) const
    {
      VectorXd resultant(6);
      resultant << f, at.cross(f);
      return rigid.transpose().completeOrthogonalDecomposition().solve(
        resultant);
    }
  };

  /** Bottom of a block [-w/2, w/2] (x [-w/2, w/2]); n nodes an edge. */
  Body
  block(const int dim, const double w, const int n, const double mu)
  {
    Body                  body;
    ExistenceCheck::Frame frame(3, dim);
    if (dim == 2)
      frame << Vector3d::UnitX(), Vector3d::UnitY();
    else
      frame << Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < (dim == 2 ? 1 : n); ++j)
        body.add({w * (i / (n - 1.) - .5),
                  dim == 2 ? 0. : w * (j / (n - 1.) - .5),
                  0.},
                 frame,
                 mu);
    body.close();
    return body;
  }

  Vector3d
  up(const int dim)
  {
    return dim == 2 ? Vector3d::UnitY() : Vector3d::UnitZ();
  }

  /** Weight p in the middle, push q along `direction` at height h. */
  VectorXd
  push(const Body     &body,
       const int       dim,
       const double    p,
       const double    q,
       const double    h,
       const Vector3d &direction = Vector3d::UnitX())
  {
    return body.force(-p * up(dim), Vector3d::Zero()) +
           body.force(q * direction, h * up(dim));
  }

  void
  expect_proof(const Body &body, const Existence &e, const VectorXd &load)
  {
    ASSERT_FALSE(e.admissible);
    const ContactSystem &s = *body.system;
    EXPECT_LT((s.matrix * e.v).norm(), 1e-13);
    EXPECT_NEAR(e.v.lpNorm<Eigen::Infinity>(), 1, 1e-14);
    EXPECT_GT(load.dot(e.v), 0);
    for (Eigen::Index i = 0; i < s.n_nodes(); ++i)
      EXPECT_GE(e.v[s.normal(i)],
                s.mu[i] * e.v.segment(s.first[i], s.n_tangents(i)).norm() -
                  1e-12);
  }
} // namespace



TEST(Existence, BlockSlides)
{
  const Vector3d skew = Vector3d(std::cos(.7), std::sin(.7), 0);
  for (const int dim : {2, 3})
    for (const Vector3d &d : {Vector3d(1, 0, 0),
                              Vector3d(-1, 0, 0),
                              dim == 2 ? Vector3d(1, 0, 0) : skew})
      {
        const Body           body = block(dim, 2, 7, .5);
        const ExistenceCheck check(body.system, body.frames);
        EXPECT_EQ(check.basis().cols(), dim == 2 ? 3 : 6);
        const VectorXd weight = push(body, dim, 1, 0, 0);
        for (int i = 0; i <= 20; ++i)
          EXPECT_TRUE(
            check.check(push(body, dim, 1, i * .4999 / 20, .5, d), weight)
              .admissible);
        for (const double q : {.5001, .55, 1., 5.})
          {
            const VectorXd  load = push(body, dim, 1, q, .5, d);
            const Existence e    = check.check(load, weight);
            expect_proof(body, e, load);
            EXPECT_EQ(e.motion, Motion::slides) << dim << " " << q;
            EXPECT_NEAR(e.fraction, .5 / q, 1e-9);
            EXPECT_EQ(e.tight.size(), body.points.size());
            const Existence alone = check.check(load, 0 * weight);
            expect_proof(body, alone, load);
            EXPECT_EQ(alone.fraction, 0);
            EXPECT_EQ(alone.motion, Motion::slides) << dim << " " << q;
            if (q <= 1)
              {
                ASSERT_TRUE(alone.friction_factor);
                EXPECT_NEAR(*alone.friction_factor, q / .5, 1e-9);
                EXPECT_NEAR(*alone.friction_needed, q, 1e-9);
              }
            else // it would tip over at q = 2
              EXPECT_FALSE(alone.friction_needed);
          }
      }
}



TEST(Existence, TallBlockTips)
{
  for (const int dim : {2, 3})
    {
      const Body           body = block(dim, 1, 6, .5);
      const ExistenceCheck check(body.system, body.frames);
      const VectorXd       weight = push(body, dim, 1, 0, 0);
      EXPECT_TRUE(check.check(push(body, dim, 1, .2499, 2), weight).admissible);
      const VectorXd  load = push(body, dim, 1, .2501, 2);
      const Existence e    = check.check(load, weight);
      expect_proof(body, e, load);
      EXPECT_EQ(e.motion, Motion::tips);
      EXPECT_NEAR(e.fraction, .25 / .2501, 1e-9);
      EXPECT_EQ(e.tight.size(), dim == 2 ? 1u : 6u);
      EXPECT_EQ(e.moving.size(), body.points.size());
      const Existence alone = check.check(load, 0 * weight);
      EXPECT_EQ(alone.motion, Motion::tips);
      EXPECT_FALSE(alone.friction_needed);
    }
}



TEST(Existence, LiftsOff)
{
  for (const int dim : {2, 3})
    {
      const Body           body = block(dim, 2, 5, .5);
      const ExistenceCheck check(body.system, body.frames);
      const VectorXd       load   = push(body, dim, -1, .2, 0);
      const VectorXd       weight = push(body, dim, 3, 0, 0);
      const Existence      e      = check.check(load, 0 * load);
      expect_proof(body, e, load);
      EXPECT_EQ(e.motion, Motion::lifts_off);
      EXPECT_FALSE(e.friction_needed);
      // the cone is left sideways before it is left upwards:
      // .2 s = .5 (3 - 4 s)
      EXPECT_NEAR(check.check(load, weight).fraction, 1.5 / 2.2, 1e-9);
      const VectorXd straight = push(body, dim, -1, 0, 0);
      EXPECT_NEAR(check.check(straight, weight).fraction, .75, 1e-9);
    }
}



TEST(Existence, BlockTurns)
{
  // four feet at distance a: torque limit mu p a
  const Body           body = block(3, 2, 2, .5);
  const ExistenceCheck check(body.system, body.frames);
  const VectorXd       weight = push(body, 3, 1, 0, 0);
  VectorXd             couple = body.force({1, 0, 0}, {0, -.5, 0});
  couple += body.force({-1, 0, 0}, {0, .5, 0});
  const double limit = .5 * std::sqrt(2.);
  EXPECT_TRUE(check.check(weight + .9999 * limit * couple, weight).admissible);
  const VectorXd  load = weight + 1.5 * limit * couple;
  const Existence e    = check.check(load, weight);
  expect_proof(body, e, load);
  EXPECT_EQ(e.motion, Motion::turns);
  EXPECT_NEAR(e.fraction, 1 / 1.5, 1e-9);
}



/* Corners alone would carry the most: mu p w / sqrt(2). The proof lifts the
   whole bottom, by mu times the slip of corners. */
TEST(Existence, TwistedBlockSpins)
{
  const double mu = .3, w = 2, p = 5;
  const Body   body    = block(3, w, 5, mu);
  const auto   twisted = [&](const double moment) -> VectorXd {
    return body.force(-p * up(3), Vector3d::Zero()) +
           body.force(moment / w * Vector3d::UnitY(), w / 2 * up(3)) -
           body.force(moment / w * Vector3d::UnitY(), Vector3d(-w, 0, w / 2));
  };
  const double         largest = mu * p * w / std::sqrt(2.);
  const ExistenceCheck check(body.system, body.frames);
  const VectorXd       start = body.force(-p * up(3), Vector3d::Zero());
  EXPECT_TRUE(check.check(twisted(.99 * largest), start).admissible);
  const VectorXd  load = twisted(1.25 * largest);
  const Existence e    = check.check(load, start);
  expect_proof(body, e, load);
  EXPECT_EQ(Motion::turns, e.motion);
  EXPECT_NEAR(.8, e.fraction, 1e-6);
}



TEST(Existence, StaticLimitOfASlope)
{
  // the resultant leans by sqrt(5)/2, Example 5.3 of Kanno et al. (2004)
  for (const double mu : {1.118, 1.119})
    {
      const Body           body = block(3, 40, 9, mu);
      const ExistenceCheck check(body.system);
      const VectorXd       load =
        push(body, 3, 2, std::sqrt(5.), 0, Vector3d(2, 1, 0).normalized());
      const Existence e = check.check(load, 0 * load);
      EXPECT_EQ(e.admissible, mu > 1.1185);
      if (!e.admissible)
        {
          ASSERT_TRUE(e.friction_needed);
          EXPECT_NEAR(*e.friction_needed, std::sqrt(5.) / 2, 1e-9);
        }
    }
}



TEST(Existence, VGroove)
{
  // walls inclined by 60 degrees to the horizontal, axis y
  const double sine = .5, cosine = std::sqrt(.75);
  for (const double mu : {.5, .8})
    {
      Body body;
      for (const double side : {-1., 1.})
        {
          const Vector3d        n(-side * cosine, 0, sine);
          const Vector3d        along = Vector3d::UnitY();
          ExistenceCheck::Frame frame(3, 3);
          frame << along, n.cross(along), n;
          for (const double y : {-1., 0., 1.})
            body.add({side, y, 0}, frame, mu);
        }
      body.close();
      const ExistenceCheck check(body.system, body.frames);
      const VectorXd       weight = push(body, 3, 1, 0, 0);
      const VectorXd       axial  = push(body, 3, 0, 1, 0, Vector3d::UnitY());
      if (mu == .8) // the walls can jam the body: any load passes
        {
          EXPECT_TRUE(check.check(weight + 20 * axial, weight).admissible);
          continue;
        }
      // per wall N sine - s cosine = W/2, axial = 2 sqrt(mu^2 N^2 - s^2)
      const double k     = mu * mu * cosine / (sine * sine);
      const double s     = k * .5 / (1 - k * cosine);
      const double N     = (.5 + s * cosine) / sine;
      const double limit = 2 * std::sqrt(mu * mu * N * N - s * s);
      EXPECT_TRUE(
        check.check(weight + .9999 * limit * axial, weight).admissible);
      const VectorXd  load = weight + 3 * limit * axial;
      const Existence e    = check.check(load, weight);
      expect_proof(body, e, load);
      EXPECT_NEAR(e.fraction, 1. / 3, 1e-9);
      EXPECT_EQ(e.motion, Motion::slides);
    }
}



TEST(Existence, WithoutFriction)
{
  for (const int dim : {2, 3})
    {
      const Body           body = block(dim, 2, 4, 0);
      const ExistenceCheck check(body.system);
      const VectorXd       weight = push(body, dim, 1, 0, 0);
      EXPECT_TRUE(check.check(weight, 0 * weight).admissible);
      const VectorXd  load = push(body, dim, 1, .3, .5);
      const Existence e    = check.check(load, 0 * load);
      expect_proof(body, e, load);
      EXPECT_EQ(e.motion, Motion::slides);
      EXPECT_FALSE(e.friction_factor);
      ASSERT_TRUE(e.friction_needed);
      EXPECT_NEAR(*e.friction_needed, .3, 1e-9);
      EXPECT_NEAR(check.check(load, weight).fraction, 0, 1e-9);
    }
}



TEST(Existence, UnitsDoNotMatter)
{
  const Body           body = block(3, 2, 5, .5);
  const ExistenceCheck check(body.system);
  for (const double unit : {1e-9, 1., 1e9})
    {
      const VectorXd weight = unit * push(body, 3, 1, 0, 0);
      const VectorXd push_2 = unit * push(body, 3, 1, 2, .5);
      EXPECT_TRUE(check.check(unit * push(body, 3, 1, .4999, .5), weight, unit)
                    .admissible);
      const Existence e = check.check(push_2, weight, unit);
      EXPECT_FALSE(e.admissible);
      EXPECT_NEAR(e.fraction, .25, 1e-9);
    }
}



TEST(Existence, VanishedLoadsAreJudgedByTheHistory)
{
  const Body           body = block(3, 2, 5, .5);
  const ExistenceCheck check(body.system);
  const VectorXd       pull = push(body, 3, -1, .3, .5);
  EXPECT_FALSE(check.check(pull, 0 * pull, 1).admissible);
  EXPECT_FALSE(check.check(1e-8 * pull, 0 * pull, 1).admissible);
  EXPECT_TRUE(check.check(1e-13 * pull, 0 * pull, 1).admissible);
  EXPECT_TRUE(check.check(0 * pull, 0 * pull, 1).admissible);
  EXPECT_TRUE(check.check(0 * pull, 0 * pull, 0).admissible);
}



TEST(Existence, OneOfTwoBodiesMoves)
{
  Body       body  = block(3, 2, 3, .5);
  const Body other = block(3, 2, 3, .5);
  const auto n     = body.system->n_unknowns();
  const auto m     = body.system->n_nodes();
  for (std::size_t i = 0; i < other.points.size(); ++i)
    body.add(other.points[i], other.frames[i], .5);
  const MatrixXd rigid         = other.rigid;
  MatrixXd       both          = MatrixXd::Zero(2 * n, 12);
  both.topLeftCorner(n, 6)     = rigid;
  both.bottomRightCorner(n, 6) = rigid;
  body.system->null_space      = both;
  const MatrixXd R             = orthonormal_basis(both);
  body.system->matrix = MatrixXd::Identity(2 * n, 2 * n) - R * R.transpose();

  const ExistenceCheck check(body.system, body.frames);
  VectorXd             load(2 * n), start(2 * n);
  load << push(other, 3, 1, .1, .5), push(other, 3, 1, .8, .5);
  start << push(other, 3, 1, 0, 0), push(other, 3, 1, 0, 0);
  const Existence e = check.check(load, start);
  expect_proof(body, e, load);
  EXPECT_EQ(e.motion, Motion::slides);
  EXPECT_NEAR(e.fraction, .5 / .8, 1e-9);
  ASSERT_EQ(e.moving.size(), static_cast<std::size_t>(m));
  EXPECT_EQ(e.moving.front(), m);
}



TEST(Existence, NothingToDoWithoutANullSpace)
{
  Body body               = block(3, 2, 3, .5);
  body.system->null_space = {};
  const VectorXd load     = push(body, 3, -1, 0, 0);
  EXPECT_TRUE(ExistenceCheck(body.system).check(load, 0 * load).admissible);
}



TEST(NullSpace, RigidMotionsAreFound)
{
  std::srand(1);
  for (const int n : {12, 60, 200})
    for (const int k : {1, 3, 7})
      {
        const MatrixXd R = orthonormal_basis(MatrixXd::Random(n, k));
        const MatrixXd A = MatrixXd::Random(n, n + 20);
        const MatrixXd P = MatrixXd::Identity(n, n) - R * R.transpose();
        // stiff and soft parts side by side
        MatrixXd K       = P * A * A.transpose() * P;
        K                = (.5 * (K + K.transpose())).eval();
        const MatrixXd N = null_space_basis(K);
        ASSERT_EQ(N.cols(), k);
        EXPECT_LT((N - R * (R.transpose() * N)).norm(), 1e-12);
        EXPECT_LT((N.transpose() * N - MatrixXd::Identity(k, k)).norm(), 1e-13);
      }
}



TEST(NullSpace, StiffAndSoftBodies)
{
  std::srand(2);
  MatrixXd K = MatrixXd::Zero(40, 40);
  MatrixXd R = MatrixXd::Zero(40, 6);
  for (const int body : {0, 1})
    {
      const MatrixXd Q = orthonormal_basis(MatrixXd::Random(20, 3));
      const MatrixXd A = MatrixXd::Random(20, 30);
      const MatrixXd P = MatrixXd::Identity(20, 20) - Q * Q.transpose();
      K.block(20 * body, 20 * body, 20, 20) =
        (body == 0 ? 1e9 : 1e-3) * (P * A * A.transpose() * P);
      R.block(20 * body, 3 * body, 20, 3) = Q;
    }
  const MatrixXd N = null_space_basis(K);
  ASSERT_EQ(N.cols(), 6);
  EXPECT_LT((N - R * (R.transpose() * N)).norm(), 1e-12);
}



TEST(NullSpace, NothingButRounding)
{
  std::srand(3);
  // three rigid motions of a body that three unknowns hold: K is rounding
  const MatrixXd A = MatrixXd::Random(3, 3);
  const MatrixXd K = 1e-9 * A * A.transpose();
  EXPECT_EQ(null_space_basis(K, MatrixXd::Random(3, 3)).cols(), 3);
  // a mechanism beside them
  MatrixXd L            = MatrixXd::Zero(5, 5);
  L.topLeftCorner(3, 3) = K;
  L(3, 3)               = 1;
  MatrixXd known        = MatrixXd::Zero(5, 3);
  known.topRows(3)      = MatrixXd::Random(3, 3);
  EXPECT_EQ(null_space_basis(L, known).cols(), 4);
}



TEST(NullSpace, DefiniteAndZero)
{
  EXPECT_EQ(null_space_basis(MatrixXd::Identity(5, 5)).cols(), 0);
  EXPECT_EQ(null_space_basis(MatrixXd::Zero(5, 5)).cols(), 5);
  MatrixXd K       = MatrixXd::Identity(5, 5);
  K(2, 2)          = 0;
  const MatrixXd N = null_space_basis(K);
  ASSERT_EQ(N.cols(), 1);
  EXPECT_NEAR(std::abs(N(2, 0)), 1, 1e-15);
}
