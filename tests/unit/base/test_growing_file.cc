// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/growing_file.h"

#include "files.h"

using namespace conetact;
using test::read_file;

namespace
{
  namespace fs = std::filesystem;

  /** A file with a beginning, and where its other one is. */
  std::pair<fs::path, fs::path>
  begin(const std::string &name)
  {
    const fs::path file = test::folder() / name;
    write_atomically(file, "begin ");
    return {file, file.string() + ".tmp"};
  }
} // namespace

TEST(GrowingFile, ShowsWholePieces)
{
  const auto [file, temporary] = begin("growing.txt");
  {
    GrowingFile growing(file, 0);
    std::string expected = "begin ";
    for (const std::string piece : {"one ", "two ", "", "three ", "four "})
      {
        growing.add(piece);
        EXPECT_EQ(read_file(file), expected);
        growing.publish();
        expected += piece;
        EXPECT_EQ(read_file(file), expected);
      }
    // each piece twice, but for the last one; the beginning once
    EXPECT_EQ(growing.n_bytes(), 2 * expected.size() - 5 - 6);
    EXPECT_TRUE(fs::exists(temporary));
  }
  EXPECT_FALSE(fs::exists(temporary));
}



TEST(GrowingFile, IsMadeAnewWhereSomebodyElseWasAtIt)
{
  const auto [file, temporary] = begin("growing-touched.txt");
  GrowingFile growing(file, 0);
  const auto  grow = [&](const std::string &piece) {
    growing.add(piece);
    growing.publish();
  };
  grow("one ");
  grow("two ");
  fs::remove(temporary);
  grow("three ");
  EXPECT_EQ(read_file(file), "begin one two three ");
  write_atomically(temporary, std::string(fs::file_size(temporary), '?'));
  grow("four ");
  EXPECT_EQ(read_file(file), "begin one two three four ");
  fs::remove(temporary);
  fs::create_directory(temporary);
  EXPECT_THROW(growing.add("five "), WriteError);
  EXPECT_EQ(read_file(file), "begin one two three four ");
}



TEST(GrowingFile, NothingLiesBesideASmallOne)
{
  const auto [file, temporary] = begin("growing-small.txt");
  GrowingFile growing(file);
  for (const char *piece : {"one ", "two "})
    {
      growing.add(piece);
      growing.publish();
      EXPECT_FALSE(fs::exists(temporary));
    }
  EXPECT_EQ(read_file(file), "begin one two ");
}



TEST(GrowingFile, FailsWhereItsFileHasGone)
{
  const auto [file, temporary] = begin("growing-gone.txt");
  GrowingFile growing(file);
  fs::remove(file);
  EXPECT_THROW(growing.add("one "), WriteError);
  EXPECT_FALSE(fs::exists(temporary));
}
