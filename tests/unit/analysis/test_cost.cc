// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/cost.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::analysis;
using namespace conetact::contact;

TEST(Cost, OfASmallScene)
{
  const auto         scene = test::make_scene(test::triangle_on_floor(
    "set Supports = top\n", test::held_top(), "|Friction coefficient = 0.2"));
  const ContactModel model(scene->bodies, {1});
  const Cost         one = estimate_cost(model, 1, 0);
  EXPECT_EQ(one.stiffness_bytes, 8 * 4 * 4); // two feet of two unknowns
  EXPECT_GE(one.memory_bytes,
            2 * one.stiffness_bytes + one.factor->working_bytes);
  EXPECT_GT(one.seconds, 0);
  // six dofs, 1e6 increments at a microsecond each
  const Cost many = estimate_cost(model, 1000001, 0);
  EXPECT_GT(many.seconds, one.seconds + 5);
}



TEST(Cost, Units)
{
  EXPECT_EQ(megabytes(12.34e6), "12.34 MB");
  EXPECT_EQ(megabytes(0), "0 MB");
  EXPECT_GT(peak_memory(), 1e6);
}
