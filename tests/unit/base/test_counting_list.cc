// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/counting_list.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace conetact;

namespace
{
  void
  expect_the_same(const std::vector<int> &numbers)
  {
    CountingList list;
    for (const int number : numbers)
      list.push_back(number);
    ASSERT_EQ(list.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      EXPECT_EQ(list[i], numbers[i]) << i;
  }
} // namespace



TEST(CountingList, KeepsWhatIsPutIn)
{
  expect_the_same({});
  expect_the_same({7});
  expect_the_same({0, 1, 2, -1, -1, -1, 3, 4, 5, -2, -3, -4});
  std::vector<int> ascending, constant(300, -1), any;
  std::mt19937     random(1);
  for (int i = 0; i < 1000; ++i)
    {
      ascending.push_back(3 * i);
      any.push_back(static_cast<int>(random() % 3));
    }
  expect_the_same(ascending);
  expect_the_same(constant);
  expect_the_same(any);
}



/* As unknowns of dofs do: places where something is held stand between. */
TEST(CountingList, KeepsRunsOfAnyLength)
{
  std::vector<int> numbers;
  std::mt19937     random(2);
  for (int next = 0, held = -1; numbers.size() < 5000;)
    {
      for (auto n = random() % 200; n > 0; --n)
        numbers.push_back(next++);
      for (auto n = random() % 4; n > 0; --n)
        numbers.push_back(held--);
    }
  expect_the_same(numbers);
}
