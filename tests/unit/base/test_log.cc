// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/base/log.h"

#include "files.h"

using namespace conetact;

namespace
{
  std::string
  content()
  {
    return test::read_file(test::folder() / "log.txt");
  }

  /** What a log prints. */
  std::string
  printed(const bool quiet, const bool verbose)
  {
    Log log(quiet, verbose);
    testing::internal::CaptureStdout();
    log.note("a note");
    log.say("a word");
    log.time("a time");
    return testing::internal::GetCapturedStdout();
  }
} // namespace



TEST(Log, PrintsWhatIsAskedFor)
{
  EXPECT_EQ(printed(false, false), "a word\n");
  EXPECT_EQ(printed(false, true), "a note\na word\n");
  EXPECT_EQ(printed(true, true), "");
}



TEST(Log, LinesBeforeItsFolderIsKnownAreKept)
{
  Log log(true, false);
  log.note("first");
  log.open(test::folder());
  EXPECT_EQ(content(), "first\n");
  log.say("second");
  EXPECT_EQ(content(), "first\nsecond\n"); // at once
  log.time("third");
  const std::string text = content();
  EXPECT_EQ(text.substr(text.size() - 10), " s  third\n");
}



TEST(Log, AFolderThatIsNotThere)
{
  Log log(true, false);
  EXPECT_THROW(log.open(test::folder() / "no" / "such"), WriteError);
}
