// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/adaptive_settings.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::application;

TEST(AdaptiveSettings, EntriesArrive)
{
  dealii::ParameterHandler prm;
  declare_adaptive(prm);
  EXPECT_EQ(create_adaptive(prm).cycles, 0);
  EXPECT_EQ(create_adaptive(prm).fraction, .3);
  prm.parse_input_from_string(
    "set Adaptive refinement = 4\nset Adaptive fraction = 0.2");
  EXPECT_EQ(create_adaptive(prm).cycles, 4);
  EXPECT_EQ(create_adaptive(prm).fraction, .2);
}



TEST(AdaptiveSettings, AMeshIsNeeded)
{
  const auto frame = test::make_scene(
    test::triangle_on_floor("set Supports = top\n", test::held_top()));
  AdaptiveSettings settings;
  EXPECT_NO_THROW(check_adaptive(settings, frame->bodies.structures));
  settings.cycles = 1;
  EXPECT_THROW(check_adaptive(settings, frame->bodies.structures), InputError);
  const auto block =
    test::make_body(2, "Generator = hyper_cube|Arguments = 0 : 1 : true");
  EXPECT_NO_THROW(check_adaptive(settings, {block.get()}));
}
