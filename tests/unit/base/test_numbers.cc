// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sentence.h"

using namespace conetact;
using test::sentence_of;

TEST(Numbers, MayBeExpressions)
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
  for (const std::string text : {"x", "210e3*x", "3*t"})
    EXPECT_TRUE(
      test::starts(refused(text), "Entry: '" + text + "' depends on position"));
  EXPECT_NE(refused("210e3 N/mm^2").find("has 'N/mm^2' behind"),
            std::string::npos);
}



TEST(Numbers, VectorsAndIds)
{
  EXPECT_EQ(to_vector("(1, 2)", 2, "E"), (dealii::Tensor<1, 3>({1, 2, 0})));
  EXPECT_EQ(to_vector("1, 2, (3)", 3, "E"), (dealii::Tensor<1, 3>({1, 2, 3})));
  EXPECT_TRUE(test::starts(sentence_of([] { to_vector("1", 2, "E"); }),
                           "E: '1' has 1 component. Give 2"));
  EXPECT_TRUE(
    test::starts(sentence_of([] { to_vector("", 2, "E"); }), "E is empty."));
  EXPECT_EQ(to_ids("3, 1, 3", "E"), (std::set<unsigned int>{1, 3}));
  for (const std::string wrong : {"-1", "1.5", "a", "1,", "9999999999"})
    EXPECT_TRUE(test::starts(sentence_of([&] { to_ids(wrong, "E"); }), "E: '"))
      << wrong;
}
