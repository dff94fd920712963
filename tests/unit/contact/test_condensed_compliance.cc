// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_compliance.h"
#include "conetact/contact/contact_history.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  /** 3 long and 1 high. */
  std::string
  block(const std::string &name,
        const double       left,
        const double       low,
        const double       young)
  {
    const auto at = [](const double x, const double y) {
      return std::to_string(x) + ", " + std::to_string(y);
    };
    return "subsection Body " + name + "\n" +
           test::section("Mesh",
                         "Generator = subdivided_hyper_rectangle|"
                         "Arguments = 3, 2 : " +
                           at(left, low) + " : " + at(left + 3, low + 1) +
                           " : true") +
           test::section("Material",
                         "Young modulus = " + std::to_string(young) +
                           "|Poisson ratio = 0.25") +
           "end\n";
  }

  std::string
  on_floor(const std::string &name)
  {
    return test::section("Contact " + name,
                         "Body = " + name +
                           "|Boundary ids = 2|Obstacle = floor|"
                           "Friction coefficient = 0.3");
  }

  /** A block that nothing holds on a floor. */
  const std::string floating =
    "set Dimension = 2\nset Bodies = block\nset Obstacles = floor\n"
    "set Contacts = block\n" +
    block("block", 0, 0, 100) + on_floor("block") +
    test::section("Obstacle floor", "Shape = half space|Normal = 0, 1");

  /** Two that nothing holds, of any stiffness, one on the other. */
  std::string
  pair(const double young)
  {
    return "set Dimension = 2\nset Bodies = low, high\nset Contacts = joint\n" +
           block("low", 0, 0, 100) + block("high", 0, 1, young) +
           test::section("Contact joint",
                         "Body = high|Boundary ids = 2|Master body = low|"
                         "Master boundary ids = 3|Pairing = node to face|"
                         "Friction coefficient = 0.3");
  }

  /** Forces on all dofs of reactions. */
  Eigen::VectorXd
  spread(const ContactModel &model, const Eigen::VectorXd &r)
  {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(model.coordinates.n_dofs());
    for (const ContactPoint &point : model.points)
      for (Eigen::Index k = 0; k < 2; ++k)
        pairing::for_each_side(*point.node,
                               [&](const unsigned int body,
                                   const unsigned int node,
                                   const double       weight) {
                                 for (unsigned int c = 0; c < 2; ++c)
                                   f[model.coordinates.dof(body, node) + c] +=
                                     weight * r[point.first + k] *
                                     point.dual[static_cast<std::size_t>(k)][c];
                               });
    return f;
  }

  struct Parts
  {
    Eigen::MatrixXd W, G, lower, C;
    explicit Parts(const solvers::ContactSystem &system)
    {
      const Eigen::Index n = system.n_contact_unknowns(), k = system.n_motions;
      W     = system.matrix.topLeftCorner(n, n);
      G     = system.matrix.topRightCorner(n, k);
      lower = system.matrix.bottomLeftCorner(k, n);
      C     = system.matrix.bottomRightCorner(k, k);
    }
  };

  /** Reactions that balance by themselves: their free motions do no work. */
  Eigen::MatrixXd
  balanced(const Eigen::MatrixXd &G)
  {
    return Eigen::FullPivLU<Eigen::MatrixXd>(G.transpose()).kernel();
  }
} // namespace



TEST(CondensedCompliance, MatrixOfABodyThatFloats)
{
  const auto   scene = test::make_scene(floating);
  ContactModel model(scene->bodies, {1});
  ASSERT_TRUE(model.condensed_form() == solvers::Form::compliance);
  const solvers::ContactSystem &system = *model.elasticity().system();
  const Parts                   parts(system);
  EXPECT_EQ(system.n_motions, 3);
  EXPECT_LE((parts.W - parts.W.transpose()).cwiseAbs().maxCoeff(),
            1e-14 * parts.W.norm());
  EXPECT_EQ(parts.lower, -parts.G.transpose());
  EXPECT_EQ(parts.C.norm(), 0); // no foundation
  EXPECT_LE((parts.G - model.motions.seen()).norm(), 1e-14 * parts.G.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(parts.W);
  EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-14 * parts.W.norm());
}



// between balanced reactions W is the flexibility of the body, whichever
// inverse of its stiffness makes it
TEST(CondensedCompliance, FlexibilityIsThatOfTheStiffness)
{
  const auto               scene = test::make_scene(floating);
  ContactModel             model(scene->bodies, {1});
  const Parts              parts(*model.elasticity().system());
  const Eigen::MatrixXd    r    = balanced(parts.G);
  const bodies::Structure &body = *scene->bodies.structures[0];
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> inverse(
    test::stiffness(body));
  ASSERT_EQ(r.cols(), 5);
  for (Eigen::Index i = 0; i < r.cols(); ++i)
    for (Eigen::Index j = 0; j < r.cols(); ++j)
      EXPECT_NEAR(
        r.col(i).dot(parts.W * r.col(j)),
        spread(model, r.col(i)).dot(inverse.solve(spread(model, r.col(j)))),
        1e-13);
}



// v = W r + G a + q, and forces on all dofs balance
TEST(CondensedCompliance, RecoveredDisplacementsBalanceAndAreThoseOfTheRelation)
{
  const auto            scene = test::make_scene(pair(1000));
  ContactModel          model(scene->bodies, {1});
  Elasticity           &elastic = model.elasticity();
  const Eigen::Index    n       = model.coordinates.n_dofs();
  const Parts           parts(*elastic.system());
  const Eigen::MatrixXd kernel = balanced(parts.G);
  const Eigen::VectorXd r =
    kernel * Eigen::VectorXd::LinSpaced(kernel.cols(), -1, 2);
  const LoadCase load =
    elastic.reduce(Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n));
  Eigen::VectorXd primal       = Eigen::VectorXd::Zero(r.size() + 6);
  primal.head(r.size())        = r;
  const Eigen::VectorXd w      = elastic.expand({&load}, {primal}).front();
  const Eigen::VectorXd forces = spread(model, r);
  EXPECT_LE((model.elastic.internal_forces(w) - forces).norm(),
            1e-12 * forces.norm());
  EXPECT_LE((model.relative_displacements(w, 1) - parts.W * r).norm(),
            1e-13 * (parts.W * r).norm());
}



TEST(CondensedCompliance, BalanceOfTheLoads)
{
  const auto      scene = test::make_scene(floating);
  ContactModel    model(scene->bodies, {1});
  Eigen::VectorXd f = Eigen::VectorXd::Zero(model.coordinates.n_dofs());
  f[3]              = -2;
  f[8]              = .5;
  const LoadCase load =
    model.elasticity().reduce(f, Eigen::VectorXd::Zero(f.size()));
  // C a - G^T r - b = 0: with r that balances the load it holds
  const Eigen::VectorXd minus_b = load.f.tail(3);
  const Eigen::VectorXd work =
    model.motions.free().transpose() * model.motions.resultants(f);
  EXPECT_LE((minus_b + work).norm(), 1e-14 * work.norm());
}



// the digits of the soft body are not lost in those of the stiff one
TEST(CondensedCompliance, FlexibilitiesOfStiffAndSoftBodiesAdd)
{
  // of balanced reactions: which part of motions W takes is its own affair
  const auto flexibility = [](const double young) {
    const auto            scene = test::make_scene(pair(young));
    ContactModel          model(scene->bodies, {1});
    const Parts           parts(*model.elasticity().system());
    const Eigen::MatrixXd r = balanced(parts.G);
    return Eigen::MatrixXd(r.transpose() * parts.W * r);
  };
  const Eigen::MatrixXd one = flexibility(100), two = flexibility(200),
                        rigid = flexibility(1e14);
  EXPECT_LE((one - 2 * two + rigid).norm(), 1e-11 * one.norm());
}



TEST(CondensedCompliance, EqualBodiesAreCondensedOnce)
{
  const auto scene = test::make_scene(
    "set Dimension = 2\nset Bodies = one, two\nset Obstacles = floor\n"
    "set Contacts = one, two\n" +
    block("one", 0, 0, 100) + block("two", 4, 0, 100) + on_floor("one") +
    on_floor("two") +
    test::section("Obstacle floor", "Shape = half space|Normal = 0, 1"));
  ContactModel model(scene->bodies, {1});
  Elasticity  &elastic = model.elasticity();
  EXPECT_EQ(elastic.report().n_shared_bodies, 1u);
  const Eigen::MatrixXd W = Parts(*elastic.system()).W;
  EXPECT_EQ(W.topLeftCorner(8, 8), W.bottomRightCorner(8, 8));
  EXPECT_EQ(W.topRightCorner(8, 8).norm(), 0);
}



TEST(CondensedCompliance, AllCondensersAgree)
{
  const auto   scene = test::make_scene(pair(200));
  ContactModel model(scene->bodies, {1});
  for (const condensed::Condenser &condenser : condensed::condenser_table())
    for (const StiffnessDifference &found : model.compare_stiffness(condenser))
      EXPECT_LE(found.relative, 1e-12) << condenser.name;
}
