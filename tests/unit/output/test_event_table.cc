// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/output/event_table.h"

#include "files.h"

using namespace conetact;
using namespace conetact::output;

namespace
{
  std::string
  content()
  {
    return test::read_file(test::folder() / "events.csv");
  }
} // namespace



TEST(EventTable, NodesThatChangeTogetherShareANumber)
{
  EventTable        table(test::folder());
  const std::string head = "event,parameter,node,from,to,load\n";
  EXPECT_EQ(content(), head);
  table.add(.5, {{"0", "stick", "slip+"}, {"4", "stick", "open"}}, "rises");
  table.add(1. / 3, {{"0", "slip+", "stick"}}, "turns down");
  table.add(.25, {}, "turns up");
  EXPECT_EQ(content(), head); // until write()
  table.write();
  const std::string events =
    head + "1,0.5,0,stick,slip+,rises\n1,0.5,4,stick,open,rises\n"
           "2,0.333333333333333,0,slip+,stick,turns down\n"
           "3,0.25,,,,turns up\n";
  EXPECT_EQ(content(), events);
  table.finish(2, "limit load: sliding");
  EXPECT_EQ(content(), events + "outcome,2,,,limit load: sliding,\n");
}



TEST(EventTable, AParameterThatIsNotFinite)
{
  EventTable table(test::folder());
  EXPECT_THROW(table.add(std::nan(""), {{"0", "stick", "open"}}, "rises"),
               AnalysisError);
}
