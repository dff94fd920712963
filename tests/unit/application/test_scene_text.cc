// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_text.h"

#include <gtest/gtest.h>

#include "sentence.h"

using namespace conetact;
using namespace conetact::application;
using dealii::ParameterHandler;

namespace
{
  void
  declare(ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Dimension", "2", Integer(2, 3));
    prm.enter_subsection("Contact feet");
    prm.declare_entry("Friction coefficient", "0", Anything());
    prm.declare_entry("Kind", "a", Selection("a|b"));
    prm.leave_subsection();
  }

  std::string
  parsed(const std::string &text, const bool skip_undefined = false)
  {
    ParameterHandler prm;
    declare(prm);
    return test::sentence_of(
      [&] { parse_scene_text(prm, SceneText(text, "s.prm"), skip_undefined); });
  }

  std::string
  overridden(const std::string &text)
  {
    ParameterHandler prm;
    declare(prm);
    return test::sentence_of([&] { parse_override(prm, text, false); });
  }
} // namespace



TEST(SceneText, EntriesAreSet)
{
  ParameterHandler prm;
  declare(prm);
  parse_scene_text(
    prm,
    SceneText("set Dimension = 3 # of space\nsubsection Contact feet\n"
              "  set Kind = b\nend\n",
              "s.prm"),
    false);
  parse_override(prm, "Contact feet / Friction coefficient = 0.1 + x", false);
  EXPECT_EQ(prm.get_integer("Dimension"), 3);
  prm.enter_subsection("Contact feet");
  EXPECT_EQ(prm.get("Kind"), "b");
  EXPECT_EQ(prm.get("Friction coefficient"), "0.1 + x");
}



TEST(SceneText, SentencesNameTheLineAndTheNearestName)
{
  EXPECT_EQ(parsed("\nset Dimensoin = 2\n"),
            "s.prm, line 2: there is no entry 'Dimensoin'. "
            "Did you mean 'Dimension'?");
  EXPECT_EQ(parsed("set Dimension = 4\n"),
            "s.prm, line 1: Dimension: '4' is not possible. "
            "Give a whole number from 2 to 3.");
  EXPECT_EQ(parsed("subsection Contact feet\nset Kind = c\nend\n"),
            "s.prm, line 2: Kind in 'Contact feet': 'c' is not possible. "
            "Give one of: a, b.");
  EXPECT_EQ(parsed("subsection Contact hands\nend\n"),
            "s.prm, line 1: there is no subsection 'Contact hands', since the "
            "list Contacts does not name 'hands'. "
            "Did you mean 'Contact feet'?");
  EXPECT_EQ(parsed("subsection Contact feet\nset Kind = a\n"),
            "s.prm, line 1: subsection 'Contact feet' has no 'end'. Add it.");
  EXPECT_TRUE(test::starts(parsed("Dimension = 2\n"),
                           "s.prm, line 1: 'Dimension = 2' is not understood"));
}



TEST(SceneText, TheFirstPassSkipsWhatIsNotDeclared)
{
  EXPECT_EQ(parsed("subsection Body x\nset Any = 1\nend\n", true), "accepted");
  EXPECT_NE(parsed("set Dimension = 4\n", true), "accepted");
}



TEST(SceneText, OverridesAreNamed)
{
  EXPECT_TRUE(test::starts(overridden("Dimension"),
                           "Option -s 'Dimension': it is not Section/Entry="));
  EXPECT_EQ(overridden("Contact feet/Frction coefficient=1"),
            "Option -s 'Contact feet/Frction coefficient=1': there is no entry "
            "'Frction coefficient' in 'Contact feet'. "
            "Did you mean 'Friction coefficient'?");
  EXPECT_TRUE(test::starts(overridden("Contct feet/Kind=a"),
                           "Option -s 'Contct feet/Kind=a': there is no "
                           "subsection 'Contct feet'"));
}



TEST(SceneText, NothingStandsTwice)
{
  const auto repeats = [](const std::string &text) {
    return test::sentence_of([&] { refuse_repeats(SceneText(text, "s.prm")); });
  };
  EXPECT_EQ(repeats("set A = 1\nsubsection S\nset A = 1\nend\n"), "accepted");
  EXPECT_EQ(repeats("set A = 1\n\nset A = 2\n"),
            "s.prm, line 3: the entry 'A' stands in line 1 already. "
            "Remove one of them.");
  EXPECT_EQ(repeats("subsection S\nend\nsubsection S\nend\n"),
            "s.prm, line 3: the subsection 'S' stands in line 1 already. "
            "Remove one of them.");
}
