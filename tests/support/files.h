// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_files_h
#define conetact_tests_files_h

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/** A folder for the files of tests. */
namespace conetact::test
{
  /** A folder of this process, gone at its end. */
  inline const std::filesystem::path &
  folder()
  {
    static const struct Folder
    {
      std::filesystem::path path;
      Folder()
        : path(std::filesystem::path(testing::TempDir()) /
               ("conetact-" + std::to_string(::getpid())))
      {
        std::filesystem::create_directories(path);
      }
      ~Folder()
      {
        std::filesystem::remove_all(path);
      }
    } folder;
    return folder.path;
  }

  inline std::string
  write_file(const std::string &name, const std::string &text)
  {
    std::ofstream(folder() / name) << text;
    return name;
  }

  /** All of a file. */
  inline std::string
  read_file(const std::filesystem::path &file)
  {
    std::ifstream      in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
} // namespace conetact::test

#endif
