// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/expression.h"
#include "conetact/base/expression_bounds.h"

#include <gtest/gtest.h>

#include <limits>

using namespace conetact;

namespace
{
  constexpr double far = std::numeric_limits<double>::infinity();

  const std::vector<std::string> others = {"p", "v"};

  const std::map<std::string, Bounds> presses_and_slips = {{"x", {1, 1}},
                                                           {"y", {2, 2}},
                                                           {"z", {3, 3}},
                                                           {"t", {4, 4}},
                                                           {"p", {0, far}},
                                                           {"v", {0, far}}};

  ExpressionBounds
  of(const std::string &text)
  {
    return bounds_of(text, presses_and_slips);
  }
} // namespace



TEST(ExpressionBounds, OfNumbersAreTheirValues)
{
  for (const char *text : {"-2^2",
                           "2^3^2",
                           "2*-3",
                           "-x^2*y",
                           "1 - 2 - 3",
                           "2/3/4",
                           "8/2*3",
                           "2^-1",
                           "1 < 2",
                           "3 != 3",
                           "(x + y)*z - t/2",
                           "y > 1 ? z : t",
                           "if(y > 2, z, t)",
                           "min(3, 1, 2) + max(x, y)",
                           "exp(1) + sqrt(2) + tanh(.3) + atan(2)",
                           "abs(-3)",
                           "pi",
                           "table(z; 0 : .5; 2 : .3; 4 : .1)",
                           "table(9; 0 : .5; 2 : .3; 4 : .1)",
                           "1.5e2 + .5",
                           "pow(2, .5)",
                           "+3 - -4"})
    {
      const Bounds values = of(text).values;
      EXPECT_TRUE(values.is_point()) << text;
      EXPECT_DOUBLE_EQ(values.low,
                       Expression(text, "E", others)({1, 2, 3}, 4, {0, 0}))
        << text;
    }
}



TEST(ExpressionBounds, KnowWhatValuesCannotExceed)
{
  const auto is =
    [](const std::string &text, const double low, const double high) {
      const Bounds values = of(text).values;
      EXPECT_DOUBLE_EQ(values.low, low) << text;
      EXPECT_DOUBLE_EQ(values.high, high) << text;
    };
  is("0.2 + 0.1*exp(-v/5)", .2, .2 + .1);
  is("min(0.4, 0.2/p)", 0, .4);
  is("table(p; 0 : .5; 100 : .3; 500 : .2)", .2, .5);
  is("if(v > 1, 0.1, 0.3)", .1, .3);
  is("0.3 + 0.1*v", .3, far);
  is("0.3/(1 + v)", 0, .3);
  is("(p - 1)^2", 0, far);
  is("1/(p - 1)", -far, far);
  is("sin(v)", -1, 1);
  is("erf(v)", -far, far); // not understood
  is("x && v", -far, far); // neither
  is("0.1*abs(v - 1)", 0, far);
}



TEST(ExpressionBounds, KnowWhatTheyDependOn)
{
  using Names = std::set<std::string>;
  EXPECT_EQ(of("0.3 + 0*v").names, Names());
  EXPECT_EQ(of("0.3 + 0*(v - p)^2").names, Names());
  EXPECT_EQ(of("0.3 + 0*v + p").names, Names{"p"});
  EXPECT_EQ(of("min(0.3, 0.4 + p)").names, Names());
  EXPECT_EQ(of("min(0.3, 0.2 + p)").names, Names{"p"});
  EXPECT_EQ(of("v - v").names, Names{"v"}); // true, and not seen
  EXPECT_EQ(of("erf(1)").names.size(), presses_and_slips.size());
  EXPECT_FALSE(Expression("0.3 + 0*v", "E", others).uses("v"));
  EXPECT_TRUE(Expression("0.3 + 0*v", "E", others).is_constant());
  EXPECT_TRUE(Expression("0.3 + v/p^2", "E", others).uses("p"));
  EXPECT_TRUE(Expression("0.3 + 0*x", "E", others).uses_space());
}
