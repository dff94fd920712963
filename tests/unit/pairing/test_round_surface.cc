// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/placement.h"
#include "conetact/pairing/round_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "faces_only.h"

namespace
{
  using namespace conetact;
  using pairing::round_surface;
  using pairing::RoundSurface;
  using test::FacesOnly;

  /** Faces that list their nodes. */
  class Skin : public FacesOnly
  {
  public:
    using FacesOnly::FacesOnly;
    bodies::Surface
    surface(const bodies::BoundaryIds &ids) const override
    {
      bodies::Surface result = FacesOnly::surface(ids);
      for (unsigned int i = 0; i < n_nodes(); ++i)
        result.nodes.push_back({i, position(i), 0, {}, {}});
      return result;
    }
  };

  /** A tube of n faces around and two along, radius r and, along y, r b. */
  Skin
  tube(const unsigned int  n,
       const double        r,
       const double        b,
       const Point<3>     &centre,
       const Tensor<2, 3> &turn,
       const double        part = 1)
  {
    std::vector<Point<3>>        points;
    std::vector<FacesOnly::Face> faces;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i <= n; ++i)
        {
          // not even, so that no symmetry helps
          const double angle =
            part * 2 * M_PI * (i + .3 * std::sin(2. * i) * (i % n > 0)) / n;
          points.push_back(centre +
                           turn * Tensor<1, 3>({r * std::cos(angle),
                                                r * b * std::sin(angle),
                                                .8 * r * k}));
        }
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = k * (n + 1) + i, c = a + n + 1;
          faces.push_back({{a, a + 1, c, c + 1}, 0});
        }
    return Skin(std::move(points), std::move(faces), false);
  }

  const Tensor<2, 3> askew =
    bodies::rotation_about(Tensor<1, 3>({1, 2, -.5}), 40);

  TEST(RoundSurface, FindsACylinderWhereverItStands)
  {
    const Point<3> centre(3, -7, 20);
    for (const double r : {1e-3, 1., 1e3})
      for (const double part : {1., .4})
        {
          const auto found =
            round_surface(tube(24, r, 1, centre, askew, part), {0}, 3);
          ASSERT_TRUE(found.has_value());
          EXPECT_NEAR(found->radius / r, 1, 1e-9);
          const Tensor<1, 3> axis = askew * Tensor<1, 3>({0, 0, 1});
          EXPECT_NEAR(std::abs(found->axis * axis), 1, 1e-12);
          Tensor<1, 3> off = found->centre - centre;
          off -= (off * axis) * axis;
          EXPECT_LT(off.norm(), 1e-9 * r);
          const Tensor<1, 3> out = askew * Tensor<1, 3>({0, 1, 0});
          EXPECT_LT(
            (found->outward(centre + 5 * r * axis + r * out) - out).norm(),
            1e-8);
        }
  }

  TEST(RoundSurface, TellsCylindersFromOthers)
  {
    // a hundred thousandth out of round
    EXPECT_FALSE(round_surface(tube(24, 1, 1.00001, {}, askew), {0}, 3));
    // a prism of twelve sides
    EXPECT_FALSE(round_surface(tube(12, 1, 1, {}, askew), {0}, 3));
    // nearly a plane
    EXPECT_FALSE(round_surface(tube(24, 1, 1, {}, askew, .05), {0}, 3));
    EXPECT_FALSE(round_surface(test::cube(3), {0, 1, 2, 3, 4, 5}, 3));
  }

  TEST(RoundSurface, KnowsAxesThatAreTheSame)
  {
    const RoundSurface one{{1, 2, 3}, Tensor<1, 3>({0, 0, 1}), 2};
    RoundSurface       other = one;
    other.centre[2]          = -50;
    other.axis *= -1;
    other.radius = 3;
    EXPECT_TRUE(one.is_about_axis_of(other));
    other.centre[0] += 1e-4;
    EXPECT_FALSE(one.is_about_axis_of(other));
    EXPECT_FALSE(one.is_about_axis_of({one.centre, {}, 2})); // a sphere
  }
} // namespace
