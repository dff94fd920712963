// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/pressure_pattern.h"

#include <gtest/gtest.h>

#include <cmath>

#include "faces_only.h"

using namespace conetact;
using conetact::pairing::PressurePattern;
using test::FacesOnly;

namespace
{
  /** A line of unit segments along x. */
  FacesOnly
  line(const unsigned int n)
  {
    std::vector<Point<3>>        points;
    std::vector<FacesOnly::Face> faces;
    for (unsigned int i = 0; i <= n; ++i)
      points.emplace_back(i, 0, 0);
    for (unsigned int i = 0; i < n; ++i)
      faces.push_back({{i, i + 1}, 0});
    return FacesOnly(std::move(points), std::move(faces), false);
  }

  /** A square of n by n unit faces, node i + j * (n + 1) at (i, j). */
  FacesOnly
  square(const unsigned int n)
  {
    std::vector<Point<3>>        points;
    std::vector<FacesOnly::Face> faces;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        points.emplace_back(i, j, 0);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = i + j * (n + 1), b = a + n + 1;
          faces.push_back({{a, a + 1, b, b + 1}, 0});
        }
    return FacesOnly(std::move(points), std::move(faces), false);
  }
} // namespace



TEST(PressurePattern, PitsAreBetweenHigherNodes)
{
  const PressurePattern pattern(line(6), {0});
  EXPECT_EQ(pattern.n_pits({{1, 3.}, {2, 1.}, {3, 3.}, {4, .5}, {5, 2.}}), 2u);
  EXPECT_EQ(pattern.n_pits({{1, 3.}, {3, 3.}}), 1u); // one does not press
  // as of a ball, and of a punch with sharp edges
  EXPECT_EQ(pattern.n_pits({{2, .7}, {3, 1.}, {4, .7}}), 0u);
  EXPECT_EQ(pattern.n_pits({{1, 3.}, {2, 1.1}, {3, 1.}, {4, 1.1}, {5, 3.}}),
            0u);
}



TEST(PressurePattern, PitsOfFacetsRunAlongACylinder)
{
  PressurePattern::Pressures pressures;
  for (unsigned int i = 0; i < 25; ++i)
    pressures[i] = i % 5 % 2 == 0 ? 3. : 1.;
  EXPECT_EQ(PressurePattern(square(4), {0}).n_pits(pressures), 10u);
}



TEST(PressurePattern, NoPitsAreAtTheEdgeOfABore)
{
  // a hexagon round a triangular hole, whose corners do not press: what lies on
  // both sides of one does
  std::vector<Point<3>>        points;
  std::vector<FacesOnly::Face> faces;
  const double                 pi = std::acos(-1.);
  for (unsigned int i = 0; i < 3; ++i)
    points.emplace_back(std::cos(2 * pi * i / 3), std::sin(2 * pi * i / 3), 0);
  for (unsigned int i = 0; i < 6; ++i)
    points.emplace_back(2 * std::cos(pi * i / 3), 2 * std::sin(pi * i / 3), 0);
  for (unsigned int i = 0; i < 3; ++i)
    {
      const unsigned int at = 3 + 2 * i, next = at + 1,
                         before = 3 + (2 * i + 5) % 6;
      faces.push_back({{i, before, at}, 0});
      faces.push_back({{i, at, next}, 0});
      faces.push_back({{i, next, (i + 1) % 3}, 0});
    }
  PressurePattern::Pressures pressures;
  for (unsigned int i = 3; i < 9; ++i)
    pressures[i] = 1;
  const FacesOnly ring(std::move(points), std::move(faces), false);
  EXPECT_EQ(PressurePattern(ring, {0}).n_pits(pressures), 0u);
}



TEST(PressurePattern, LonelyNodesHaveNeighboursThatCouldPress)
{
  const PressurePattern plane(line(4), {0});
  EXPECT_EQ(plane.lonely({{2, 1.}}, {1, 2, 3}), std::vector<unsigned int>{2});
  EXPECT_TRUE(plane.lonely({{2, 1.}, {3, 1.}}, {1, 2, 3}).empty());
  EXPECT_TRUE(plane.lonely({{2, 1.}}, {2, 3}).empty());
  EXPECT_TRUE(plane.lonely({{0, 1.}}, {0, 1}).empty()); // at the rim
  const PressurePattern space(square(2), {0});
  EXPECT_EQ(space.lonely({{4, 1.}}, {0, 1, 2, 3, 4, 5, 6, 7, 8}),
            std::vector<unsigned int>{4});
  EXPECT_TRUE(space.lonely({{1, 1.}}, {0, 1, 2, 4}).empty());
}
