// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/column_table.h"
#include "conetact/output/table_cells.h"

#include <gtest/gtest.h>

#include <string>

using namespace conetact::output;

TEST(TableCells, PartsOfALine)
{
  EXPECT_EQ(cells_of("a,b c,").size(), 3);
  EXPECT_EQ(cells_of("a,b c,")[1], "b c");
  EXPECT_EQ(cells_of("a,b c,")[2], "");
  EXPECT_EQ(cells_of("").size(), 1);
}



TEST(TableCells, NumbersAsTheProgramWritesThem)
{
  EXPECT_EQ(finite_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(finite_number("0"), 0.);
  for (const char *const text :
       {"", " 1", "1 ", "0x10", "nan", "inf", "1e400", "1,5", "one", "1-"})
    EXPECT_FALSE(finite_number(text)) << text;
}



TEST(TableCells, RulesOfColumns)
{
  EXPECT_EQ(rule_of("r_n").kind, rule_of("r_t2").kind);
  EXPECT_NE(rule_of("gap").kind, rule_of("r_n").kind);
  EXPECT_EQ(rule_of("support_top_f_x").kind, rule_of("loads_f_z").kind);
  EXPECT_EQ(rule_of("open").kind, "");
  EXPECT_EQ(rule_of("balance_block").judged, Judged::bounded);
  EXPECT_EQ(rule_of("iterations").judged, Judged::counted);
  EXPECT_EQ(rule_of("solver").judged, Judged::told);
  EXPECT_EQ(rule_of("state").judged, Judged::compared);
}
