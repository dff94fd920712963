// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/placement.h"
#include "conetact/pairing/body_way.h"

#include <deal.II/base/symmetric_tensor.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace conetact;
  using pairing::BodyWay;

  const std::vector<Point<3>> corners = {{0, 0, 0}, {2, 0, 0}, {1, 3, .5}};

  Point<3>
  turned(const Point<3>     &p,
         const Point<3>     &centre,
         const Tensor<1, 3> &axis,
         const double        degrees)
  {
    return centre + bodies::rotation_about(axis, degrees) * (p - centre);
  }

  TEST(BodyWay, TurnsAboutAnAxisAndGoesAlongIt)
  {
    const Tensor<1, 3> axis = Point<3>(1, 2, -2) / 3.;
    const Point<3>     centre(4, -1, 2);
    const double       along = .7;
    for (const double degrees : {.1, 5., 120., 178.})
      {
        std::vector<Point<3>> to;
        for (const Point<3> &p : corners)
          to.push_back(turned(p, centre, axis, degrees) + along * axis);
        const BodyWay way(corners, to, bodies::rotation_about(axis, degrees));
        for (unsigned int i = 0; i < corners.size(); ++i)
          for (const double part : {0., .3, .5, 1.})
            EXPECT_LT(way.at(i, part).distance(
                        turned(corners[i], centre, axis, part * degrees) +
                        part * along * axis),
                      1e-11);
      }
  }

  TEST(BodyWay, DeformsEvenlyAndEndsWhereItIs)
  {
    const Tensor<2, 3>    turn = bodies::rotation_about(Point<3>(0, 0, 1), 40);
    std::vector<Point<3>> to   = {{1, 1, 0}, {2.4, 2.5, 0}, {0, 4, .6}};
    const BodyWay         turns(corners, to, turn);
    const BodyWay straight(corners, to, dealii::unit_symmetric_tensor<3>());
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        EXPECT_LT(turns.at(i, 0).distance(corners[i]), 1e-14);
        EXPECT_LT(turns.at(i, 1).distance(to[i]), 1e-14);
        EXPECT_LT(straight.at(i, .25).distance(corners[i] +
                                               .25 * (to[i] - corners[i])),
                  1e-14);
      }
  }
} // namespace
