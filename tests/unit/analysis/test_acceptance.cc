// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/acceptance.h"
#include "conetact/solvers/solver_table.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::analysis;
using namespace conetact::contact;

namespace
{
  /** The increments of a scene, solved one by one and not yet judged. */
  class Increments
  {
  public:
    explicit Increments(const std::string &text)
      : scene(test::make_scene(text))
      , model(scene->bodies, scene->times)
      , acceptance(*scene, model, log)
      , loads(scene->nodal_loads())
      , history(model)
    {
      acceptance.set_stiffness(model.elasticity());
    }

    PendingIncrement
    next()
    {
      const double     t = scene->times[n++];
      PendingIncrement one{history, history};
      one.record.increment = n;
      one.record.time      = t;
      one.forces = one.mechanical = contact::shared(loads.at(t));
      one.load                    = model.load_case(*one.forces, {}, t);
      one.end                     = history.start();
      if (one.end.v.size() > 0)
        solve(one);
      one.primal  = history.primal();
      one.motions = history.free_motions();
      one.after   = history;
      w           = contact::shared(
        model.elasticity().expand({&one.load}, {one.primal}).front());
      return one;
    }

    /** Empty: it is accepted. */
    std::string
    complete(PendingIncrement &increment, const bool drawn = false)
    {
      return acceptance.complete(increment,
                                 acceptance.judge(increment, w),
                                 w,
                                 drawn);
    }

    Log                                 log{true, false};
    std::unique_ptr<application::Scene> scene;
    ContactModel                        model;
    Acceptance                          acceptance;
    contact::SharedVector               w; ///< deformation of the last one

  private:
    void
    solve(PendingIncrement &one)
    {
      const solvers::ContactProblem problem = history.problem(one.load);
      EXPECT_TRUE(
        solvers::make_solver(scene->solver)->solve(problem, one.end).converged);
      if (problem.system->form == solvers::Form::stiffness)
        one.end.u = solvers::elastic_part(problem, one.end);
      history.advance(one.end, one.record.time);
      one.state   = one.end;
      one.contact = history.displacements();
    }

    bodies::NodalLoads loads;
    ContactHistory     history;
    unsigned int       n = 0;
  };

  /** Pressed by its top, then pulled to the side, with a weight on it. */
  const std::string pressed = test::triangle_on_floor(
    "set Supports = top\nset Loads = weight\n",
    test::held_top("0.01*max(t - 1, 0) ; -0.02*min(t, 1)") +
      test::section("Load weight",
                    "Body = frame|Kind = point force|Point = 2, 0|"
                    "Value = 0 ; -0.5") +
      test::section("Time", "End = 3|Increments = 3"),
    "|Friction coefficient = 0.3");

  std::string
  block(const std::string &name,
        const std::string &cells,
        const std::string &corners)
  {
    return "subsection Body " + name + "\n" +
           test::section("Mesh",
                         "Generator = subdivided_hyper_rectangle|"
                         "Arguments = " +
                           cells + " : " + corners + " : true") +
           test::section("Material",
                         "Young modulus = 1000|Poisson ratio = 0.3") +
           "end\n";
  }

  bool
  contains(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }
} // namespace



TEST(Acceptance, RecordsOfWhatIsAccepted)
{
  Increments increments(pressed);
  double     stored = 0;
  for (const unsigned int k : {1u, 2u, 3u})
    {
      PendingIncrement one = increments.next();
      EXPECT_EQ(increments.complete(one, k == 2), "");
      const model::IncrementRecord &record = one.record;
      EXPECT_EQ(record.rows.size(), 2u);
      Tensor<1, 3> sum     = record.supports.force + record.loads.force;
      Tensor<1, 3> turning = record.supports.moment + record.loads.moment;
      for (const model::Resultant &contact : record.contacts)
        {
          sum += contact.force;
          turning += contact.moment;
        }
      EXPECT_LE(sum.norm(), 1e-14) << k;
      EXPECT_LE(turning.norm(), 1e-14) << k;
      EXPECT_LE(record.balance, 1e-14) << k;
      test::expect_near(record.loads.force, test::vector(0, -.5));
      EXPECT_NEAR(record.external_work,
                  record.strain_energy - stored + record.dissipation +
                    record.contact_work_normal,
                  1e-14);
      EXPECT_GE(record.dissipation, -1e-16);
      stored = record.strain_energy;
      EXPECT_TRUE(record.body_balance.empty()); // one body: that of the whole
      EXPECT_EQ(record.displacements.size(), k == 2 ? 1u : 0u);
      EXPECT_LE(record.equilibrium, 1e-10);
      EXPECT_LE(record.report.residual, 1e-10);
    }
}



TEST(Acceptance, AWrongReactionIsRefusedAndForgotten)
{
  Increments       increments(pressed);
  PendingIncrement one   = increments.next();
  PendingIncrement wrong = one;
  wrong.state.r[1] *= 1.01;
  const std::string why = increments.complete(wrong);
  EXPECT_NE(why, "");
  EXPECT_TRUE(wrong.record.rows.empty());
  EXPECT_GT(wrong.record.equilibrium, 1e-4);
  EXPECT_EQ(increments.complete(one), ""); // as if it had never been
}



TEST(Acceptance, DisplacementsAreRigidMotionAndDeformation)
{
  Increments            increments(pressed);
  PendingIncrement      one = increments.next();
  const Eigen::VectorXd u =
    increments.acceptance.displacements(one, *increments.w);
  EXPECT_NEAR(u[4], 0, 1e-16);
  EXPECT_NEAR(u[5], -.02, 1e-16);
  EXPECT_NEAR(u[1], 0, 1e-16); // the feet stand on the floor
  EXPECT_NEAR(u[3], 0, 1e-16);
  EXPECT_EQ(increments.complete(one), "");
}



TEST(Acceptance, SupportsThatPushContactNodesIntoTheFloorAreTold)
{
  Increments        increments(test::triangle_on_floor(
    "set Supports = feet\n",
    test::section("Support feet",
                  "Body = frame|Boundary ids = 1|Directions = x, y|"
                         "Displacement = 0 ; -0.25*t")));
  PendingIncrement  one = increments.next();
  const std::string why = increments.complete(one);
  EXPECT_TRUE(contains(why,
                       "a support holds the contact node at (0, 0, 0) of body "
                       "'frame' along its contact normal and pushes it into "
                       "what it may touch, by 0.25"))
    << why;
}



TEST(Acceptance, SlidesOfMoreThanACellAreTold)
{
  for (const double slide : {.5, 1.5})
    {
      Increments increments(
        "set Dimension = 2\nset Bodies = low, high\nset Contacts = joint\n"
        "set Supports = ground, top\n" +
        block("low", "4, 1", "0, 0 : 4, 1") +
        block("high", "1, 1", "1, 1 : 2, 2") +
        test::section("Contact joint",
                      "Body = high|Boundary ids = 2|Master body = low|"
                      "Master boundary ids = 3|Pairing = node to face") +
        test::section("Support ground",
                      "Body = low|Boundary ids = 2|Directions = x, y") +
        test::section("Support top",
                      "Body = high|Boundary ids = 3|Directions = x, y|"
                      "Displacement = " +
                        std::to_string(slide) + "*t ; -0.001*t"));
      PendingIncrement  one = increments.next();
      const std::string why = increments.complete(one);
      EXPECT_EQ(contains(why, "has slid by 1."), slide > 1) << why;
      EXPECT_EQ(why.empty(), slide < 1) << why;
      EXPECT_EQ(one.record.body_balance.size(), 2u);
    }
}
