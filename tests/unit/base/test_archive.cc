// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/archive.h"

#include <cmath>

#include "files.h"
#include "sentence.h"

using namespace conetact;

namespace
{
  std::filesystem::path
  archive_file()
  {
    return test::folder() / "state.bin";
  }

  std::string
  reading(const std::string &content)
  {
    std::ofstream(archive_file(), std::ios::binary) << content;
    return test::sentence_of([] { Archive::read(archive_file()); });
  }
} // namespace



TEST(Archive, KeepsEveryBit)
{
  const std::vector<double> values = {1. / 3, -0., 1e-310, -1e308, 5};
  Archive                   archive;
  archive.put("some numbers", values);
  archive.put("one", .1);
  archive.put("none", std::vector<double>());
  archive.put("vectors", {Tensor<1, 3>({1., 2., 3.})});
  archive.put_text("scene", "set A = 1\nend 2 numbers\n");
  archive.write(archive_file());

  const Archive       read = Archive::read(archive_file());
  std::vector<double> found(5);
  read.fill("some numbers", found);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(std::memcmp(&found[i], &values[i], sizeof(double)), 0) << i;
  double one = 0;
  read.fill("one", one);
  EXPECT_EQ(one, .1);
  EXPECT_TRUE(read.get("none").empty());
  std::vector<Tensor<1, 3>> vectors(1);
  read.fill("vectors", vectors);
  EXPECT_EQ(vectors[0][2], 3.);
  EXPECT_EQ(read.get_text("scene"), "set A = 1\nend 2 numbers\n");
  EXPECT_TRUE(read.has("one") && !read.has("two"));
}



TEST(Archive, WhatDoesNotFitIsRefused)
{
  Archive archive;
  archive.put("numbers", std::vector<double>(3));
  std::vector<double> two(2);
  EXPECT_NE(test::sentence_of([&] {
              archive.fill("numbers", two);
            }).find("its 'numbers' has 3 numbers, the scene 2"),
            std::string::npos);
  EXPECT_NE(test::sentence_of([&] {
              archive.get("other");
            }).find("does not know 'other'"),
            std::string::npos);
}



TEST(Archive, PartsOfAFileAreRefused)
{
  Archive archive;
  archive.put("numbers", std::vector<double>(30, 1.5));
  archive.write(archive_file());
  const std::string whole = test::read_file(archive_file());
  EXPECT_EQ(reading(whole), "accepted");
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_NE(reading(whole.substr(0, n)).find("is not a whole checkpoint"),
              std::string::npos)
      << n;
  EXPECT_NE(reading("Conetact archive 4\nnumbers 99999999999 x\n")
              .find("is not a whole checkpoint"),
            std::string::npos);
}



TEST(Archive, AByteThatIsAnotherOneIsRefused)
{
  Archive archive;
  archive.put("numbers", std::vector<double>(30, 1.5));
  archive.put_text("scene", "set A = 1\n");
  archive.write(archive_file());
  const std::string whole = test::read_file(archive_file());
  for (const char flip : {'\x01', '\x80', '\xff'})
    for (std::size_t i = 0; i < whole.size(); ++i)
      {
        std::string other     = whole;
        other[i]              = static_cast<char>(other[i] ^ flip);
        const std::string why = reading(other);
        EXPECT_TRUE(why.find("has changed since it was written") !=
                      std::string::npos ||
                    why.find("is not a whole checkpoint") != std::string::npos)
          << i << ": " << why;
      }
}
