// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/text.h"

#include <gtest/gtest.h>

using namespace conetact;
using Parts = std::vector<std::string>;

TEST(Text, BlanksAtTheEndsAndWithin)
{
  EXPECT_EQ(trim(" \t a b\r\n"), "a b");
  EXPECT_EQ(trim(" \n"), "");
  EXPECT_EQ(one_line(" a\n\t b  c "), "a b c");
}



TEST(Text, PartsStandOutsideBrackets)
{
  EXPECT_EQ(split("a, (b, c) ,", ','), (Parts{"a", "(b, c)", ""}));
  EXPECT_EQ(split(" ", ','), Parts());
  EXPECT_EQ(split("max(1, 2) ; 3", ';'), (Parts{"max(1, 2)", "3"}));
  EXPECT_EQ(join(Parts{"a", "b"}, " + "), "a + b");
  EXPECT_EQ(join(std::set<unsigned int>{7, 2}), "2, 7");
}



TEST(Text, NumbersReadWell)
{
  EXPECT_EQ(to_text(-0.), "0");
  EXPECT_EQ(to_text(1. / 3), "0.333333");
  EXPECT_EQ(to_text(dealii::Tensor<1, 3>({1, -2.5, 0})), "(1, -2.5, 0)");
}
