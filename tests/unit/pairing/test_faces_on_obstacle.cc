// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/faces_on_obstacle.h"
#include "conetact/pairing/node_to_face.h"

#include "body_fixture.h"
#include "obstacle_fixture.h"

using namespace conetact;
using namespace conetact::pairing;
using namespace conetact::test;

namespace
{
  const std::string cube =
    "Generator = subdivided_hyper_rectangle|Arguments = 1, 1, 1 : 0, 0, 0 : "
    "1, 1, 1 : true";

  Contact
  bottom_on(const Obstacle &obstacle)
  {
    Contact contact;
    contact.ids      = {4};
    contact.obstacle = &obstacle;
    return contact;
  }
} // namespace

TEST(FacesOnObstacle, ContactsStandAtCornersOfTetrahedra)
{
  const auto body =
    make_body(3, cube, "Young modulus = 5|Poisson ratio = 0.3", "P2");
  const Obstacle obstacle =
    make_obstacle("Shape = half space|Normal = 0, 0, 1", 3);
  const Contact     contact = bottom_on(obstacle);
  const PairedNodes found   = pair_nodes_with_faces(contact, {body.get()});
  EXPECT_EQ(found.nodes.size(), 5u); // corners and the middle of a side
  double area = 0;
  for (const ContactNode &node : found.nodes)
    {
      double       sum = 0;
      Tensor<1, 3> mean;
      for_each_slave(node, [&](const unsigned int i, const double weight) {
        sum += weight;
        mean += weight * Tensor<1, 3>(body->position(i));
      });
      EXPECT_NEAR(sum, 1, 1e-14);
      // functions that are dual to linear ones keep these
      EXPECT_NEAR((mean - Tensor<1, 3>(node.position)).norm(), 0, 1e-14);
      EXPECT_NEAR(node.gap, 0, 1e-15);
      EXPECT_GT(node.area, 0);
      area += node.area;
    }
  EXPECT_NEAR(area, 1, 1e-14);
}

TEST(FacesOnObstacle, WeightsAreThoseOfDualFunctions)
{
  const auto body =
    make_body(3, cube, "Young modulus = 5|Poisson ratio = 0.3", "P2");
  const Obstacle obstacle =
    make_obstacle("Shape = half space|Normal = 0, 0, 1", 3);
  const Contact         contact = bottom_on(obstacle);
  const bodies::Surface surface = body->surface({4});
  const FacesOnObstacle faces(contact, *body, surface);
  EXPECT_TRUE(FacesOnObstacle::suits(surface));
  EXPECT_FALSE(faces.has(surface.faces[0].nodes[3]));
  for (const bodies::SurfaceNode &s : surface.nodes)
    if (faces.has(s.node))
      {
        ContactNode node;
        node.node     = s.node;
        node.position = s.position;
        node.spacing  = 1;
        faces.place(node);
        for_each_slave(node, [&](const unsigned int i, const double weight) {
          if (i == s.node)
            {
              EXPECT_NEAR(weight, .6, 1e-14); // 3/5
            }
        });
      }
}

TEST(FacesOnObstacle, GapsAreMeansOverFaces)
{
  const auto body =
    make_body(3, cube, "Young modulus = 5|Poisson ratio = 0.3", "P2");
  const Obstacle obstacle =
    make_obstacle("Shape = prescribed gap|Normal = 0, 0, 1|Gap = 2*x - y + 3",
                  3);
  const Contact     contact = bottom_on(obstacle);
  const PairedNodes found   = pair_nodes_with_faces(contact, {body.get()});
  for (const ContactNode &node : found.nodes)
    EXPECT_NEAR(node.gap, 2 * node.position[0] - node.position[1] + 3, 1e-13);
}
