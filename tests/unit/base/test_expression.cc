// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/expression.h"

#include <gtest/gtest.h>

#include "sentence.h"

using namespace conetact;
using test::sentence_of;

namespace
{
  const dealii::Point<3> p(1, 2, 3);

  std::string
  refused(const std::string &text, const double t = 0)
  {
    return sentence_of([&] { Expression(text, "Entry")(p, t); });
  }
} // namespace



TEST(Expression, OfPositionAndTime)
{
  const Expression e("x + 10*y + 100*z + 1000*t", "Entry");
  EXPECT_EQ(e(p, 4), 4321);
  EXPECT_TRUE(e.uses_time());
  EXPECT_TRUE(e.uses_space());
  EXPECT_FALSE(e.is_constant());
  EXPECT_DOUBLE_EQ(Expression("if(t > 1, cos(pi), floor(2.5))", "E")(p, 2), -1);
  EXPECT_EQ(Expression("if(t > 1, cos(pi), floor(2.5))", "E")(p, 1), 2);
}



TEST(Expression, KnowsWhatItDependsOn)
{
  EXPECT_TRUE(Expression("2*0", "E").is_zero());
  EXPECT_TRUE(Expression("2", "E").is_constant());
  EXPECT_FALSE(Expression("2", "E").is_zero());
  EXPECT_FALSE(Expression("0*t", "E").is_zero());
  EXPECT_FALSE(Expression("t", "E").uses_space());
  EXPECT_FALSE(Expression("y", "E").uses_time());
}



TEST(Expression, SentencesNameTheEntry)
{
  EXPECT_TRUE(test::starts(refused(""), "Entry: an expression is missing."));
  EXPECT_TRUE(test::starts(refused("2*"), "Entry: '2*' is not an expression"));
  EXPECT_TRUE(test::starts(sentence_of([] { Expression("ninety", "Entry"); }),
                           "Entry: 'ninety' is not an expression"));
  EXPECT_TRUE(test::starts(refused("1, 2"), "Entry: '1, 2' is not an"));
  EXPECT_TRUE(test::starts(refused("1/(x - 1)"),
                           "Entry: '1/(x - 1)' is not finite at (1, 2, 3), "
                           "t = 0."));
  EXPECT_TRUE(test::starts(refused("1e101*t", 2),
                           "Entry: '1e101*t' is 2e+101 at (1, 2, 3), t = 2, "
                           "too large"));
}



TEST(Expression, ListsAreSeparatedBySemicolons)
{
  const auto list = parse_expressions("max(x, 5) ; t", "E");
  ASSERT_EQ(list.size(), 2);
  EXPECT_EQ(list[0](p), 5);
  EXPECT_EQ(list[1](p, 7), 7);
  EXPECT_TRUE(parse_expressions("", "E").empty());
}
