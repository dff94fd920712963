// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/csv.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sentence.h"

using namespace conetact;
using namespace conetact::output;
using namespace conetact::solvers;

namespace
{
  std::string
  number(const double x)
  {
    std::string text;
    append_number(text, x);
    return text;
  }
} // namespace



TEST(Csv, NumbersAreThoseOfPrintf15g)
{
  EXPECT_EQ(number(0.), "0");
  EXPECT_EQ(number(-0.), "0");
  EXPECT_EQ(number(3.), "3");
  EXPECT_EQ(number(-.1), "-0.1");
  EXPECT_EQ(number(1. / 3), "0.333333333333333");
  for (const double x : {1e300, -2.5e-7, 123456789012345678., 5e-324, 1e15})
    {
      char expected[40];
      std::snprintf(expected, sizeof(expected), "%.15g", x);
      EXPECT_EQ(number(x), expected);
    }
}

TEST(Csv, NoiseIsJudgedByTheLargest)
{
  NoiseFloor floor;
  floor.see(-100);
  floor.see(1);
  EXPECT_EQ(floor.clean(.9e-12), 0.);
  EXPECT_EQ(floor.clean(-1.1e-12), -1.1e-12);
}



TEST(Csv, ARowIsSeparatedByCommas)
{
  std::string       table = "head\n";
  const std::string place = "Increment 3";
  CsvRow            row(table, place);
  row.add(7U);
  row.add("gap", -0.);
  row.add("u", .1);
  row.add(std::string("open"));
  row.end();
  EXPECT_EQ(table, "head\n7,0,0.1,open\n");
}



TEST(Csv, NumbersThatAreNotFiniteAreNamed)
{
  std::string       table;
  const std::string place = "Increment 3";
  for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    {
      CsvRow row(table, place);
      EXPECT_TRUE(test::starts(
        test::sentence_of<AnalysisError>([&] { row.add("gap", wrong); }),
        "Increment 3: the value of gap is not a finite number"));
    }
  EXPECT_EQ(table, "");
}



TEST(Csv, NamesOfColumns)
{
  EXPECT_EQ(safe_name("Block 1, top/left-2_a.b"), "Block_1__top_left-2_a.b");
  EXPECT_EQ(safe_names({"a b", "a_b", "a_b_2", "a/b"}),
            (std::vector<std::string>{"a_b", "a_b_2", "a_b_2_2", "a_b_3"}));
  EXPECT_STREQ(state_name(NodeState::open), "open");
  EXPECT_STREQ(state_name(NodeState::stick), "stick");
  EXPECT_STREQ(state_name(NodeState::slip), "slip");
}



// levers count: a moment is noise beside those of single forces
TEST(Csv, NoiseOfForcesAndOfMoments)
{
  model::IncrementRecord record;
  record.rows.resize(1);
  record.rows[0].reaction = Tensor<1, 3>({3, 4, 0});
  record.rows[0].position = Point<3>(0, 0, 100);
  record.loads.force      = Tensor<1, 3>({0, 2, 0});
  EXPECT_EQ(noise_of_forces(record).clean(4.9e-14), 0);
  EXPECT_EQ(noise_of_forces(record).clean(5.1e-14), 5.1e-14);
  EXPECT_EQ(noise_of_moments(record).clean(4.9e-12), 0);
  EXPECT_EQ(noise_of_moments(record).clean(-5.1e-12), -5.1e-12);
  record.each_load.resize(1);
  record.each_load[0].force = Tensor<1, 3>({0, 0, 500});
  EXPECT_EQ(noise_of_forces(record).clean(4.9e-12), 0);
}
