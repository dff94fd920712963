// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/held_nodes.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::contact;

namespace
{
  using Weights = std::vector<std::pair<unsigned int, double>>;

  std::string
  block(const std::string &name, const std::string &place)
  {
    return "subsection Body " + name + "\n" +
           test::section("Mesh",
                         "Generator = subdivided_hyper_rectangle|"
                         "Arguments = 4, 1 : " +
                           place + " : true") +
           test::section("Material",
                         "Young modulus = 1000|Poisson ratio = 0.3") +
           "end\n";
  }

  /** Two blocks with a joint of 4 faces; the left side of the upper one is
   * held. */
  std::unique_ptr<application::Scene>
  joint(const std::string &pairing, const std::string &law = "")
  {
    return test::make_scene(
      "set Dimension = 2\nset Bodies = low, high\nset Contacts = joint\n"
      "set Supports = ground, side\n" +
      block("low", "0, 0 : 2, 1") + block("high", "0, 1 : 2, 2") +
      test::section("Contact joint",
                    "Body = high|Boundary ids = 2|Master body = low|"
                    "Master boundary ids = 3|Pairing = " +
                      pairing + law) +
      test::section("Support ground", "Body = low|Boundary ids = 2") +
      test::section("Support side", "Body = high|Boundary ids = 0"));
  }

  double
  sum(const Weights &weights)
  {
    double s = 0;
    for (const auto &[node, weight] : weights)
      s += weight;
    return s;
  }
} // namespace



TEST(HeldNodes, TheirNeighboursTakeTheirShare)
{
  const auto  scene = joint("mortar");
  const auto &nodes = scene->bodies.contact_nodes;
  ASSERT_EQ(nodes.size(), 4u); // of 5
  double                      area  = 0;
  const pairing::ContactNode *taker = nullptr;
  for (const pairing::ContactNode &node : nodes)
    {
      area += node.area;
      EXPECT_NE(node.position[0], 0);
      EXPECT_NEAR(node.gap, 0, 1e-14);
      EXPECT_NEAR(sum(node.masters), 1, 1e-14);
      if (!node.slaves.empty())
        taker = &node;
    }
  EXPECT_NEAR(area, 2, 1e-14);
  ASSERT_NE(taker, nullptr);
  EXPECT_EQ(taker->position[0], .5);
  EXPECT_NEAR(taker->area, .75, 1e-14);
  ASSERT_EQ(taker->slaves.size(), 2u);
  for (const auto &[node, weight] : taker->slaves)
    EXPECT_NEAR(weight, node == taker->node ? 2. / 3 : 1. / 3, 1e-14);
}



TEST(HeldNodes, TheirPrestressIsNotLost)
{
  const auto scene      = joint("mortar", "|Prestress = 1 + x");
  double     sum_of_all = 0;
  for (const pairing::ContactNode &node : scene->bodies.contact_nodes)
    {
      const double x = node.position[0];
      EXPECT_NEAR(node.prestress, x == .5 ? 1. + 1.5 : 1 + x, 1e-14);
      sum_of_all += node.prestress;
    }
  EXPECT_NEAR(sum_of_all, 10, 1e-14); // of 5 nodes
}



TEST(HeldNodes, SingleNodesLeaveTheirsToTheSupport)
{
  const auto  scene = joint("node to face");
  const auto &nodes = scene->bodies.contact_nodes;
  EXPECT_EQ(nodes.size(), 5u);
  for (const pairing::ContactNode &node : nodes)
    EXPECT_TRUE(node.slaves.empty());
}
