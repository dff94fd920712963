// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/face_net.h"

#include <random>

#include "body_fixture.h"

using namespace conetact;
using namespace conetact::bodies;
using namespace conetact::pairing;

namespace
{
  using Body = std::unique_ptr<Structure>;

  Contact
  joint(const Structure &slave, const Structure &master)
  {
    Contact contact;
    contact.name       = "joint";
    contact.ids        = slave.boundary_ids();
    contact.master     = 1;
    contact.master_ids = master.boundary_ids();
    contact.reach      = 100;
    contact.friction   = std::make_shared<FrictionLaw>("0", "", "", "test");
    contact.prestress.emplace("0", "test");

    return contact;
  }

  ContactNodes
  pair(const unsigned int dim,
       const Structure   &slave,
       const Structure   &master,
       Contact            contact)
  {
    std::vector<Contact> contacts;
    contacts.push_back(std::move(contact));
    return find_contact_nodes(contacts,
                              {"slave", "master"},
                              {&slave, &master},
                              dim);
  }

  ContactNodes
  pair(const unsigned int dim, const Structure &slave, const Structure &master)
  {
    return pair(dim, slave, master, joint(slave, master));
  }

  /** Distance from the boundary, face by face. */
  double
  distance(const Structure &body, const Point<3> &p)
  {
    double least = 1e100;
    for (const SurfaceFace &face : body.surface(body.boundary_ids()).faces)
      {
        std::vector<Point<3>> corners;
        for (const unsigned int node : face.nodes)
          corners.push_back(body.position(node));
        least = std::min(least, closest_point(corners, p).distance);
      }
    return least;
  }

  std::string
  turned(const unsigned int dim, std::mt19937 &random)
  {
    std::normal_distribution<double> normal;
    const auto number = [&] { return std::to_string(normal(random)); };
    return dim == 2 ? "|Rotation = " + std::to_string(180 * normal(random)) :
                      "|Rotation = " + number() + ", " + number() + ", " +
                        number() + ", " + std::to_string(90 * normal(random));
  }

  std::string
  moved(const unsigned int dim, const double x)
  {
    return "|Translation = " + std::to_string(x) +
           (dim == 2 ? ", 0" : ", 0, 0");
  }

  const std::string blocks[] = {
    "Generator = subdivided_hyper_rectangle|Arguments = 4, 3 : -1, -1 : 1, 1 : true",
    "Generator = subdivided_hyper_rectangle|"
    "Arguments = 3, 4, 2 : -1, -1, -1 : 1, 1, 1 : true"};
  const std::string balls[] = {
    "Generator = hyper_ball|Arguments = 0, 0 : 1 : false|Global refinements = 2",
    "Generator = hyper_ball|Arguments = 0, 0, 0 : 1 : false|Global refinements = 2"};

  /** Gaps are open, and those of a brute-force search where bodies are convex.
   */
  void
  expect_apart(const unsigned int dim,
               const Structure   &slave,
               const Structure   &master,
               const std::string &what)
  {
    const ContactNodes found = pair(dim, slave, master);
    for (const ContactNode &node : found.nodes)
      {
        EXPECT_GT(node.gap, 0) << what;
        // a node may overhang a sharp edge by a hundredth of the face
        EXPECT_NEAR(node.gap, distance(master, node.position), 1e-4) << what;
        Tensor<1, 3> foot;
        for (const auto &[n, weight] : node.masters)
          foot += weight * Tensor<1, 3>(master.position(n));
        EXPECT_LT(
          (Tensor<1, 3>(node.position) - node.gap * node.n - foot).norm(), .01)
          << what;
      }
  }
} // namespace



TEST(PairingBodies, ConvexOnesBesideEachOther)
{
  std::mt19937 random(7);
  for (const unsigned int dim : {2u, 3u})
    for (unsigned int trial = 0; trial < 12; ++trial)
      {
        const auto &shape = trial % 2 == 0 ? blocks : balls;
        const Body  slave =
          test::make_body(dim, shape[dim - 2] + turned(dim, random));
        const Body master = test::make_body(
          dim, blocks[dim - 2] + turned(dim, random) + moved(dim, 3.8));
        expect_apart(dim, *slave, *master, "block " + std::to_string(trial));
        expect_apart(dim, *master, *slave, "turned " + std::to_string(trial));
      }
}



TEST(PairingBodies, ABallInsideALargerShell)
{
  std::mt19937      random(3);
  const std::string shells[] = {
    "Generator = hyper_shell|Arguments = 0, 0 : 1.5 : 2 : 12 : true",
    "Generator = hyper_shell|Arguments = 0, 0, 0 : 1.5 : 2 : 6 : true|"
    "Global refinements = 2"};
  for (const unsigned int dim : {2u, 3u})
    for (unsigned int trial = 0; trial < 4; ++trial)
      {
        const Body ball =
          test::make_body(dim, balls[dim - 2] + turned(dim, random));
        const Body shell = test::make_body(
          dim, shells[dim - 2] + turned(dim, random) + moved(dim, .1 * trial));
        const ContactNodes found = pair(dim, *ball, *shell);
        EXPECT_EQ(found.pairings[0].n_paired, found.pairings[0].n_nodes);
        for (const ContactNode &node : found.nodes)
          {
            EXPECT_GT(node.gap, .05);
            EXPECT_NEAR(node.gap, distance(*shell, node.position), 1e-9);
            EXPECT_LT(node.n * node.position, 0); // inward
          }
        // and the shell's inner side on the ball; its outer side is free
        for (const ContactNode &node : pair(dim, *shell, *ball).nodes)
          {
            EXPECT_NEAR(node.gap, distance(*ball, node.position), 1e-9);
            EXPECT_LT(node.gap, .9);
          }
      }
}



TEST(PairingBodies, StackedBlocksWithAllBoundaries)
{
  for (const unsigned int dim : {2u, 3u})
    {
      const std::string up =
        dim == 2 ? "|Translation = 0, " : "|Translation = 0, 0, ";
      const Body low = test::make_body(dim, blocks[dim - 2]);
      for (const double gap : {0., .01, 1.})
        {
          const Body high =
            test::make_body(dim,
                            blocks[dim - 2] + up + std::to_string(2 + gap));
          const auto found = pair(dim, *high, *low);
          EXPECT_EQ(found.pairings[0].n_paired, dim == 2 ? 5u : 20u);
          for (const ContactNode &node : found.nodes)
            {
              EXPECT_NEAR(node.gap, gap, 1e-12);
              EXPECT_NEAR(node.n[dim - 1], 1, 1e-12);
            }
        }
    }
}



TEST(PairingBodies, WiderAndNarrowerThanTheirMaster)
{
  for (const unsigned int dim : {2u, 3u})
    for (const bool all : {false, true})
      {
        const std::string shift =
          dim == 2 ? "|Translation = 0, 2" : "|Translation = 0, 0, 2";
        const Body low = test::make_body(dim, blocks[dim - 2]);
        const Body wide =
          test::make_body(dim,
                          dim == 2 ?
                            "Generator = subdivided_hyper_rectangle|"
                            "Arguments = 16, 2 : -2, -1 : 2, 1 : true" +
                              shift :
                            "Generator = subdivided_hyper_rectangle|Arguments "
                            "= 16, 4, 2 : -2, -1, -1 : 2, 1, 1 : true" +
                              shift);
        const unsigned int bottom = 2 * dim - 2, top = bottom + 1;
        const Body         tagged = test::make_body(
          dim,
          (dim == 2 ? "Generator = subdivided_hyper_rectangle|Arguments = 4, 3 "
                              ": -1, -1 : 1, 1 : true" :
                              "Generator = subdivided_hyper_rectangle|Arguments = 3, "
                              "4, 2 : -1, -1, -1 : 1, 1, 1 : true"));
        Contact contact = joint(*wide, *tagged);
        if (!all)
          {
            contact.ids        = {bottom};
            contact.master_ids = {top};
          }
        const auto over = pair(dim, *wide, *tagged, std::move(contact));
        EXPECT_EQ(over.pairings[0].n_paired, dim == 2 ? 9u : 45u);
        contact = joint(*tagged, *wide);
        if (!all)
          {
            contact.ids        = {top};
            contact.master_ids = {bottom};
          }
        const auto under = pair(dim, *tagged, *wide, std::move(contact));
        EXPECT_EQ(under.pairings[0].n_paired, dim == 2 ? 5u : 20u);
        for (const auto *found : {&over, &under})
          for (const ContactNode &node : found->nodes)
            {
              EXPECT_NEAR(std::abs(node.n[dim - 1]), 1, 1e-12);
              EXPECT_NEAR(node.gap, 0, 1e-12);
            }
      }
}



TEST(PairingBodies, DeepInterferenceIsRefused)
{
  const Body low  = test::make_body(2, blocks[0]);
  const auto high = [&](const std::string &height) {
    return test::make_body(2, blocks[0] + "|Translation = 0.1, " + height);
  };
  EXPECT_LT(pair(2, *high("1.9"), *low).pairings[0].least_gap, -.09);
  const Body deep = high("1.5");
  try
    {
      pair(2, *deep, *low);
      FAIL() << "no error";
    }
  catch (const InputError &error)
    {
      const std::string text = error.what();
      for (const char *part : {"Contact 'joint'",
                               "'slave' starts 0.5 deep",
                               "Largest interference of at least 0.5"})
        EXPECT_NE(text.find(part), text.npos) << text;
    }
  Contact press_fit      = joint(*deep, *low);
  press_fit.interference = .51;
  EXPECT_NEAR(pair(2, *deep, *low, std::move(press_fit)).pairings[0].least_gap,
              -.5,
              1e-12);
  Contact stated = joint(*deep, *low);
  stated.gap.emplace("-1", "test");
  EXPECT_EQ(pair(2, *deep, *low, std::move(stated)).pairings[0].least_gap, -1);
}



TEST(PairingBodies, FacetsOfCurvedSurfacesMayOverlap)
{
  // a ring in a ring, meshes that do not match
  for (const unsigned int inner : {8u, 12u, 13u})
    for (const unsigned int outer : {8u, 11u, 16u})
      {
        const auto ring = [](const std::string &radii, const unsigned int n) {
          return test::make_body(2,
                                 "Generator = hyper_shell|Arguments = 0, 0 : " +
                                   radii + " : " + std::to_string(n) +
                                   " : true");
        };
        const Body small = ring("1 : 2", inner), large = ring("2 : 3", outer);
        Contact    contact = joint(*small, *large);
        contact.ids        = {1};
        contact.master_ids = {0};
        const auto found   = pair(2, *small, *large, std::move(contact));
        EXPECT_EQ(found.pairings[0].n_paired, inner);
        EXPECT_LE(found.pairings[0].largest_gap, 1e-9);
      }
}



TEST(PairingSupports, EdgesHaveANormalForEachFace)
{
  const Body cube =
    test::make_body(3,
                    "Generator = subdivided_hyper_rectangle|"
                    "Arguments = 2, 2, 2 : 0, 0, 0 : 1, 1, 1 : true|"
                    "Refinement boxes = 0, 0, 0 : 0.4, 0.4, 0.4 : 1");
  for (const SurfaceNode &node : cube->surface({0, 2, 4}).nodes)
    {
      std::size_t n_planes = 0;
      for (unsigned int d = 0; d < 3; ++d)
        if (std::abs(node.position[d]) < 1e-12)
          {
            ++n_planes;
            double along = 0;
            for (const Tensor<1, 3> &n : node.normals)
              along = std::max(along, -n[d]);
            EXPECT_NEAR(along, 1, 1e-14) << node.position;
          }
      EXPECT_EQ(node.normals.size(), n_planes) << node.position;
    }
}



TEST(PairingSupports, SmoothSurfacesHaveOneNormal)
{
  const Body ball = test::make_body(3, balls[1]);
  for (const SurfaceNode &node : ball->surface({0}).nodes)
    {
      ASSERT_EQ(node.normals.size(), 1u);
      EXPECT_LT((node.normals[0] - node.normal).norm(), 1e-14);
    }
  // ten facets are smooth, eight are a polygon
  const auto tube = [](const unsigned int n) {
    return test::make_body(2,
                           "Generator = hyper_shell|Arguments = 0, 0 : 1 : 2 "
                           ": " +
                             std::to_string(n) + " : true");
  };
  EXPECT_EQ(tube(10)->surface({1}).nodes[0].normals.size(), 1u);
  EXPECT_EQ(tube(8)->surface({1}).nodes[0].normals.size(), 2u);
}
