// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/joined_warnings.h"

#include "files.h"

using namespace conetact;

namespace
{
  std::string
  sentence(const std::string &name, const std::string &gap)
  {
    return "contact '" + name + "': sides are " + gap + " apart.";
  }

  struct Said
  {
    std::string  screen, file;
    unsigned int n_warnings;
  };

  Said
  said(const std::vector<std::string> &sentences)
  {
    Log log(false, false);
    log.open(test::folder());
    testing::internal::CaptureStdout();
    warn(sentences, log);
    return {testing::internal::GetCapturedStdout(),
            test::read_file(test::folder() / "log.txt"),
            log.n_warnings()};
  }
} // namespace



TEST(JoinedWarnings, FewAreSaidOneByOne)
{
  const Said three =
    said({sentence("a 1", "0.1"), sentence("b", "2e-05"), sentence("c", "-3")});
  EXPECT_EQ(three.screen,
            "warning: contact 'a 1': sides are 0.1 apart.\n"
            "warning: contact 'b': sides are 2e-05 apart.\n"
            "warning: contact 'c': sides are -3 apart.\n");
  EXPECT_EQ(three.file, three.screen);
  EXPECT_EQ(three.n_warnings, 3);
  EXPECT_EQ(said({}).file, "");
}



TEST(JoinedWarnings, FourOfOneKindAreOne)
{
  const Said four = said({sentence("a 1", "0.1"),
                          sentence("b", "2e-05"),
                          "obstacle 'o': it jumps.",
                          sentence("c", "-3"),
                          sentence("d", "4")});
  EXPECT_EQ(four.screen,
            "warning: contact 'a 1': sides are 0.1 apart. The same holds for "
            "'b', 'c', 'd', with numbers of their own in log.txt.\n"
            "warning: obstacle 'o': it jumps.\n");
  EXPECT_EQ(four.n_warnings, 2);
  for (const char *const each : {"a 1': sides are 0.1 apart.\n",
                                 "b': sides are 2e-05 apart.\n",
                                 "c': sides are -3 apart.\n",
                                 "d': sides are 4 apart.\n"})
    EXPECT_NE(four.file.find(each), std::string::npos) << each;
}
