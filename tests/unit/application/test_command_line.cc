// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/batch_file.h"
#include "conetact/application/command_line.h"

#include <gtest/gtest.h>

#include "sentence.h"

using namespace conetact;
using namespace conetact::application;

namespace
{
  CommandLine
  parse(std::vector<std::string> words)
  {
    words.insert(words.begin(), "conetact");
    std::vector<char *> argv;
    for (std::string &word : words)
      argv.push_back(word.data());
    return parse_command_line(static_cast<int>(argv.size()), argv.data());
  }

  std::string
  refused(const std::vector<std::string> &words)
  {
    return test::sentence_of([&] { parse(words); });
  }
} // namespace



TEST(CommandLine, AllOptions)
{
  const CommandLine line = parse({"-s",
                                  "A/B=1",
                                  "scene.prm",
                                  "--set=C=2",
                                  "-o",
                                  "there",
                                  "--dry-run",
                                  "-q",
                                  "--parameters"});
  EXPECT_EQ(line.scene, "scene.prm");
  EXPECT_EQ(line.folder, "there");
  EXPECT_EQ(line.overrides, (std::vector<std::string>{"A/B=1", "C=2"}));
  EXPECT_TRUE(line.dry_run && line.quiet && line.print_parameters);
  EXPECT_EQ(line.answer, "");
}



TEST(CommandLine, DefaultsAndAnswers)
{
  const CommandLine line = parse({"a b.prm"});
  EXPECT_EQ(line.scene, "a b.prm");
  EXPECT_TRUE(line.folder.empty() && line.overrides.empty());
  EXPECT_FALSE(line.dry_run || line.quiet || line.print_parameters);
  EXPECT_TRUE(test::starts(parse({"--version"}).answer, "conetact "));
  EXPECT_TRUE(test::starts(parse({"-h"}).answer, "usage: conetact "));
}



TEST(CommandLine, Refusals)
{
  EXPECT_TRUE(test::starts(refused({}), "No scene file is given."));
  EXPECT_TRUE(test::starts(refused({"a", "b"}), "More than one scene file"));
  EXPECT_NE(refused({"compar", "a", "b"}).find("Did you mean 'compare'?"),
            std::string::npos);
  EXPECT_TRUE(test::starts(refused({"a", "-o"}), "Option -o needs a value, "));
  EXPECT_TRUE(test::starts(refused({"a", "-o", ""}), "Option -o: the folder"));
  EXPECT_TRUE(test::starts(refused({"--loud", "a"}), "Option --loud is not"));
}



TEST(CommandLine, Batches)
{
  const CommandLine line = parse({"--batch", "runs.txt", "--jobs=4"});
  EXPECT_EQ(line.batch, "runs.txt");
  EXPECT_EQ(line.jobs, 4u);
  EXPECT_TRUE(test::starts(refused({"--batch", "a", "-q"}), "--batch takes"));
  EXPECT_TRUE(test::starts(refused({"--jobs", "2", "a"}), "--jobs is for"));
  EXPECT_TRUE(test::starts(refused({"--jobs", "x"}), "Option --jobs: 'x'"));
  EXPECT_EQ(results_folder(parse({"a/b.prm"})), "output/b");
  EXPECT_EQ(results_folder(parse({"a/b.prm", "-o", "c"})), "c");
}



TEST(BatchFile, WordsAreThoseOfAShell)
{
  using Words    = std::vector<std::string>;
  const auto run = [](const std::string &line) {
    return parse_batch_line(line, 7).value();
  };
  EXPECT_FALSE(parse_batch_line(" \t", 1).has_value());
  EXPECT_FALSE(parse_batch_line("  # a.prm", 1).has_value());
  EXPECT_EQ(run("a\tb  -s 'A b/C=1 # \"2\"' # d").words,
            (Words{"a", "b", "-s", "A b/C=1 # \"2\""}));
  EXPECT_EQ(run(R"(a\ b\\ "c \"d\" \e" x#y '' f'g'"h")").words,
            (Words{"a b\\", "c \"d\" \\e", "x#y", "", "fgh"}));
  EXPECT_EQ(run("a").number, 7u);
  const BatchRun files = run("a > 'o u t' 2>err t=1>2 '>b'");
  EXPECT_EQ(files.words, (Words{"a", "t=1>2", ">b"}));
  EXPECT_EQ(files.out, "o u t");
  EXPECT_EQ(files.err, "err");
}



TEST(CommandLine, RunsToBeCompared)
{
  const CommandLine line =
    parse({"compare", "one", "--tolerance", "1e-6", "an other", "-q"});
  EXPECT_EQ(line.compared,
            (std::vector<std::filesystem::path>{"one", "an other"}));
  EXPECT_EQ(line.tolerance, 1e-6);
  EXPECT_TRUE(line.quiet && line.scene.empty());
  EXPECT_FALSE(parse({"compare", "a", "b"}).tolerance);
  EXPECT_EQ(parse({"./compare"}).scene, "./compare");
  EXPECT_NE(refused({"compare", "one"}).find("there are fewer"),
            std::string::npos);
  EXPECT_NE(refused({"compare", "one", "two", "-s", "A=1"})
              .find("compare runs no scene"),
            std::string::npos);
}



TEST(CommandLine, TextsOfEntries)
{
  EXPECT_EQ(parse({"--completion", "bash"}).entry_text, "bash");
  EXPECT_EQ(parse({"--grammar=vim"}).entry_text, "vim");
  EXPECT_EQ(parse({"--schema"}).entry_text, "schema");
  EXPECT_EQ(parse({"--completion", "entries", "a.prm"}).scene, "a.prm");
  EXPECT_NE(refused({"--completion", "entries"}).find("needs the scene"),
            std::string::npos);
  EXPECT_NE(refused({"--grammar", "ed"}).find("Give one of: vim, vscode."),
            std::string::npos);
  EXPECT_EQ(refused({"--batch", "runs.txt", "--schema"}),
            refused({"--batch", "runs.txt", "-q"}));
}
