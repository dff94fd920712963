// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/scene_report.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::analysis;
using namespace conetact::contact;

namespace
{
  /** A triangle that is held and loaded, and the lines about it. */
  class Report : public testing::Test
  {
  protected:
    void
    make(const std::string &lists,
         const std::string &more,
         const std::string &contact = "")
    {
      scene = test::make_scene(test::triangle_on_floor(lists, more, contact));
      model = std::make_unique<ContactModel>(scene->bodies, scene->times);
    }

    template <typename Write>
    std::string
    lines(const Write &write) const
    {
      Log log(true, false);
      log.open(test::folder());
      write(log);
      return test::read_file(test::folder() / "log.txt");
    }

    std::unique_ptr<application::Scene> scene;
    std::unique_ptr<ContactModel>       model;
  };

  void
  expect_contains(const std::string &text, const std::string &part)
  {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n"
                                                  << text;
  }
  void
  expect_lacks(const std::string &text, const std::string &part)
  {
    EXPECT_EQ(text.find(part), std::string::npos) << part << " is in\n" << text;
  }
} // namespace



TEST_F(Report, Sizes)
{
  make("set Supports = top\n",
       test::held_top() + test::section("Time", "End = 4|Increments = 4") +
         test::section("Output", "VTU = 2"),
       "|Friction coefficient = 0.2");
  const std::string text =
    lines([&](Log &log) { report_sizes(*scene, *model, log); });
  expect_contains(text, "Body frame: ");
  expect_contains(text, "2 contact nodes with 4 unknowns of 4, 4 increments\n");
  expect_contains(text, "Contact feet: 2 nodes, 2 paired, gaps from 0 to 0\n");
  expect_contains(text, "skipped: drawings of 2 of 4 increments\n");
  expect_lacks(text, "friction cones");
  // it may turn about its top
  expect_contains(text, "1 rigid motions are held by contact alone\n");
}



TEST_F(Report, WhatIsSkippedAndWhatFloats)
{
  make("", "");
  const std::string text =
    lines([&](Log &log) { report_sizes(*scene, *model, log); });
  expect_contains(text, "skipped: friction cones of 2 contact nodes without");
  expect_contains(text, "3 rigid motions are held by contact alone\n");
}



TEST_F(Report, NormalsThatSupportsHold)
{
  make("set Supports = feet\n",
       test::section("Support feet",
                     "Body = frame|Boundary ids = 1|Directions = x, y"));
  const std::string text =
    lines([&](Log &log) { report_sizes(*scene, *model, log); });
  expect_contains(text, "skipped: condensation, no node may touch anything\n");
  expect_contains(text,
                  "skipped: 2 contact nodes whose normal is held by a "
                  "support\n");
}



TEST_F(Report, ResultantsOfLoads)
{
  make("set Supports = top\nset Loads = weight, push\n",
       test::held_top() +
         test::section("Load weight",
                       "Body = frame|Kind = point force|Point = 1, 1|"
                       "Value = 0 ; -7") +
         test::section("Load push",
                       "Body = frame|Kind = point force|Point = 2, 0|"
                       "Value = 3*t ; 0"));
  bodies::NodalLoads loads = scene->nodal_loads();
  loads.at(.5);
  loads.at(2);
  loads.at(1);
  const std::string text = lines([&](Log &log) { report_loads(loads, log); });
  expect_contains(text,
                  "Load weight: resultant (0, -7, 0) at all times, on 1 "
                  "nodes\n");
  expect_contains(text,
                  "Load push: resultant (6, 0, 0) at t = 2, on 1 nodes\n");
}



TEST_F(Report, CostIsAnEstimateAndNothingIsFactorised)
{
  make("set Supports = top\n", test::held_top());
  const std::string text = lines(
    [&](Log &log) { report_cost(*scene, *model, backend_table()[0], log); });
  expect_contains(text, "estimate: factor of ");
  expect_contains(text, "condensed stiffness of 3.2e-05 MB"); // 8 x 2 x 2
  expect_contains(text, "floating-point operations to factorise");
  expect_lacks(text, "warning");
  EXPECT_EQ(model->work().factorizations, 0u);
}



TEST_F(Report, SharedBodiesAreCountedAmongThoseThatMove)
{
  model::Bodies bodies;
  bodies.names = {"a", "b", "c", "d"};
  EXPECT_EQ(lines([&](Log &log) { report_shared_bodies(bodies, 0, log); }), "");
  bodies.at_rest = {false, true, false, false};
  EXPECT_EQ(lines([&](Log &log) { report_shared_bodies(bodies, 2, log); }),
            "skipped: condensation of 2 of 3 bodies, equal to others\n");
}



TEST_F(Report, WhatTheIncrementsWereSpared)
{
  make("set Supports = top\nset Loads = push\n",
       test::held_top() +
         test::section("Load push",
                       "Body = frame|Kind = point force|Point = 1, 1|"
                       "Value = 3 ; 0") +
         test::section("Time", "End = 5|Increments = 5"));
  bodies::NodalLoads loads = scene->nodal_loads();
  for (const double t : scene->times)
    model->load_case(loads.at(t), {}, t);
  const std::string text =
    lines([&](Log &log) { report_skips(*scene, *model, loads, log); });
  expect_contains(text, "skipped: 4 of 5 factorisations");
  expect_contains(text, "skipped: 4 of 5 load cases");
  expect_contains(text, "skipped: 4 of 5 integrations of loads");
}
