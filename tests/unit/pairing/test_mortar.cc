// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/facing_parts.h"
#include "conetact/pairing/mortar.h"

// Boost would move points to a grid of 1e-7 of the box around them
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <map>

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
    contact.pairing    = "mortar";
    return contact;
  }

  PairedNodes
  pair(const Structure &slave, const Structure &master)
  {
    return pair_by_mortar(joint(slave, master), {&slave, &master});
  }

  std::string
  block(const std::string &cells,
        const std::string &low,
        const std::string &high,
        const std::string &more = "")
  {
    return "Generator = subdivided_hyper_rectangle|Arguments = " + cells +
           " : " + low + " : " + high + " : true" + more;
  }

  /** What forces of size area at all nodes, a pressure of 1, do to a side. */
  struct Side
  {
    std::map<unsigned int, double> forces; ///< of nodes
    double
    sum() const
    {
      double s = 0;
      for (const auto &[node, force] : forces)
        s += force;
      return s;
    }
  };
  std::pair<Side, Side>
  press(const PairedNodes &found)
  {
    std::pair<Side, Side> sides;
    for (const ContactNode &node : found.nodes)
      for_each_side(node,
                    [&](const unsigned int body,
                        const unsigned int i,
                        const double       weight) {
                      Side &side = body == 0 ? sides.first : sides.second;
                      side.forces[i] += std::abs(node.area) * weight;
                    });
    return sides;
  }

  /** Joints that are plane and closed: gaps and levers vanish. */
  void
  expect_plane_and_closed(const PairedNodes &found,
                          const Structure   &slave,
                          const Structure   &master)
  {
    for (const ContactNode &node : found.nodes)
      {
        EXPECT_NEAR(node.gap, 0, 1e-11);
        Tensor<1, 3> lever;
        double       sum = 0, size = 0;
        for_each_side(node,
                      [&](const unsigned int body,
                          const unsigned int i,
                          const double       weight) {
                        const Structure &side = body == 0 ? slave : master;
                        lever += weight * (side.position(i) - node.position);
                        sum += weight;
                        size += std::abs(weight);
                      });
        EXPECT_LT(lever.norm(), 1e-11 * size);
        EXPECT_NEAR(sum, 0, 1e-12 * size);
        EXPECT_LT(size, 60);
      }
  }
} // namespace



TEST(Mortar, SegmentsByHand)
{
  // slave [0, 2] in two, master [0, 2] in one: D = 1/2, 1, 1/2
  const Body low     = test::make_body(2, block("1, 1", "0, 0", "2, 1"));
  const Body high    = test::make_body(2, block("2, 1", "0, 1", "2, 2"));
  Contact    contact = joint(*high, *low);
  contact.ids        = {2};
  contact.master_ids = {3};
  const auto found   = pair_by_mortar(contact, {high.get(), low.get()});
  ASSERT_EQ(found.nodes.size(), 3u);
  EXPECT_EQ(found.n_nodes, 3u);
  EXPECT_EQ(found.n_paired, 3u);
  for (const ContactNode &node : found.nodes)
    {
      const double x = node.position[0];
      EXPECT_NEAR(node.area, x == 1 ? 1 : .5, 1e-14);
      EXPECT_NEAR(node.n[1], 1, 1e-14);
      EXPECT_TRUE(node.slaves.empty());
      for (const auto &[master, weight] : node.masters)
        EXPECT_NEAR(weight,
                    low->position(master)[0] == 0 ? 1 - x / 2 : x / 2,
                    1e-14);
    }
  // exchanged: psi = 2 N_1 - N_2 and 2 N_2 - N_1 on [0, 2], against hats
  contact            = joint(*low, *high);
  contact.ids        = {3};
  contact.master_ids = {2};
  for (const ContactNode &node :
       pair_by_mortar(contact, {low.get(), high.get()}).nodes)
    for (const auto &[master, weight] : node.masters)
      {
        const double away =
          std::abs(high->position(master)[0] - node.position[0]);
        // psi = 2 - 3 s/2 at distance s, D = 1: integrals with the hats
        const double expected = away == 0 ? 1 - .25 : away == 1 ? .5 : -.25;
        EXPECT_NEAR(weight, expected, 1e-14);
      }
}



TEST(Mortar, MatchingMeshesPairNodeByNode)
{
  for (const unsigned int dim : {2u, 3u})
    {
      const Body low =
        test::make_body(dim,
                        dim == 2 ? block("4, 3", "-1, -1", "1, 1") :
                                   block("3, 4, 2", "-1, -1, -1", "1, 1, 1"));
      const Body high = test::make_body(
        dim,
        dim == 2 ? block("4, 3", "-1, -1", "1, 1", "|Translation = 0, 2.5") :
                   block("3, 4, 2",
                         "-1, -1, -1",
                         "1, 1, 1",
                         "|Translation = 0, 0, 2.5"));
      const auto found = pair(*high, *low);
      EXPECT_EQ(found.nodes.size(), dim == 2 ? 5u : 20u);
      for (const ContactNode &node : found.nodes)
        {
          ASSERT_EQ(node.masters.size(), 1u);
          EXPECT_NEAR(node.gap, .5, 1e-13);
          EXPECT_NEAR(node.n[dim - 1], 1, 1e-14);
          EXPECT_NEAR(
            low->position(node.masters[0].first).distance(node.position),
            .5,
            1e-13);
        }
    }
}



TEST(Mortar, AConstantPressurePassesTurnedAndPartlyCoveredFaces)
{
  namespace bg = boost::geometry;
  using P      = bg::model::d2::point_xy<double>;
  bg::model::polygon<P, false> own;
  for (const auto &[x, y] :
       {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
    bg::append(own.outer(), P(x, y));
  bg::correct(own);
  const Body low =
    test::make_body(3, block("5, 4, 1", "-1, -1, -1", "1, 1, 0"));
  for (const double angle : {0., 7., 22.5, 30., 45.})
    for (const double shift : {0., .3, .97})
      {
        const std::string move =
          "|Rotation = 0, 0, 1, " + std::to_string(angle) +
          "|Translation = " + std::to_string(shift) + ", 0.1, 0";
        const Body high =
          test::make_body(3, block("3, 7, 1", "-1, -1, 0", "1, 1, 1", move));
        bg::model::polygon<P, false> other;
        const double                 c = std::cos(angle * M_PI / 180),
                     s                 = std::sin(angle * M_PI / 180);
        for (const auto &[x, y] :
             {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
          bg::append(other.outer(),
                     P(c * x - s * y + shift, s * x + c * y + .1));
        bg::correct(other);
        std::vector<bg::model::polygon<P, false>> both;
        bg::intersection(own, other, both);
        for (const bool exchanged : {false, true})
          {
            const Structure &slave           = exchanged ? *low : *high;
            const Structure &master          = exchanged ? *high : *low;
            const auto       found           = pair(slave, master);
            const auto [on_slave, on_master] = press(found);
            EXPECT_NEAR(on_slave.sum(), bg::area(both[0]), 1e-12);
            EXPECT_NEAR(on_master.sum(), -bg::area(both[0]), 1e-12);
            expect_plane_and_closed(found, slave, master);
          }
      }
}



TEST(Mortar, CoveredFacesCarryTheirWholeAreaAlsoDistortedOnes)
{
  const Body low =
    test::make_body(3, "File = " + test::write_distorted_mesh(3, 4));
  const Body high = test::make_body(3, block("3, 5, 1", "0, 0, 1", "1, 1, 2"));
  for (const bool exchanged : {false, true})
    {
      const Structure &slave  = exchanged ? *low : *high;
      const Structure &master = exchanged ? *high : *low;
      const auto       found  = pair(slave, master);
      expect_plane_and_closed(found, slave, master);
      const auto sides = press(found);
      const auto check = [](const Structure &body, const Side &side) {
        for (const SurfaceNode &node : body.surface(body.boundary_ids()).nodes)
          {
            const auto found_force = side.forces.find(node.node);
            if (found_force == side.forces.end())
              continue;
            double share = 0;
            // a face at a time: rims belong to other sides of the block, too
            for (const SurfaceFace &face :
                 body.surface(body.boundary_ids()).faces)
              if (std::abs(face.normal[2]) > .99 &&
                  std::abs(body.position(face.nodes[0])[2] - 1) < 1e-9)
                for (std::size_t i = 0; i < 4; ++i)
                  if (face.nodes[i] == node.node)
                    {
                      const auto x = [&](const std::size_t k) {
                        return body.position(face.nodes[k]);
                      };
                      for (const double a :
                           {.5 - std::sqrt(1. / 12), .5 + std::sqrt(1. / 12)})
                        for (const double b :
                             {.5 - std::sqrt(1. / 12), .5 + std::sqrt(1. / 12)})
                          {
                            const auto gx =
                              (1 - b) * (x(1) - x(0)) + b * (x(3) - x(2));
                            const auto gy =
                              (1 - a) * (x(2) - x(0)) + a * (x(3) - x(1));
                            const double N =
                              (i % 2 ? a : 1 - a) * (i / 2 ? b : 1 - b);
                            share += .25 * N * cross_product_3d(gx, gy).norm();
                          }
                    }
            EXPECT_NEAR(std::abs(found_force->second), share, 1e-11);
          }
      };
      check(slave, sides.first);
      check(master, sides.second);
    }
}



TEST(Mortar, DistortedFacesCoverEachOtherOnce)
{
  const Body low =
    test::make_body(3, "File = " + test::write_distorted_mesh(3, 4));
  const Body high = test::make_body(
    3, "File = " + test::write_distorted_mesh(3, 5) + "|Translation = 0, 0, 1");
  Contact contact = joint(*high, *low);
  contact.ids     = high->boundary_ids();
  const MasterSurface master(*low, low->boundary_ids());
  const FacingParts   facing(master);
  const FaceNet       slave(*high, high->surface(high->boundary_ids()));
  for (const FaceNet::Face &face : slave.all())
    if (face.outward[2] < -.99)
      {
        const ProjectionPlane plane(face.centre, face.outward, false);
        const ProjectedFace   own(face.corners, plane);
        double                sum = 0;
        const auto            parts =
          facing.seen_from(face, plane, own, {10, .9, .1, true});
        for (const auto &part : parts)
          sum += measure(part.where);
        EXPECT_NEAR(sum, measure(own.outline()), 1e-12);
      }
}



TEST(Mortar, SmallCoversGoToNeighbours)
{
  // the master ends 1e-4 of a face beyond a slave node
  const Body low   = test::make_body(2, block("3, 1", "0, 0", "1.00001, 1"));
  const Body high  = test::make_body(2, block("20, 1", "0, 1", "2, 2"));
  const auto found = pair(*high, *low);
  bool       seen  = false;
  EXPECT_EQ(found.nodes.size(), 11u);
  for (const ContactNode &node : found.nodes)
    seen = seen || node.slaves.size() == 2;
  EXPECT_TRUE(seen);
  expect_plane_and_closed(found, *high, *low);
  const auto [on_slave, on_master] = press(found);
  EXPECT_NEAR(on_slave.sum(), 1.00001, 1e-12);
  EXPECT_NEAR(on_slave.forces.at(
                std::max_element(on_slave.forces.begin(),
                                 on_slave.forces.end(),
                                 [&](const auto &a, const auto &b) {
                                   return high->position(a.first)[0] <
                                          high->position(b.first)[0];
                                 })
                  ->first),
              .5 * 1e-5 * 1e-4,
              1e-14);
}



TEST(Mortar, HangingSlaveNodesGiveTheirFunctions)
{
  const Body low = test::make_body(3, block("3, 3, 1", "0, 0, 0", "1, 1, 1"));
  const Body high =
    test::make_body(3,
                    block("2, 2, 1",
                          "0, 0, 1",
                          "1, 1, 2",
                          "|Refinement boxes = 0, 0, 1 : 0.4, 0.4, 1.4 : 1"));
  ASSERT_FALSE(high->hanging_nodes().empty());
  const auto found = pair(*high, *low);
  expect_plane_and_closed(found, *high, *low);
  EXPECT_NEAR(press(found).first.sum(), 1, 1e-12);
}



TEST(Mortar, NearestOfTwoShelvesAndNothingThroughABody)
{
  // boxes above one another as one master: boundaries of a block below and
  // one above the slave, which looks down
  const Body low  = test::make_body(2, block("4, 4", "0, 0", "1, 1"));
  const Body high = test::make_body(2, block("3, 3", "0, 1.1", "1, 2"));
  for (const ContactNode &node : pair(*high, *low).nodes)
    {
      EXPECT_NEAR(node.gap, .1, 1e-13);
      EXPECT_NEAR(node.n[1], 1, 1e-13);
    }
  EXPECT_EQ(pair(*high, *low).n_paired, 4u);
  EXPECT_EQ(pair(*low, *high).n_paired, 5u);
}
