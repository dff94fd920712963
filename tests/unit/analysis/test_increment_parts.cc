// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_parts.h"

#include <gtest/gtest.h>

using conetact::analysis::IncrementParts;

namespace
{
  conetact::model::IncrementRecord
  record(const double work, const double slip)
  {
    conetact::model::IncrementRecord record;
    record.external_work     = work;
    record.report.iterations = 3;
    record.report.substeps   = 1;
    record.rows.resize(1);
    record.rows[0].du[1] = slip;
    return record;
  }
} // namespace

TEST(AnalysisIncrementParts, AnIncrementThatIsNotCutStaysAsItIs)
{
  IncrementParts parts;
  EXPECT_EQ(parts.end(2), 2);
  auto whole = record(5, .1);
  EXPECT_TRUE(parts.take(whole));
  EXPECT_EQ(whole.external_work, 5);
  EXPECT_EQ(whole.report.substeps, 1u);
}

TEST(AnalysisIncrementParts, PartsAddUp)
{
  IncrementParts parts;
  ASSERT_TRUE(parts.cut(1, 1, 2)); // 1.5, 2
  ASSERT_TRUE(parts.cut(1, 1, 2)); // 1.25, 1.5, 2
  EXPECT_EQ(parts.end(2), 1.25);
  double at = 1;
  for (const double end : {1.25, 1.5})
    {
      EXPECT_TRUE(parts.others_follow());
      EXPECT_EQ(parts.end(2), end);
      auto part = record(1, .1);
      EXPECT_FALSE(parts.take(part));
      at = end;
    }
  EXPECT_EQ(parts.end(2), 2);
  EXPECT_TRUE(parts.is_long(at, 1, 2));
  auto last = record(2, .3);
  EXPECT_TRUE(parts.take(last));
  EXPECT_EQ(last.external_work, 4);
  EXPECT_EQ(last.report.substeps, 3u);
  EXPECT_EQ(last.report.iterations, 9u);
  EXPECT_DOUBLE_EQ(last.rows[0].du[1], .5);
  // and the next increment starts afresh
  auto next = record(7, 0);
  EXPECT_TRUE(parts.take(next));
  EXPECT_EQ(next.external_work, 7);
}

TEST(AnalysisIncrementParts, SmallOnesAreNotCut)
{
  IncrementParts parts;
  unsigned int   n = 0;
  while (parts.cut(0, 1, 1))
    ++n;
  EXPECT_EQ(n, 5u); // 1/32
  while (parts.cut(0, 1, 1, IncrementParts::Smallest::of_load))
    ++n;
  EXPECT_EQ(n, 9u); // 1/512
  EXPECT_FALSE(parts.is_long(0, 1, 1));
}
