// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/corners_to_faces.h"
#include "conetact/pairing/node_to_face.h"
#include "conetact/pairing/obstacle_table.h"

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::pairing;

namespace
{
  using Body = std::unique_ptr<Structure>;

  Body
  block(const unsigned int dim,
        const std::string &cells,
        const std::string &low,
        const std::string &high,
        const std::string &more = "")
  {
    return test::make_body(dim,
                           "Generator = subdivided_hyper_rectangle|"
                           "Arguments = " +
                             cells + " : " + low + " : " + high + " : true" +
                             more);
  }

  Contact
  joint(const unsigned int slave_id, const unsigned int master_id)
  {
    Contact contact;
    contact.name       = "joint";
    contact.ids        = {slave_id};
    contact.master     = 1;
    contact.master_ids = {master_id};
    contact.reach      = 10;
    return contact;
  }

  /** The point that is the mean of master nodes. */
  Point<3>
  foot_of(const ContactNode &node, const Structure &master)
  {
    Point<3> p;
    for (const auto &[i, weight] : node.masters)
      p += weight * Tensor<1, 3>(master.position(i));
    return p;
  }
} // namespace



// shape functions: between 0 and 1, in all 1, and they know the place
TEST(NodeToFace, WeightsAreThoseOfTheFoot)
{
  for (const unsigned int dim : {2u, 3u})
    {
      const Body        low  = dim == 2 ? block(2, "3, 1", "0, 0", "2, 1") :
                                          block(3, "3, 4, 1", "0, 0, 0", "2, 2, 1");
      const Body        high = dim == 2 ?
                                 block(2, "5, 1", "0.1, 1.25", "1.9, 2") :
                                 block(3, "5, 3, 1", "0.1, 0.1, 1.25", "1.9, 1.9, 2");
      const PairedNodes found =
        pair_nodes_with_faces(dim == 2 ? joint(2, 3) : joint(4, 5),
                              {high.get(), low.get()});
      EXPECT_EQ(found.n_nodes, dim == 2 ? 6u : 24u);
      EXPECT_EQ(found.n_paired, found.n_nodes);
      EXPECT_FALSE(found.deepest);
      double area = 0;
      for (const ContactNode &node : found.nodes)
        {
          double sum = 0;
          for (const auto &[i, weight] : node.masters)
            {
              EXPECT_GE(weight, -1e-15);
              sum += weight;
            }
          EXPECT_NEAR(sum, 1, 1e-14);
          EXPECT_NEAR(node.gap, .25, 1e-14);
          EXPECT_NEAR(node.n[dim - 1], 1, 1e-14);
          EXPECT_LE(
            (node.position - node.gap * node.n - foot_of(node, *low)).norm(),
            1e-14);
          EXPECT_TRUE(node.slaves.empty());
          EXPECT_EQ(node.master, 1u);
          area += node.area;
        }
      EXPECT_NEAR(area, dim == 2 ? 1.8 : 1.8 * 1.8, 1e-14);
    }
}



TEST(NodeToFace, DistancesTurnWithTheBodies)
{
  const std::string turn = "|Rotation = 30";
  const Body        low  = block(2, "3, 1", "0, 0", "2, 1", turn);
  const Body        high = block(2, "5, 1", "0.1, 1.25", "1.9, 2", turn);
  for (const ContactNode &node :
       pair_nodes_with_faces(joint(2, 3), {high.get(), low.get()}).nodes)
    {
      EXPECT_NEAR(node.gap, .25, 1e-14);
      EXPECT_NEAR(node.n[0], -.5, 1e-14);
      EXPECT_NEAR(node.n[1], std::sqrt(.75), 1e-14);
    }
}



TEST(NodeToFace, WhatIsBeyondReachOrBesideStaysFree)
{
  const Body low     = block(2, "2, 1", "0, 0", "1, 1");
  const Body high    = block(2, "4, 1", "0, 1.5", "4, 2");
  Contact    contact = joint(2, 3);
  contact.reach      = .4;
  EXPECT_EQ(pair_nodes_with_faces(contact, {high.get(), low.get()}).n_paired,
            0u);
  contact.reach = .6;
  // nodes at x = 0 and 1 are above the block, others are beside it
  const PairedNodes found =
    pair_nodes_with_faces(contact, {high.get(), low.get()});
  EXPECT_EQ(found.n_nodes, 5u);
  EXPECT_EQ(found.n_paired, 2u);
  for (const ContactNode &node : found.nodes)
    EXPECT_LE(node.position[0], 1);
}



TEST(NodeToFace, AGapThatIsWrittenDownReplacesTheDistance)
{
  const Body low     = block(2, "2, 1", "0, 0", "1, 1");
  const Body high    = block(2, "2, 1", "0, 1.1", "1, 2");
  Contact    contact = joint(2, 3);
  contact.gap.emplace("0.5*x - 1", "test");
  const PairedNodes found =
    pair_nodes_with_faces(contact, {high.get(), low.get()});
  ASSERT_EQ(found.n_paired, 3u);
  for (const ContactNode &node : found.nodes)
    {
      EXPECT_NEAR(node.gap, .5 * node.position[0] - 1, 1e-15);
      EXPECT_NEAR(node.n[1], 1, 1e-15);
    }
  EXPECT_FALSE(found.deepest); // so it is meant
}



TEST(NodeToFace, TheDeepestOfThoseThatAreTooDeepIsTold)
{
  const Body low = block(2, "2, 1", "0, 0", "1, 1");
  // .2 inside, where a quarter of an edge of .5 is allowed
  const Body high = block(2, "2, 1", "0, 0", "1, 1", "|Translation = 0, 0.8");
  Contact    contact = joint(2, 3);
  EXPECT_DOUBLE_EQ(interference_allowed(contact, .5), .125);
  const PairedNodes found =
    pair_nodes_with_faces(contact, {high.get(), low.get()});
  ASSERT_TRUE(found.deepest);
  EXPECT_NEAR(found.deepest->gap, -.2, 1e-14);
  EXPECT_NEAR(found.deepest->allowed, .125, 1e-14);
  contact.interference = .3;
  EXPECT_EQ(interference_allowed(contact, .5), .3);
  EXPECT_FALSE(pair_nodes_with_faces(contact, {high.get(), low.get()}).deepest);
}



TEST(NodeToFace, ObstaclesAreMetWithoutMasters)
{
  dealii::ParameterHandler prm;
  declare_obstacle(prm);
  prm.parse_input_from_string("set Shape = half space\nset Normal = 0, 2\n"
                              "set Point = 5, -0.5\n");
  const Obstacle obstacle = create_obstacle(prm, "floor", 2);
  const Body     high     = block(2, "2, 1", "0, 0", "1, 1");
  Contact        contact  = joint(2, 3);
  contact.obstacle        = &obstacle;
  const auto found        = pair_nodes_with_faces(contact, {high.get()});
  EXPECT_EQ(found.n_paired, 3u);
  for (const ContactNode &node : found.nodes)
    {
      EXPECT_NEAR(node.gap, .5, 1e-15);
      EXPECT_NEAR(node.n[1], 1, 1e-15);
      EXPECT_TRUE(node.masters.empty());
      EXPECT_EQ(node.obstacle, &obstacle);
      EXPECT_EQ(node.spacing, .5);
    }
}

TEST(NodeToFace, CornersOfTetrahedraAreMeansOfPairsOfNodesAndFeet)
{
  const auto cube = [](const std::string &low, const std::string &high) {
    return test::make_body(3,
                           "Generator = subdivided_hyper_rectangle|"
                           "Arguments = 1, 1, 1 : " +
                             low + " : " + high + " : true",
                           "Young modulus = 5|Poisson ratio = 0.3",
                           "P2");
  };
  const Body high = cube("0, 0, 1.25", "1, 1, 2"),
             low  = cube("0, 0, 0", "1, 1, 1");
  const auto found =
    pair_corners_with_faces(joint(4, 5), {high.get(), low.get()});
  EXPECT_EQ(found.nodes.size(), 5u); // corners and the middle of a side
  double area = 0;
  for (const ContactNode &node : found.nodes)
    {
      EXPECT_NEAR(node.gap, .25, 1e-14);
      EXPECT_NEAR((node.n - Tensor<1, 3>({0., 0., 1.})).norm(), 0, 1e-14);
      EXPECT_EQ(node.slaves.size(), node.masters.size()); // faces match
      Tensor<1, 3> mean;
      for (const auto &[i, weight] : node.slaves)
        mean += weight * Tensor<1, 3>(high->position(i));
      EXPECT_NEAR((mean - Tensor<1, 3>(node.position)).norm(), 0, 1e-14);
      EXPECT_NEAR((foot_of(node, *low) - node.foot()).norm(), 0, 1e-14);
      area += node.area;
    }
  EXPECT_NEAR(area, 1, 1e-14);
}
