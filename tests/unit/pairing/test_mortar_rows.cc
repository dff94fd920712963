// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/mortar_rows.h"

#include <numeric>

#include "faces_only.h"

using namespace conetact;
using namespace conetact::pairing;
using bodies::HangingNode;

namespace
{
  constexpr double sharp = 2 * M_PI / 9;

  std::vector<FaceNet::Face>
  faces_of(const test::FacesOnly &body)
  {
    return FaceNet(body, body.surface(body.boundary_ids())).all();
  }

  /** A strip of n faces along x. */
  test::FacesOnly
  strip(const unsigned int n)
  {
    std::vector<Point<3>>              points;
    std::vector<test::FacesOnly::Face> faces;
    for (unsigned int i = 0; i <= n; ++i)
      points.emplace_back(i, 0, 0);
    for (unsigned int i = 0; i < n; ++i)
      faces.push_back({{i, i + 1}, 0});
    return test::FacesOnly(points, faces, false);
  }

  /** A face meets a master node with half of an area at each corner. */
  void
  cover(MortarRows        &rows,
        const std::size_t  face,
        const double       area,
        const unsigned int master)
  {
    for (const std::size_t c : {0u, 1u})
      {
        MortarRow &row = rows.at(face, c);
        row.area += area / 2;
        row.slaves[row.node] += area / 2;
        row.masters[master] += area / 2;
      }
    rows.join(face);
  }

  struct Totals
  {
    double                         area = 0;
    std::map<unsigned int, double> slaves, masters;
    explicit Totals(const MortarRows &rows)
    {
      for (const MortarRow &row : rows.all())
        if (row.area > 0)
          {
            area += row.area;
            for (const auto &[node, integral] : row.slaves)
              slaves[node] += integral;
            for (const auto &[node, integral] : row.masters)
              masters[node] += integral;
          }
    }
  };

  void
  expect_same(const std::map<unsigned int, double> &a,
              const std::map<unsigned int, double> &b)
  {
    ASSERT_EQ(a.size(), b.size());
    for (const auto &[node, integral] : a)
      EXPECT_NEAR(b.at(node), integral, 1e-15) << node;
  }
} // namespace



TEST(MortarRows, ANodeHasARowOnEachSideOfASharpEdge)
{
  const test::FacesOnly       body = test::cube(2);
  const MortarRows            rows(faces_of(body), sharp);
  std::map<unsigned int, int> n_rows;
  double                      area = 0;
  Tensor<1, 3>                sum;
  for (const MortarRow &row : rows.all())
    {
      ++n_rows[row.node];
      area += row.whole;
      sum += row.normal;
      EXPECT_NEAR(row.normal.norm(), row.whole, 1e-15); // of plane faces
    }
  EXPECT_NEAR(area, 6, 1e-14);
  EXPECT_LE(sum.norm(), 1e-14); // a closed surface
  for (unsigned int i = 0; i < body.n_nodes(); ++i)
    {
      int n_sides = 0;
      for (unsigned int d = 0; d < 3; ++d)
        n_sides += body.position(i)[d] != .5;
      EXPECT_EQ(n_rows[i], n_sides);
    }
}



TEST(MortarRows, EdgesAreSharpFromAnAngleOn)
{
  const std::vector<FaceNet::Face> faces = faces_of(test::cube(1));
  EXPECT_EQ(MortarRows(faces, sharp).all().size(), 24u);
  // 90 degrees are none from there on: one row at each corner
  const MortarRows smooth(faces, M_PI / 2 + .01);
  ASSERT_EQ(smooth.all().size(), 8u);
  for (const MortarRow &row : smooth.all())
    {
      EXPECT_NEAR(row.whole, .75, 1e-15);
      EXPECT_NEAR(row.normal.norm(), .25 * std::sqrt(3.), 1e-15);
    }
}



// a chain of small turns is one side, though its ends look elsewhere
TEST(MortarRows, NeighboursOfNeighboursAreOnTheSameSide)
{
  // a pyramid with 12 sides that look up as much as outward
  std::vector<FaceNet::Face> faces;
  for (unsigned int i = 0; i < 12; ++i)
    {
      const double  a = i * M_PI / 6, b = a + M_PI / 6, middle = a + M_PI / 12;
      FaceNet::Face face;
      face.nodes   = {0, 1 + i, 1 + (i + 1) % 12};
      face.corners = {Point<3>(0, 0, 1),
                      Point<3>(std::cos(a), std::sin(a), 0),
                      Point<3>(std::cos(b), std::sin(b), 0)};
      face.outward =
        Tensor<1, 3>({std::cos(middle), std::sin(middle), 1}) / std::sqrt(2.);
      face.n_functions = 3;
      faces.push_back(face);
    }
  const MortarRows rows(faces, sharp);
  std::size_t      n_at_top = 0;
  for (const MortarRow &row : rows.all())
    n_at_top += row.node == 0;
  EXPECT_EQ(n_at_top, 1u);
  EXPECT_EQ(rows.all().size(), 13u);
}



TEST(MortarRows, FacesMakeTheirRowsNeighbours)
{
  MortarRows rows(faces_of(strip(3)), sharp);
  rows.join(0);
  rows.join(1);
  ASSERT_EQ(rows.all().size(), 4u);
  std::vector<std::size_t> n_neighbours;
  for (const MortarRow &row : rows.all())
    n_neighbours.push_back(row.neighbours.size());
  EXPECT_EQ(n_neighbours, (std::vector<std::size_t>{1, 2, 1, 0}));
}



TEST(MortarRows, WhoIsBeyondTheRimGivesToWhoFacesTheMaster)
{
  MortarRows rows(faces_of(strip(3)), sharp);
  cover(rows, 0, 1, 10);
  cover(rows, 1, .4, 11);
  for (const std::size_t c : {0u, 1u}) // node 2 is beyond the rim
    rows.at(0, c).kept = true;
  const Totals before(rows);
  rows.give_up_beyond_rims();
  const Totals after(rows);
  EXPECT_EQ(rows.all()[2].area, 0);
  EXPECT_NEAR(rows.all()[1].area, .5 + .4, 1e-15);
  EXPECT_NEAR(after.area, before.area, 1e-15);
  expect_same(before.slaves, after.slaves);
  expect_same(before.masters, after.masters);
}



TEST(MortarRows, WhatIsHardlyCoveredIsGivenUpEvenWhereItFacesTheMaster)
{
  MortarRows rows(faces_of(strip(3)), sharp);
  cover(rows, 0, 1, 10);
  cover(rows, 1, 1e-4, 11); // node 2 has a ten thousandth of its area
  for (const std::size_t f : {0u, 1u, 2u})
    for (const std::size_t c : {0u, 1u})
      rows.at(f, c).kept = true;
  rows.give_up_beyond_rims();
  EXPECT_EQ(rows.all()[2].area, 0);
  EXPECT_NEAR(rows.all()[1].area, .5 + 1e-4, 1e-15);
}



// However the areas are rounded.
TEST(MortarRows, WhoIsBetweenTwoGivesToBothInSharesOfTheirAreas)
{
  for (const double rounded : {1 - 1e-15, 1., 1 + 1e-15})
    {
      MortarRows rows(faces_of(strip(4)), sharp);
      cover(rows, 0, 1, 10);
      cover(rows, 1, .2, 11);
      cover(rows, 2, .2, 12);
      cover(rows, 3, rounded, 13);
      for (const std::size_t f : {0u, 3u})
        for (const std::size_t c : {0u, 1u})
          rows.at(f, c).kept = true;
      rows.give_up_beyond_rims();
      EXPECT_EQ(rows.all()[2].area, 0);
      EXPECT_NEAR(rows.all()[1].area, .5 + .2, 1e-14);
      EXPECT_NEAR(rows.all()[3].area, .5 + .2, 1e-14);
    }
}



TEST(MortarRows, WhereNoNodeFacesTheMasterSliversGoToTheirNeighbours)
{
  MortarRows rows(faces_of(strip(2)), sharp);
  cover(rows, 0, .4, 10);
  cover(rows, 1, .01, 11); // node 2 has a sliver of it
  rows.give_up_beyond_rims();
  EXPECT_EQ(rows.all()[2].area, 0);
  EXPECT_NEAR(rows.all()[0].area, .2, 1e-15);
  EXPECT_NEAR(rows.all()[1].area, .2 + .01, 1e-15);
}



TEST(MortarRows, WhoHasNoNeighbourWithMoreKeepsTheLittleThereIs)
{
  MortarRows rows(faces_of(strip(1)), sharp);
  cover(rows, 0, 1e-5, 10);
  rows.give_up_beyond_rims();
  EXPECT_NEAR(Totals(rows).area, 1e-5, 1e-20);
}



TEST(MortarRows, HangingNodesGiveTheirsToThoseTheyFollow)
{
  MortarRows rows(faces_of(strip(2)), sharp);
  cover(rows, 0, 1, 10);
  cover(rows, 1, .5, 11);
  const Totals before(rows);
  rows.give_up({HangingNode{1, {{0, .25}, {2, .75}}}});
  const Totals after(rows);
  ASSERT_EQ(rows.all().size(), 3u);
  EXPECT_EQ(rows.all()[1].area, 0);
  EXPECT_NEAR(rows.all()[0].area, .5 + .25 * .75, 1e-15);
  EXPECT_NEAR(rows.all()[2].area, .25 + .75 * .75, 1e-15);
  EXPECT_NEAR(rows.all()[0].whole + rows.all()[2].whole, 2, 1e-15);
  EXPECT_NEAR(after.area, before.area, 1e-15);
  expect_same(before.slaves, after.slaves);
  expect_same(before.masters, after.masters);
}



// on the side of the edge that they are on themselves
TEST(MortarRows, HangingNodesAtAnEdgeStayOnTheirSide)
{
  MortarRows rows(faces_of(test::square()), sharp);
  ASSERT_EQ(rows.all().size(), 8u);
  cover(rows, 2, 1, 10); // the bottom, nodes 0 and 1
  rows.give_up({HangingNode{0, {{1, .5}, {3, .5}}}});
  EXPECT_NEAR(Totals(rows).area, 1, 1e-15);
  for (const MortarRow &row : rows.all())
    if (row.area > 0)
      {
        EXPECT_EQ(row.normal[0], 0);
        EXPECT_LT(row.normal[1], 0);
      }
}
