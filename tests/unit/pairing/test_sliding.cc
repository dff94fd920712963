// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/displaced.h"
#include "conetact/pairing/sliding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::pairing;
using namespace conetact::test;

namespace
{
  std::string
  block(const std::string &name,
        const std::string &arguments,
        const std::string &held = "3")
  {
    return "subsection Body " + name + "\n" +
           section("Mesh",
                   "Generator = subdivided_hyper_rectangle|Arguments = " +
                     arguments) +
           section("Material", "Young modulus = 1000|Poisson ratio = 0.3") +
           "end\n" +
           section("Support " + name,
                   "Body = " + name + "|Boundary ids = " + held +
                     "|Directions = x, y");
  }

  /** A block over a disc of radius 3 below the origin. */
  std::unique_ptr<Scene>
  over_disc()
  {
    return make_scene(
      "set Bodies = block\nset Obstacles = disc\nset Contacts = bottom\n"
      "set Supports = block\n" +
      block("block", "4, 2 : 0, 0 : 2, 1 : true") +
      section(
        "Obstacle disc",
        "Shape = cylinder|Radius = 3|Point = 0, -3|Displacement = t ; 0") +
      section("Contact bottom",
              "Body = block|Boundary ids = 2|Obstacle = disc|"
              "Kinematics = finite sliding"));
  }

  /** A block of four faces on a slab of ten, y = 0 where they meet. */
  std::unique_ptr<Scene>
  over_slab(const std::string &pairing)
  {
    return make_scene(
      "set Bodies = block, slab\nset Contacts = bottom\n"
      "set Supports = block, slab\n" +
      block("block", "4, 2 : 0, 0 : 2, 1 : true") +
      block("slab", "10, 1 : 0, -1 : 5, 0 : true", "2") +
      section("Contact bottom",
              "Body = block|Boundary ids = 2|Master body = slab|"
              "Master boundary ids = 3|Kinematics = finite sliding|Pairing = " +
                pairing));
  }

  std::vector<ContactNode>
  found(const Scene &scene, const Tensor<1, 3> &u_of_first, const double t)
  {
    const SlidingContacts    contacts = scene.sliding_contacts();
    std::vector<ContactNode> nodes =
      contacts
        .find(
          scene.bodies.contact_nodes,
          [&](const unsigned int body, const unsigned int) {
            return body == 0 ? u_of_first : Tensor<1, 3>();
          },
          t)
        .nodes;
    contacts.linearise(nodes);
    return nodes;
  }
} // namespace

TEST(Sliding, AnObstacleIsMetWhereNodesAre)
{
  const auto         scene = over_disc();
  const Tensor<1, 3> u({-.7, .3, 0.}), d({2., 0., 0.});
  const auto         nodes = found(*scene, u, 2);
  ASSERT_EQ(nodes.size(), 5u);
  for (const ContactNode &node : nodes)
    {
      const Tensor<1, 3> arm = node.position + u - d - Point<3>(0, -3, 0);
      EXPECT_NEAR(node.gap + node.n * (u - d), arm.norm() - 3, 1e-14);
      EXPECT_NEAR((node.n - arm / arm.norm()).norm(), 0, 1e-14);
      EXPECT_NEAR(node.n * node.t1, 0, 1e-15);
    }
}

TEST(Sliding, AMasterIsMetWhereNodesAre)
{
  const Tensor<1, 3> u({1.3, .01, 0.});
  for (const std::string pairing : {"node to face", "mortar"})
    {
      const auto scene = over_slab(pairing);
      const auto nodes = found(*scene, u, 1);
      ASSERT_EQ(nodes.size(), scene->bodies.contact_nodes.size());
      for (const ContactNode &node : nodes)
        {
          Tensor<1, 3> apart; // of the two sides where they are
          for_each_side(node,
                        [&](const unsigned int body,
                            const unsigned int i,
                            const double       weight) {
                          apart +=
                            weight *
                            (scene->bodies.structures[body]->position(i) -
                             node.position + (body == 0 ? u : Tensor<1, 3>()));
                        });
          EXPECT_NEAR(apart[0], 0, 1e-12) << pairing;
          EXPECT_NEAR(apart[1], .01, 1e-12) << pairing;
          EXPECT_NEAR(node.gap + node.n * u, .01, 1e-12) << pairing;
        }
    }
}

TEST(Sliding, WhatFindsNothingIsFarFromIt)
{
  for (const std::string pairing : {"node to face", "mortar"})
    {
      const auto scene = over_slab(pairing);
      const auto nodes = found(*scene, Tensor<1, 3>({9., 0., 0.}), 1);
      ASSERT_EQ(nodes.size(), scene->bodies.contact_nodes.size());
      for (const ContactNode &node : nodes)
        {
          EXPECT_TRUE(node.meets_nothing()) << pairing;
          EXPECT_GT(node.gap + node.n * node.moved, 1) << pairing;
        }
    }
}

TEST(Displaced, NormalsTurnWithNodes)
{
  for (const unsigned int dim : {2u, 3u})
    {
      const auto body = make_body(
        dim,
        dim == 2 ?
          "Generator = hyper_cube|Arguments = 0 : 1 : true|Global refinements = 1" :
          "Generator = subdivided_hyper_cube_with_simplices|Arguments = 2 : 0 : 1 : true",
        "Young modulus = 5|Poisson ratio = 0.3",
        "automatic");
      const double c = std::cos(.4), s = std::sin(.4);
      const auto   turn = [&](const Tensor<1, 3> &v) {
        return Tensor<1, 3>({c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]});
      };
      std::vector<Tensor<1, 3>> u;
      for (unsigned int i = 0; i < body->n_nodes(); ++i)
        {
          const Tensor<1, 3> x = body->position(i);
          u.push_back(turn(x) - x);
        }
      const Displaced turned(*body, u);
      const Surface   a = body->surface(body->boundary_ids());
      const Surface   b = turned.surface(body->boundary_ids());
      for (std::size_t f = 0; f < a.faces.size(); ++f)
        EXPECT_NEAR((turn(a.faces[f].normal) - b.faces[f].normal).norm(),
                    0,
                    1e-14);
      for (std::size_t i = 0; i < a.nodes.size(); ++i)
        EXPECT_EQ(a.nodes[i].normals.size(), b.nodes[i].normals.size());
    }
}
