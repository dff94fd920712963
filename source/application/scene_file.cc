// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_file.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>

namespace conetact::application
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Far more than any scene needs; what has no end stops here. */
    constexpr std::size_t most_bytes = 16 * 1024 * 1024;
    constexpr std::size_t most_lines = 1000000, most_files = 1000,
                          most_open = 50;

    [[noreturn]] void
    refuse(const fs::path    &file,
           const std::string &where,
           const std::string &why)
    {
      throw InputError(
        (where.empty() ?
           "The scene file " + file.string() + " cannot be read" :
           where + ": the file " + file.string() + " cannot be included") +
        why);
    }

    /** Files and pipes; devices may have no end. */
    std::string
    read_file(const fs::path &file, const std::string &where)
    {
      std::error_code error;
      const auto      kind = fs::status(file, error).type();
      if (kind == fs::file_type::character || kind == fs::file_type::block)
        refuse(file, where, ": it is a device. Give a file, or a pipe.");
      std::ifstream stream(file, std::ios::binary);
      std::string   text;
      for (char part[65536]; text.size() <= most_bytes && stream;)
        {
          stream.read(part, sizeof(part));
          text.append(part, static_cast<std::size_t>(stream.gcount()));
        }
      if (kind == fs::file_type::directory || !stream.is_open() || stream.bad())
        refuse(file,
               where,
               where.empty() ?
                 ". Check its name and permissions." :
                 ". Check its name; it is searched for in the folder of the "
                 "file that includes it.");
      if (text.size() > most_bytes)
        refuse(file,
               where,
               ": it has more than 16 MB, which no scene needs. Meshes belong "
               "to Mesh/File and surfaces to File of an obstacle.");
      return text;
    }

    /** What comes through a pipe comes once, and is asked for again. */
    std::string
    read_once(const fs::path &file, const std::string &where)
    {
      static std::map<fs::path, std::string> pipes;
      std::error_code                        error;
      if (fs::status(file, error).type() != fs::file_type::fifo)
        return read_file(file, where);
      if (pipes.count(file) == 0)
        pipes[file] = read_file(file, where);
      return pipes[file];
    }

    /** How many bytes follow this one in a letter of UTF-8; -1: none may. */
    int
    n_behind(const unsigned char c)
    {
      return c < 0x80           ? 0 :
             (c & 0xe0) == 0xc0 ? 1 :
             (c & 0xf0) == 0xe0 ? 2 :
             (c & 0xf8) == 0xf0 ? 3 :
                                  -1;
    }

    bool
    is_utf8(const std::string &text)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const int n = n_behind(static_cast<unsigned char>(text[i]));
          if (n < 0)
            return false;
          for (int k = 0; k < n; ++k)
            if (++i >= text.size() ||
                (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80)
              return false;
        }
      return true;
    }

    std::string
    from_latin1(const std::string &text)
    {
      std::string utf8;
      for (const char letter : text)
        if (const auto c = static_cast<unsigned char>(letter); c < 0x80)
          utf8 += letter;
        else
          {
            utf8 += static_cast<char>(0xc0 | (c >> 6));
            utf8 += static_cast<char>(0x80 | (c & 0x3f));
          }
      return utf8;
    }

    /** As editors of all systems leave it: UTF-8, line feeds, plain blanks. */
    std::string
    plain(const std::string &raw, const std::string &file)
    {
      const std::string mark = "\xef\xbb\xbf", no_break = "\xc2\xa0";
      std::string       text =
        raw.rfind(mark, 0) == 0 ? raw.substr(mark.size()) : raw;
      if (text.find('\0') != text.npos)
        throw InputError(file + " is no text. Save it as plain text in UTF-8.");
      if (!is_utf8(text))
        text = from_latin1(text);
      std::string lines;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text.compare(i, no_break.size(), no_break) == 0)
          {
            lines += ' ';
            i += no_break.size() - 1;
          }
        else if (text[i] != '\r')
          lines += text[i];
        else if (i + 1 >= text.size() || text[i + 1] != '\n')
          lines += '\n';
      return lines;
    }

    /** What a line includes; empty: nothing. */
    std::string
    included(const std::string &line)
    {
      const std::string text = trim(line.substr(0, line.find('#')));
      if (text.rfind("include", 0) != 0 || text.size() < 8 ||
          (text[7] != ' ' && text[7] != '\t'))
        return {};
      std::string name = trim(text.substr(8));
      if (name.size() > 1 && name.front() == name.back() &&
          (name.front() == '"' || name.front() == '\''))
        name = name.substr(1, name.size() - 2);
      return name;
    }

    /** The files of a scene so far. */
    struct Files
    {
      std::vector<fs::path> open; ///< each is included by the one before
      std::size_t           read = 0;
    };

    /** Files that include others twice make any amount of text. */
    void
    check_amount(const Files       &files,
                 const SceneText   &scene,
                 const std::string &where)
    {
      const std::string start = where + ": with this file the scene has ";
      if (files.open.size() > most_open)
        throw InputError(start + "more than " + std::to_string(most_open) +
                         " files that include one another. Include fewer.");
      if (files.read > most_files)
        throw InputError(start + "included more than " +
                         std::to_string(most_files) +
                         " files. Include each of them once.");
      if (scene.origins.size() > most_lines || scene.text.size() > most_bytes)
        throw InputError((where.empty() ? "The scene file has " : start) +
                         "more than " + std::to_string(most_lines) +
                         " lines or 16 MB of text, which no scene needs. "
                         "Include each file once.");
    }

    void
    append(const fs::path    &file,
           const std::string &where,
           Files             &files,
           SceneText         &scene)
    {
      std::vector<fs::path> &open = files.open;
      std::error_code        no_path; // pipes have none
      fs::path               whole = fs::weakly_canonical(file, no_path);
      if (no_path)
        whole = file;
      if (std::find(open.begin(), open.end(), whole) != open.end())
        throw InputError(where + ": the file " + file.string() +
                         " includes itself. Remove one of the includes.");
      open.push_back(whole);
      ++files.read;
      check_amount(files, scene, where);
      const SceneText    own(plain(read_once(file, where), file.string()),
                          file.string());
      std::istringstream stream(own.text);
      std::size_t        n = 0;
      for (std::string line; std::getline(stream, line); ++n)
        if (const std::string name = included(line); name.empty())
          {
            scene.text += line + '\n';
            scene.origins.push_back(own.origins[n]);
            scene.origins.back().depth =
              static_cast<unsigned int>(open.size() - 1);
          }
        else
          append(file.parent_path() / name, own.place(n), files, scene);
      check_amount(files, scene, where);
      open.pop_back();
    }
  } // namespace



  SceneText::SceneText(const std::string &in_one, const std::string &file)
    : text(in_one)
  {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
      origins.push_back({file, origins.size() + 1, 0});
  }



  std::string
  SceneText::place(const std::size_t line) const
  {
    return line < origins.size() ? origins[line].file + ", line " +
                                     std::to_string(origins[line].number) :
           origins.empty() ? "the scene" :
                             origins[0].file;
  }



  SceneText
  read_scene_file(const fs::path &file)
  {
    SceneText scene;
    Files     files;
    append(file, "", files, scene);
    return scene;
  }
} // namespace conetact::application
