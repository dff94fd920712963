// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/load_history.h"

#include <gtest/gtest.h>

#include "sentence.h"

using namespace conetact;
using namespace conetact::application;

namespace
{
  std::vector<double>
  times(const std::string &entries)
  {
    dealii::ParameterHandler prm;
    declare_time(prm);
    prm.parse_input_from_string(entries);
    return create_times(prm);
  }

  std::string
  refused(const std::string &entries)
  {
    return test::sentence_of([&] { times(entries); });
  }

  using Times = std::vector<double>;
} // namespace



TEST(LoadHistory, EqualIncrements)
{
  EXPECT_EQ(times(""), (Times{1}));
  EXPECT_EQ(times("set End = 3\nset Increments = 4"),
            (Times{.75, 1.5, 2.25, 3}));
}



TEST(LoadHistory, TimesAndStages)
{
  EXPECT_EQ(times("set Times = 0.5, 1, 2\nset End = 2"), (Times{.5, 1, 2}));
  EXPECT_EQ(times("set Stages = 1 : 1, 3 : 4"), (Times{1, 1.5, 2, 2.5, 3}));
  // the last increment of a stage ends there to the bit
  EXPECT_EQ(times("set Stages = 1/3 : 7").back(), 1. / 3);
}



TEST(LoadHistory, Refusals)
{
  EXPECT_TRUE(test::starts(refused("set Times = 1\nset Stages = 2 : 1"),
                           "Time: both Times and Stages"));
  EXPECT_TRUE(
    test::starts(refused("set Times = 1, 1"),
                 "Time: an increment ends at t = 1, not after t = 1"));
  EXPECT_TRUE(test::starts(refused("set Stages = 2"), "Time/Stages: '2' is"));
  for (const std::string number : {"0", "2.5", "-1", "1e8"})
    EXPECT_NE(refused("set Increments = " + number).find("are asked for"),
              std::string::npos)
      << number;
}
