// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/contact_rows.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;
using model::ContactRow;
using solvers::NodeState;

namespace
{
  using Rows = std::vector<ContactRow>;

  Tensor<1, 3>
  in_space(const ContactRow &row, const Tensor<1, 3> &v)
  {
    return v[0] * row.normal + v[1] * row.t1 + v[2] * row.t2;
  }

  /** Solver's results that nobody has solved for. */
  solvers::ContactState
  made_up(const ContactModel &model, const double step)
  {
    const Eigen::Index    n = model.points.n_unknowns();
    solvers::ContactState state;
    state.v    = Eigen::VectorXd::LinSpaced(n, .01, .02) * step;
    state.r    = Eigen::VectorXd::LinSpaced(n, -1, 3) * step;
    state.node = std::vector<NodeState>(model.points.size(), NodeState::slip);
    return state;
  }

  /** On a slope of 3 in 4. */
  std::string
  slope(const std::string &friction)
  {
    return "set Dimension = 2\nset Bodies = frame\nset Obstacles = slope\n"
           "set Contacts = feet\n" +
           test::triangle() +
           test::section("Obstacle slope",
                         "Shape = half space|Normal = -0.6, 0.8|"
                         "Point = 0, -10|Displacement = 0.3*t; 0.1*t") +
           test::section("Contact feet",
                         "Body = frame|Boundary ids = 1|Obstacle = slope" +
                           friction);
  }

  std::string
  block(const std::string &name, const std::string &cells, const double low)
  {
    return "subsection Body " + name + "\n" +
           test::section("Mesh",
                         "Generator = subdivided_hyper_rectangle|"
                         "Arguments = " +
                           cells + " : 0, " + std::to_string(low) + " : 2, " +
                           std::to_string(low + 1) + " : true") +
           test::section("Material",
                         "Young modulus = 100|Poisson ratio = 0.25") +
           "end\n";
  }

  std::string
  joint(const std::string &pairing)
  {
    return "set Dimension = 2\nset Bodies = low, high\nset Contacts = joint\n" +
           block("low", "3, 1", 0) + block("high", "5, 1", 1) +
           test::section("Contact joint",
                         "Body = high|Boundary ids = 2|Master body = low|"
                         "Master boundary ids = 3|Friction coefficient = 0.3|"
                         "Pairing = " +
                           pairing);
  }
} // namespace



TEST(ContactRows, ComponentsInTheFrameOfTheNode)
{
  const auto   scene = test::make_scene(slope("|Friction coefficient = 0.5"));
  ContactModel model(scene->bodies, {1});
  ContactRows  translator(model, {});
  const auto   state         = made_up(model, 1);
  const Eigen::VectorXd u    = Eigen::VectorXd::LinSpaced(6, 0, .05);
  const Eigen::VectorXd q    = model.relative_displacements(u, 1);
  const Rows            rows = translator.rows(state, q, {}, shared(u), 1);
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    {
      const ContactRow   &row   = rows[i];
      const ContactPoint &point = model.points[i];
      test::expect_near(row.normal, test::vector(-.6, .8));
      test::expect_near(row.t1, test::vector(.8, .6));
      EXPECT_EQ(row.gap, state.v[point.first + 1]);
      test::expect_near(in_space(row, row.u),
                        test::vector(u[2 * row.node], u[2 * row.node + 1]) -
                          test::vector(.3, .1));
      test::expect_near(in_space(row, row.reaction),
                        state.r[point.first] * point.dual[0] +
                          state.r[point.first + 1] * point.dual[1]);
      // from the node to the plane along its normal
      test::expect_near(row.position - row.foot, point.node->gap * row.normal);
      EXPECT_NEAR(row.foot * row.normal, -8, 1e-14);
      test::expect_near(row.acts - row.position, Tensor<1, 3>());
      EXPECT_FALSE(row.master);
    }
}



TEST(ContactRows, DisplacementsAreSumsOfThoseOfTheIncrements)
{
  for (const char *friction : {"", "|Friction coefficient = 0.5"})
    {
      const auto                scene = test::make_scene(slope(friction));
      ContactModel              model(scene->bodies, {1, 2, 3});
      ContactRows               translator(model, {});
      std::vector<Tensor<1, 3>> sum(2);
      for (const double t : {1., 2., 3.})
        {
          const Eigen::VectorXd u =
            Eigen::VectorXd::LinSpaced(6, 0, .05) * t * t;
          const Eigen::VectorXd q  = model.relative_displacements(u, t);
          const Eigen::VectorXd q0 = model.relative_displacements(
            Eigen::VectorXd::LinSpaced(6, 0, .05) * (t - 1) * (t - 1), t - 1);
          auto state      = made_up(model, 1);
          state.v         = q - q0; // slips; the gap is another matter
          const Rows rows = translator.rows(state, q, {}, shared(u), t);
          for (std::size_t i = 0; i < 2; ++i)
            {
              sum[i] += rows[i].du;
              test::expect_near(sum[i], rows[i].u, 1e-14);
            }
        }
    }
}



// solvers give nodes without friction no tangents and no slip
TEST(ContactRows, StatesOfNodesWithoutFrictionAreReadOffTheirSlip)
{
  const auto   scene = test::make_scene(slope(""));
  ContactModel model(scene->bodies, {1, 2});
  ContactRows  translator(model, {});
  auto         state = made_up(model, 1);
  state.node         = {NodeState::stick, NodeState::open};
  Eigen::VectorXd u  = Eigen::VectorXd::Zero(6);
  u[0]               = .3; // along with the slope
  u[1]               = .1;
  Rows rows          = translator.rows(
    state, model.relative_displacements(u, 1), {}, shared(u), 1);
  EXPECT_EQ(rows[0].state, NodeState::stick);
  EXPECT_EQ(rows[1].state, NodeState::open);
  // the slope goes on, the foot does not
  rows = translator.rows(
    state, model.relative_displacements(u, 2), {}, shared(u), 2);
  EXPECT_EQ(rows[0].state, NodeState::slip);
  test::expect_near(rows[0].du,
                    test::vector(.6 * .3 - .8 * .1, -.8 * .3 - .6 * .1));
}



TEST(ContactRows, BothSidesOfAJointBalance)
{
  for (const char *pairing : {"mortar", "node to face"})
    {
      const auto            scene = test::make_scene(joint(pairing));
      ContactModel          model(scene->bodies, {1});
      ContactRows           translator(model, scene->master_side);
      const Eigen::VectorXd u =
        Eigen::VectorXd::Zero(model.elastic.bodies.dim * (8 + 12));
      const Rows   rows = translator.rows(made_up(model, 1),
                                        model.relative_displacements(u, 1),
                                        {},
                                        shared(u),
                                        1);
      Tensor<1, 3> force, moment;
      double       area = 0, area_of_masters = 0;
      std::size_t  n = 0;
      for (const ContactRow &row : rows)
        {
          const Tensor<1, 3> f = in_space(row, row.reaction);
          force += f;
          moment += cross_product_3d(Tensor<1, 3>(row.acts), f);
          (row.master ? area_of_masters : area) += row.area;
          n += row.master;
          EXPECT_EQ(row.contact, row.master ? 1u : 0u);
          test::expect_near(row.normal,
                            test::vector(0, row.master ? -1 : 1),
                            1e-14);
          test::expect_near(row.t1,
                            test::vector(row.master ? -1 : 1, 0),
                            1e-14);
        }
      EXPECT_EQ(n, 4u) << pairing;
      EXPECT_EQ(rows.size(), 10u) << pairing;
      EXPECT_LE(force.norm(), 1e-13) << pairing;
      EXPECT_LE(moment.norm(), 1e-12) << pairing;
      EXPECT_NEAR(area, 2, 1e-14) << pairing;
      EXPECT_NEAR(area_of_masters, 2, 1e-13) << pairing;
    }
}



// a gap that opens evenly is that of both sides, and so is its opening
TEST(ContactRows, UniformMotionsAreThoseOfTheMastersToo)
{
  const auto      scene = test::make_scene(joint("mortar"));
  ContactModel    model(scene->bodies, {1});
  ContactRows     translator(model, scene->master_side);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.coordinates.n_dofs());
  for (Eigen::Index i = model.coordinates.offset(1); i < u.size(); i += 2)
    {
      u[i]     = .25;
      u[i + 1] = .5;
    }
  const Eigen::VectorXd q     = model.relative_displacements(u, 1);
  auto                  state = made_up(model, 0);
  state.v                     = q; // closed at the start
  for (const ContactRow &row : translator.rows(state, q, {}, shared(u), 1))
    {
      EXPECT_NEAR(row.gap, .5, 1e-14);
      EXPECT_NEAR(row.u[0], .5, 1e-14);
      EXPECT_NEAR(row.u[1], .25, 1e-14);
      test::expect_near(row.u, row.du);
    }
}



// a solver tells nodes without force stick or slip as it comes
TEST(ContactRows, StatesOfMastersAreThoseOfWhatTheyCarry)
{
  for (const char *pairing : {"mortar", "node to face"})
    {
      const auto            scene = test::make_scene(joint(pairing));
      ContactModel          model(scene->bodies, {1});
      ContactRows           translator(model, scene->master_side);
      const Eigen::VectorXd u = Eigen::VectorXd::Zero(
        static_cast<Eigen::Index>(model.elastic.bodies.dim) * (8 + 12));
      const Eigen::VectorXd q     = model.relative_displacements(u, 1);
      auto                  state = made_up(model, 1);
      state.r.setConstant(1e-18);
      // the first node carries all, and slips
      for (Eigen::Index k = 0; k < 2; ++k)
        state.r[model.points.all()[0].first + k] = 1;
      for (std::size_t i = 0; i < model.points.size(); ++i)
        state.node[i] = i == 0 ? NodeState::slip :
                        i % 2  ? NodeState::stick :
                                 NodeState::open;
      const double x0 = model.points.all()[0].node->position[0];
      for (const ContactRow &row : translator.rows(state, q, {}, shared(u), 1))
        if (row.master)
          {
            const bool carries = row.reaction.norm() > 1e-9;
            EXPECT_EQ(row.state, carries ? NodeState::slip : NodeState::open)
              << pairing << ", " << row.position << ", beside " << x0;
          }
    }
}
