// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"

#include <sys/resource.h>

#include "files.h"

using namespace conetact;
using test::read_file;

TEST(AtomicFile, IsReplacedAsAWhole)
{
  const auto file = test::folder() / "atomic.txt";
  write_atomically(file, "old");
  write_atomically(file, [&](const std::filesystem::path &temporary) {
    EXPECT_NE(temporary, file);
    std::ofstream(temporary) << "new";
    EXPECT_EQ(read_file(file), "old"); // until it is renamed
  });
  EXPECT_EQ(read_file(file), "new");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
}



TEST(AtomicFile, AFailureLeavesTheOldOneAndNoRest)
{
  const auto file = test::folder() / "atomic-failure.txt";
  write_atomically(file, "old");
  EXPECT_THROW(write_atomically(file,
                                [](const std::filesystem::path &temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw WriteError("full");
                                }),
               WriteError);
  EXPECT_EQ(read_file(file), "old");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".tmp"));
  EXPECT_THROW(write_atomically(test::folder() / "no" / "file", "text"),
               WriteError);
}



TEST(AtomicFile, LinesAreAddedAsAWholeOrNotAtAll)
{
  const auto file = test::folder() / "growing.txt";
  write_atomically(file, "one\n");
  append_to_file(file, "two\n");
  EXPECT_EQ(read_file(file), "one\ntwo\n");
  take_size_limits_as_errors();
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit ten   = before;
  ten.rlim_cur = 10; // two bytes more than the file has
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &ten), 0);
  EXPECT_THROW(append_to_file(file, "three\n"), WriteError);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(read_file(file), "one\ntwo\n");
  std::filesystem::remove(file);
  EXPECT_THROW(append_to_file(file, "four\n"), WriteError);
}
