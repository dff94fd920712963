// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_stiffness.h"
#include "conetact/contact/contact_history.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  /** A block of 3 x 2 cells on a floor whose top is held. */
  const std::string held_block =
    "set Dimension = 2\nset Bodies = block\nset Obstacles = floor\n"
    "set Contacts = bottom\nset Supports = top\nsubsection Body block\n" +
    test::section("Mesh",
                  "Generator = subdivided_hyper_rectangle|"
                  "Arguments = 3, 2 : 0, 0 : 3, 1 : true") +
    test::section("Material", "Young modulus = 100|Poisson ratio = 0.25") +
    "end\n" +
    test::section("Obstacle floor", "Shape = half space|Normal = 0, 1") +
    test::section("Contact bottom",
                  "Body = block|Boundary ids = 2|Obstacle = floor|"
                  "Friction coefficient = 0.3") +
    test::section("Support top",
                  "Body = block|Boundary ids = 3|Directions = x, y");

  class Held : public testing::Test
  {
  protected:
    std::unique_ptr<application::Scene> scene = test::make_scene(held_block);
    ContactModel                        model{scene->bodies, {1}};
    const bodies::Structure            &block = *scene->bodies.structures[0];

    /** Rows: contact unknowns, columns: all dofs; its transpose gives forces.
     */
    Eigen::MatrixXd
    rows() const
    {
      Eigen::MatrixXd H =
        Eigen::MatrixXd::Zero(model.points.n_unknowns(), block.n_dofs());
      for (const ContactPoint &point : model.points)
        for (unsigned int k = 0; k < 2; ++k)
          for (unsigned int c = 0; c < 2; ++c)
            H(point.first + k, 2 * point.node->node + c) = point.dual[k][c];
      return H;
    }
    /** Flexibility of all dofs, zero where the support holds them. */
    Eigen::MatrixXd
    flexibility() const
    {
      Eigen::MatrixXd K = test::stiffness(block);
      for (unsigned int i = 0; i < block.n_dofs(); ++i)
        if (block.position(i / 2)[1] == 1)
          {
            K.row(i).setZero();
            K.col(i).setZero();
            K(i, i) = 1e30;
          }
      return K.inverse();
    }
    Eigen::VectorXd
    weight() const
    {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(block.n_dofs());
      block.add(bodies::Action::body_force([](const Point<3> &p) {
                  return Tensor<1, 3>({.2 * p[1], -1., 0.});
                }),
                f);
      return f;
    }
  };
} // namespace



TEST_F(Held, StiffnessIsTheInverseOfTheFlexibilityOfTheContacts)
{
  ASSERT_EQ(model.condensed_form(), solvers::Form::stiffness);
  const Eigen::MatrixXd &K = model.elasticity().system()->matrix;
  EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.norm());
  const Eigen::MatrixXd W = rows() * flexibility() * rows().transpose();
  EXPECT_LE((K * W - Eigen::MatrixXd::Identity(8, 8)).norm(), 1e-11);
}



TEST_F(Held, LoadIsWhatTheContactsWouldMoveByTimesTheStiffness)
{
  Elasticity           &elastic = model.elasticity();
  const Eigen::VectorXd none    = Eigen::VectorXd::Zero(block.n_dofs());
  const LoadCase        load    = elastic.reduce(weight(), none);
  const Eigen::VectorXd moved   = rows() * flexibility() * weight();
  EXPECT_LE((load.f - elastic.system()->matrix * moved).norm(),
            1e-11 * load.f.norm());
}



TEST_F(Held, RecoveredDisplacementsBalanceLoadsAndReactions)
{
  Elasticity           &elastic = model.elasticity();
  const Eigen::VectorXd none    = Eigen::VectorXd::Zero(block.n_dofs());
  const LoadCase        load    = elastic.reduce(weight(), none);
  const Eigen::VectorXd q       = Eigen::VectorXd::LinSpaced(8, -.01, .02);
  const Eigen::VectorXd u       = elastic.expand({&load}, {q}).front();
  EXPECT_LE((rows() * u - q).norm(), 1e-15);
  // K q = r + f
  const Eigen::VectorXd r = elastic.system()->matrix * q - load.f;
  const Eigen::VectorXd rest =
    test::stiffness(block) * u - weight() - rows().transpose() * r;
  for (unsigned int i = 0; i < block.n_dofs(); ++i)
    EXPECT_NEAR(block.position(i / 2)[1] < 1 ? rest[i] : u[i], 0, 1e-12) << i;
}



TEST_F(Held, LoadsThatAddUpOfEarlierOnesCostNoSolve)
{
  Elasticity           &elastic = model.elasticity();
  Eigen::VectorXd       lifted  = Eigen::VectorXd::Zero(block.n_dofs());
  const Eigen::VectorXd none    = lifted;
  for (unsigned int i = 0; i < block.n_nodes(); ++i)
    if (block.position(i)[1] == 1)
      lifted[2 * i + 1] = .01 * block.position(i)[0];
  const LoadCase one = elastic.reduce(weight(), none);
  const LoadCase two = elastic.reduce(none, lifted);
  EXPECT_EQ(elastic.n_reductions(), 2u);
  const LoadCase sum = elastic.reduce(3 * weight(), -.5 * lifted);
  EXPECT_EQ(elastic.n_reductions(), 2u);
  EXPECT_LE((sum.f - 3 * one.f + .5 * two.f).norm(), 1e-12 * sum.f.norm());
}



TEST_F(Held, AllCondensersAgree)
{
  for (const condensed::Condenser &condenser : condensed::condenser_table())
    for (const StiffnessDifference &found : model.compare_stiffness(condenser))
      EXPECT_LE(found.relative, 1e-13) << condenser.name;
}
