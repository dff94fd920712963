// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/node_sets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace conetact::solvers;

namespace
{
  /** A body on two nodes of the x axis at -1 and 1, in the plane or in space:
   * translations and the rotation that lifts one of them. */
  ContactSystem
  on_two_nodes(const Eigen::Index dim)
  {
    ContactSystem system;
    system.first      = {0, dim, 2 * dim};
    system.mu         = Eigen::VectorXd::Constant(2, .3);
    system.null_space = Eigen::MatrixXd::Zero(2 * dim, dim + 1);
    for (Eigen::Index i = 0; i < 2; ++i)
      {
        system.null_space.block(dim * i, 0, dim, dim).setIdentity();
        system.null_space(dim * i + dim - 1, dim) = i == 0 ? -1e3 : 1e3;
      }
    return system;
  }

  NodeSets
  sets_of(const std::vector<NodeState> &states, const Eigen::Index dim)
  {
    NodeSets sets;
    for (const NodeState state : states)
      {
        SmallVector along = SmallVector::Zero(dim - 1);
        along(0)          = 1;
        sets.push_back({state, false, along, .5});
      }
    return sets;
  }
} // namespace

namespace
{
  /** Friction and a layer that depend on all that they may depend on. */
  class AnyLaws : public NodalLaws
  {
  public:
    FrictionLimit
    limit(const Index,
          const double r_n,
          const double slip,
          const double) const override
    {
      const double mu = .3 + .1 * std::exp(-slip), soft = 1 + .1 * r_n;
      return {mu * r_n / soft,
              mu / (soft * soft),
              -.1 * std::exp(-slip) * r_n / soft};
    }
    Layer
    layer(const Index, const double r_n, const double slip) const override
    {
      Layer layer;
      layer.closing  = .2 * r_n / (1 + r_n) + .05 * r_n * slip;
      layer.by_force = .2 / ((1 + r_n) * (1 + r_n)) + .05 * slip;
      layer.by_slip  = .05 * r_n;
      layer.shear    = .1;
      return layer;
    }
    bool
    has_cones() const override
    {
      return false;
    }
    bool
    has_layers() const override
    {
      return true;
    }
  };

  /** r_t less the friction that z asks for, and the gap, of one node; what is
   * seen counts by the node's compliance without the layer, 1, over that with
   * it, of tangents and of the normal. */
  SmallVector
  broken_by(const AnyLaws &laws, const SmallVector &v, const SmallVector &r)
  {
    SmallVector step(3);
    step << 1 / (1 + .1), 1 / (1 + .1), 1 / (1 + .2);
    const SmallVector seen =
      see([&](const double r_n,
              const double slip) { return laws.layer(0, r_n, slip); },
          v,
          r);
    const SmallVector z    = r - step.cwiseProduct(seen);
    const double      most = laws.limit(0, z(2), seen.head(2).norm(), 0).value;
    SmallVector       law  = step.cwiseProduct(seen);
    law.head(2)            = r.head(2) - most * z.head(2).normalized();
    return law;
  }

  LinearRelation
  relation_of_one_node(const Form form, std::shared_ptr<const NodalLaws> laws)
  {
    auto system    = std::make_shared<ContactSystem>();
    system->form   = form;
    system->matrix = Eigen::MatrixXd::Identity(3, 3);
    system->first  = {0, 3};
    system->mu     = Eigen::VectorXd::Ones(1);
    ContactProblem problem;
    problem.system = system;
    problem.load   = Eigen::VectorXd::Zero(3);
    problem.gap    = Eigen::VectorXd::Zero(1);
    problem.laws   = std::move(laws);
    LinearRelation relation(system, false);
    relation.set_load(problem);
    return relation;
  }
} // namespace

// Friction, layers and wear: with all their slopes, where a node slips.
TEST(NodeSets, LawsAreDerivatives)
{
  const AnyLaws laws;
  for (const Form form : {Form::stiffness, Form::compliance})
    {
      const LinearRelation relation =
        relation_of_one_node(form, std::make_shared<AnyLaws>());

      // slips by .7 under 2, with the friction that it has there
      SmallVector  v(3), r(3);
      const double most = laws.limit(0, 2, .7, 0).value;
      r << .6 * most, -.8 * most, 2;
      v << -.7 * .6 - .1 * r(0), .7 * .8 - .1 * r(1),
        -laws.layer(0, 2, .7).closing;
      const Eigen::VectorXd p    = form == Form::stiffness ? v : r;
      const Eigen::VectorXd d    = form == Form::stiffness ? r : v;
      const NodeSets        sets = sets_of_point(relation, p, d);
      ASSERT_EQ(sets[0].state, NodeState::slip);
      const NodeLaw law = linearized_laws(relation,
                                          sets,
                                          p,
                                          d,
                                          /*definite=*/false,
                                          /*own_slopes=*/true)
                            .front();
      EXPECT_LT(law.h.norm(), 1e-14);
      constexpr double step = 1e-6;
      for (Eigen::Index k = 0; k < 3; ++k)
        for (const bool moves : {false, true})
          {
            const SmallVector unit  = step * SmallVector::Unit(3, k);
            const SmallVector zero  = SmallVector::Zero(3);
            const SmallVector dv    = moves ? unit : zero,
                              dr    = moves ? zero : unit;
            const SmallVector slope = (broken_by(laws, v + dv, r + dr) -
                                       broken_by(laws, v - dv, r - dr)) /
                                      (2 * step);
            const bool of_p = moves == (form == Form::stiffness);
            EXPECT_LT((slope - (of_p ? law.p : law.d).col(k)).norm(), 1e-8);
          }
    }
}

namespace
{
  /** An ellipse whose axes change with pressure and slip. */
  class AnyEllipse : public NodalLaws
  {
  public:
    FrictionLimit
    limit(const Index,
          const double s,
          const double slip,
          const double) const override
    {
      return {.3 * s - .02 * s * s + .05 * slip, .3 - .04 * s, .05, 0};
    }
    Layer
    layer(const Index, const double, const double) const override
    {
      return {};
    }
    Aspect
    aspect(const Index,
           const double s,
           const double slip,
           const double) const override
    {
      return {1.4 + .1 * s - .2 * slip, .1, -.2, 0};
    }
    bool
    has_ellipses() const override
    {
      return true;
    }
    bool
    has_cones() const override
    {
      return false;
    }
    bool
    has_layers() const override
    {
      return false;
    }
  };

  /** Stretched friction less its limit along z, and the gap. */
  SmallVector
  broken_ellipse(const AnyEllipse  &laws,
                 const SmallVector &v,
                 const SmallVector &r)
  {
    const double      slip  = v.head(2).norm();
    const SmallVector scale = laws.aspect(0, r(2), slip, 0).scale(3);
    const SmallVector z     = r.cwiseQuotient(scale) - scale.cwiseProduct(v);
    SmallVector       law   = v;
    law.head(2)             = r.cwiseQuotient(scale).head(2) -
                  laws.limit(0, z(2), slip, 0).value * z.head(2).normalized();
    return law;
  }
} // namespace

// What sticks or is open has no axes: a step ends where it says.
TEST(NodeSets, EllipsesLeaveWhatSticksAlone)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const NodeState state : {NodeState::stick, NodeState::open})
      {
        const LinearRelation relation =
          relation_of_one_node(form, std::make_shared<AnyEllipse>());
        SmallVector v(3), r(3);
        v << .2, -.3, .1;
        r << .4, .5, 2;
        const Eigen::VectorXd p = form == Form::stiffness ? v : r;
        const Eigen::VectorXd d = form == Form::stiffness ? r : v;
        NodeSets              sets(1);
        sets[0].state     = state;
        sets[0].direction = SmallVector::Zero(2);
        const NodeLaw law = linearized_laws(relation, sets, p, d).front();
        // the vector that vanishes
        const bool of_p =
          (state == NodeState::stick) == (form == Form::stiffness);
        const SmallMatrix one = SmallMatrix::Identity(3, 3);
        EXPECT_EQ(of_p ? law.p : law.d, one);
        EXPECT_EQ(law.h, state == NodeState::stick ? -v : -r);
      }
}

// It slips along the normal of the ellipse, with all slopes of its axes.
TEST(NodeSets, EllipsesAreDerivatives)
{
  const AnyEllipse laws;
  for (const Form form : {Form::stiffness, Form::compliance})
    {
      const LinearRelation relation =
        relation_of_one_node(form, std::make_shared<AnyEllipse>());
      SmallVector v(3), r(3);
      v << -.42, .56, 0;
      const double most = laws.limit(0, 2, .7, 0).value;
      const double a    = laws.aspect(0, 2, .7, 0).value;
      // E^2 u / |E u| of the semi-axes a most and most / a
      const double one = a * most, two = most / a;
      const double size = std::hypot(one * v(0), two * v(1));
      r << -one * one * v(0) / size, -two * two * v(1) / size, 2;
      const Eigen::VectorXd p    = form == Form::stiffness ? v : r;
      const Eigen::VectorXd d    = form == Form::stiffness ? r : v;
      const NodeSets        sets = sets_of_point(relation, p, d);
      ASSERT_EQ(sets[0].state, NodeState::slip);
      EXPECT_LT(law_residual(relation, p, d), 1e-14);
      const NodeLaw law = linearized_laws(relation, sets, p, d).front();
      EXPECT_LT(law.h.norm(), 1e-14);
      constexpr double step = 1e-6;
      for (Eigen::Index k = 0; k < 3; ++k)
        for (const bool moves : {false, true})
          {
            const SmallVector unit  = step * SmallVector::Unit(3, k);
            const SmallVector zero  = SmallVector::Zero(3);
            const SmallVector dv    = moves ? unit : zero,
                              dr    = moves ? zero : unit;
            const SmallVector slope = (broken_ellipse(laws, v + dv, r + dr) -
                                       broken_ellipse(laws, v - dv, r - dr)) /
                                      (2 * step);
            const bool of_p = moves == (form == Form::stiffness);
            EXPECT_LT((slope - (of_p ? law.p : law.d).col(k)).norm(), 1e-8);
          }
    }
}

namespace
{
  /** A bond that gives way with the slip and with the gap, and friction of
   * what is pressed beyond it, with cohesion. */
  class AnyBonds : public NodalLaws
  {
  public:
    FrictionLimit
    limit(const Index  node,
          const double s,
          const double slip,
          const double gap) const override
    {
      const Bond pull = bond(node, slip, gap);
      return {.3 * (std::max(s, 0.) - pull.value) + .4 - .05 * slip - .03 * gap,
              s > 0 ? .3 : 0.,
              -.05 - .3 * pull.by_slip,
              -.03 - .3 * pull.by_gap};
    }
    Layer
    layer(const Index, const double, const double) const override
    {
      return {};
    }
    Bond
    bond(const Index, const double slip, const double gap) const override
    {
      return {.5 - .1 * slip - .2 * gap, -.1, -.2};
    }
    bool
    has_cones() const override
    {
      return false;
    }
    bool
    has_layers() const override
    {
      return false;
    }
    bool
    is_bonded(const Index) const override
    {
      return true;
    }
    bool
    has_bonds() const override
    {
      return true;
    }
  };

  /** r_t less the friction along z, and the gap, or what its bond lacks. */
  SmallVector
  broken_bond(const AnyBonds &laws, const SmallVector &v, SmallVector r)
  {
    const double slip = v.head(2).norm(), gap = std::max(v(2), 0.);
    r(2) += laws.bond(0, slip, gap).value;
    const SmallVector z    = r - v;
    const double      most = laws.limit(0, z(2), slip, gap).value;
    SmallVector       law(3);
    law.head(2) = r.head(2) - most * z.head(2).normalized();
    law(2)      = z(2) > 0 ? v(2) : r(2);
    return law;
  }
} // namespace

// Pressed or pulled, slipping: with all their slopes.
TEST(NodeSets, LawsOfBondsAreDerivatives)
{
  const AnyBonds laws;
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const double gap : {0., .6})
      {
        const LinearRelation relation =
          relation_of_one_node(form, std::make_shared<AnyBonds>());

        const double slip = .7, bond = laws.bond(0, slip, gap).value;
        const double pressing = gap > 0 ? -bond : 2.;
        const double most     = laws.limit(0, pressing + bond, slip, gap).value;
        SmallVector  v(3), r(3);
        r << .6 * most, -.8 * most, pressing;
        v << -.6 * slip, .8 * slip, gap;
        const Eigen::VectorXd p    = form == Form::stiffness ? v : r;
        const Eigen::VectorXd d    = form == Form::stiffness ? r : v;
        const NodeSets        sets = sets_of_point(relation, p, d);
        ASSERT_EQ(sets[0].state, NodeState::slip);
        ASSERT_EQ(sets[0].is_lifted, gap > 0);
        const NodeLaw law = linearized_laws(relation, sets, p, d).front();
        EXPECT_LT(law.h.norm(), 1e-14);
        EXPECT_LT(law_residual(relation, p, d), 1e-14);
        constexpr double step = 1e-6;
        for (Eigen::Index k = 0; k < 3; ++k)
          for (const bool moves : {false, true})
            {
              if (gap == 0 && moves && k == 2)
                continue; // a gap has a kink there
              const SmallVector unit  = step * SmallVector::Unit(3, k);
              const SmallVector zero  = SmallVector::Zero(3);
              const SmallVector dv    = moves ? unit : zero,
                                dr    = moves ? zero : unit;
              const SmallVector slope = (broken_bond(laws, v + dv, r + dr) -
                                         broken_bond(laws, v - dv, r - dr)) /
                                        (2 * step);
              const bool of_p = moves == (form == Form::stiffness);
              EXPECT_LT((slope - (of_p ? law.p : law.d).col(k)).norm(), 1e-8)
                << k << moves << gap;
            }
      }
}

TEST(NodeSets, WhatSticksOrTurnsHoldsABody)
{
  constexpr NodeState open = NodeState::open, stick = NodeState::stick,
                      slip = NodeState::slip;
  for (const Eigen::Index dim : {2, 3})
    {
      const ContactSystem system = on_two_nodes(dim);
      EXPECT_TRUE(resist_motions(system, sets_of({stick, stick}, dim)));
      EXPECT_TRUE(resist_motions(system, sets_of({slip, stick}, dim)));
      EXPECT_FALSE(resist_motions(system, sets_of({slip, slip}, dim)));
      EXPECT_FALSE(resist_motions(system, sets_of({stick, open}, dim)));
    }
  // slips in different directions oppose every one of them
  NodeSets crossed = sets_of({slip, slip}, 3);
  crossed[1].direction << 0, 1;
  EXPECT_TRUE(resist_motions(on_two_nodes(3), crossed));
}

TEST(NodeSets, WhatFrictionCannotHoldDoesNotCount)
{
  ContactSystem system = on_two_nodes(2);
  system.mu.setZero();
  const NodeSets closed = sets_of({NodeState::slip, NodeState::slip}, 2);
  EXPECT_FALSE(resist_motions(system, closed));
  system.null_space.col(0).setZero(); // no contact sees it
  EXPECT_TRUE(resist_motions(system, closed));
  system.null_space.resize(4, 0);
  EXPECT_TRUE(resist_motions(system, closed));
}
