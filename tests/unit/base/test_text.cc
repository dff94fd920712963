// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <gtest/gtest.h>

#include "sentence.h"

using namespace conetact;
using test::sentence_of;
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



TEST(Text, NumbersMayBeExpressions)
{
  EXPECT_DOUBLE_EQ(to_number("sqrt(2)/80", "E"), std::sqrt(2.) / 80);
  EXPECT_EQ(to_numbers("1, 2^3", "E"), (std::vector<double>{1, 8}));
  EXPECT_TRUE(to_numbers("", "E").empty());
  const auto refused = [](const std::string &text) {
    return sentence_of([&] { to_number(text, "Entry"); });
  };
  EXPECT_TRUE(test::starts(refused(" "), "Entry: a number is missing."));
  EXPECT_TRUE(test::starts(refused("nan"), "Entry: 'nan' is not a finite"));
  EXPECT_TRUE(test::starts(refused("1/0"), "Entry: '1/0' is not finite"));
  EXPECT_TRUE(test::starts(refused("x"), "Entry: 'x' depends on position"));
}



TEST(Text, VectorsAndIds)
{
  EXPECT_EQ(to_vector("(1, 2)", 2, "E"), (dealii::Tensor<1, 3>({1, 2, 0})));
  EXPECT_EQ(to_vector("1, 2, (3)", 3, "E"), (dealii::Tensor<1, 3>({1, 2, 3})));
  EXPECT_TRUE(test::starts(sentence_of([] { to_vector("1", 2, "E"); }),
                           "E: '1' has 1 components. Give 2"));
  EXPECT_TRUE(
    test::starts(sentence_of([] { to_vector("", 2, "E"); }), "E is empty."));
  EXPECT_EQ(to_ids("3, 1, 3", "E"), (std::set<unsigned int>{1, 3}));
  for (const std::string wrong : {"-1", "1.5", "a", "1,", "9999999999"})
    EXPECT_TRUE(test::starts(sentence_of([&] { to_ids(wrong, "E"); }), "E: '"))
      << wrong;
}
