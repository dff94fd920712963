// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/manual.h"
#include "conetact/application/scene_file.h"
#include "conetact/application/scene_text.h"

#include <algorithm>

#include "files.h"
#include "sentence.h"

using namespace conetact;
using namespace conetact::application;

namespace
{
  std::filesystem::path
  file(const std::string &name, const std::string &text)
  {
    const std::filesystem::path path = test::folder() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::string
  text_of(const std::string &raw)
  {
    return read_scene_file(file("raw.prm", raw)).text;
  }
} // namespace



TEST(SceneFile, LineEndsAndEncodings)
{
  EXPECT_EQ(text_of("set A = 1\r\nset B = 2\r\n"), "set A = 1\nset B = 2\n");
  EXPECT_EQ(text_of("set A = 1\rset B = 2"), "set A = 1\nset B = 2\n");
  EXPECT_EQ(text_of("\xef\xbb\xbfset A = 1\n"), "set A = 1\n");
  EXPECT_EQ(text_of("# \xfc\n"), "# \xc3\xbc\n");     // Latin-1
  EXPECT_EQ(text_of("# \xc3\xbc\n"), "# \xc3\xbc\n"); // UTF-8
  EXPECT_EQ(text_of("# \xc3\n"), "# \xc3\x83\n");     // Latin-1 again
  EXPECT_EQ(text_of("set\xc2\xa0"
                    "End = 2\n"),
            "set End = 2\n"); // no break
  EXPECT_EQ(text_of(""), "");
  EXPECT_NE(test::sentence_of([] {
              text_of(std::string("a\0b", 3));
            }).find("is no text"),
            std::string::npos);
}



TEST(SceneFile, IncludesAreRelativeToTheirFile)
{
  file("below/inner.prm", "set B = 2\n");
  file("below/middle.prm", "include inner.prm # beside it\n");
  const SceneText scene = read_scene_file(
    file("outer.prm", "set A = 1\n include 'below/middle.prm'\nset C = 3\n"));
  EXPECT_EQ(scene.text, "set A = 1\nset B = 2\nset C = 3\n");
  ASSERT_EQ(scene.origins.size(), 3u);
  EXPECT_EQ(scene.place(1),
            (test::folder() / "below" / "inner.prm").string() + ", line 1");
  EXPECT_EQ(scene.origins[1].depth, 2u);
  EXPECT_EQ(scene.place(2),
            (test::folder() / "outer.prm").string() + ", line 3");
}

TEST(SceneFile, WrongIncludes)
{
  const auto sentence = [](const std::string &text) {
    return test::sentence_of([&] { read_scene_file(file("raw.prm", text)); });
  };
  const std::string here = (test::folder() / "raw.prm").string();
  EXPECT_TRUE(test::starts(sentence("set A = 1\ninclude none.prm\n"),
                           here + ", line 2: the file " +
                             (test::folder() / "none.prm").string() +
                             " cannot be included."));
  EXPECT_TRUE(
    test::starts(sentence("include raw.prm\n"),
                 here + ", line 1: the file " + here + " includes itself."));
}



TEST(SceneFile, WhatIsIncludedMayBeReplacedBehind)
{
  file("base.prm", "set A = 1\nsubsection S\nset B = 2\nend\n");
  const auto repeats = [](const std::string &text) {
    return test::sentence_of(
      [&] { refuse_repeats(read_scene_file(file("raw.prm", text))); });
  };
  EXPECT_EQ(repeats(
              "include base.prm\nset A = 2\nsubsection S\nset B = 3\nend\n"),
            "accepted");
  EXPECT_NE(repeats("set A = 2\ninclude base.prm\n")
              .find("base.prm, line 1: the "
                    "entry 'A' stands in"),
            std::string::npos);
  EXPECT_NE(repeats("include base.prm\nset A = 2\nset A = 3\n")
              .find("line 3: the entry 'A' stands in line 2 already"),
            std::string::npos);
}

TEST(SceneFile, WhatAListDoesNotNameAnyMoreIsLeftOut)
{
  file("base.prm",
       "set Loads = a, b\nsubsection Load a\nset Kind = force\nend\n"
       "subsection Load b\nsubsection C\nend\nend\n");
  const auto left = [](const std::string              &text,
                       const std::vector<std::string> &overrides) {
    SceneText  scene     = read_scene_file(file("raw.prm", text));
    const auto n_lines   = scene.origins.size();
    const auto sentences = leave_out_unlisted(scene, overrides);
    EXPECT_EQ(static_cast<std::size_t>(
                std::count(scene.text.begin(), scene.text.end(), '\n')),
              n_lines);
    for (const std::string &sentence : sentences)
      EXPECT_NE(sentence.find("since Loads does not name it"),
                std::string::npos);
    return std::pair(sentences.size(), scene.text);
  };
  const auto [n, text] = left("include base.prm\nset Loads = a\n", {});
  EXPECT_EQ(n, 1u);
  EXPECT_NE(text.find("Load a"), std::string::npos);
  EXPECT_EQ(text.find("Load b"), std::string::npos);
  EXPECT_EQ(left("include base.prm\nset Loads =\n", {}).first, 2u);
  EXPECT_EQ(left("include base.prm\n", {}).first, 0u);
  EXPECT_EQ(left("include base.prm\n", {"Loads=b"}).first, 1u);
  // a list and a subsection of one file are a mistake, which is told
  EXPECT_EQ(left("set Loads = a\nsubsection Load b\nend\n", {}).first, 0u);
}



TEST(Manual, HasEveryKindOfEntry)
{
  const std::string text = manual();
  for (const char *part : {"# All entries of a scene",
                           "\n## Body NAME/Material\n",
                           "\n* **Young modulus**: Young's modulus E",
                           "\n## Contact NAME\n",
                           "\n* **Dimension** = `2`: Dimension of space",
                           "\n## Output\n",
                           "* **Checkpoint** = `0`: "})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Manual, AStarterSceneIsWrittenOnce)
{
  const std::string name = (test::folder() / "starter").string();
  EXPECT_EQ(write_starter_scene(name),
            "Wrote " + name + ".prm. Edit it, then run: conetact " + name +
              ".prm\n");
  EXPECT_EQ(test::read_file(name + ".prm"), starter_scene());
  EXPECT_NE(test::sentence_of([&] {
              write_starter_scene(name + ".prm");
            }).find("exists already"),
            std::string::npos);
  EXPECT_NE(test::sentence_of([&] {
              write_starter_scene("a/");
            }).find("is no name"),
            std::string::npos);
}



TEST(SceneFile, DevicesAndFilesWithoutEndAreRefused)
{
  const auto sentence = [](const std::filesystem::path &path) {
    return test::sentence_of([&] { read_scene_file(path); });
  };
  EXPECT_TRUE(test::starts(sentence("/dev/zero"),
                           "The scene file /dev/zero cannot be read: it is a "
                           "device."));
  EXPECT_NE(sentence(file("outer.prm", "include /dev/zero\n"))
              .find("line 1: the file /dev/zero cannot be included: it is a "
                    "device."),
            std::string::npos);
  EXPECT_NE(sentence(file("long.prm", std::string(17 * 1024 * 1024, '#')))
              .find("it has more than 16 MB"),
            std::string::npos);
  const std::string comment = std::string(16 * 1024 * 1024 - 1, '#') + '\n';
  EXPECT_EQ(text_of(comment), comment);
}
