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
    constexpr std::streamsize most_bytes = 16 * 1024 * 1024;

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
      std::ifstream     stream(file, std::ios::binary);
      std::vector<char> text(most_bytes + 1);
      stream.read(text.data(), most_bytes + 1);
      if (kind == fs::file_type::directory || !stream.is_open() || stream.bad())
        refuse(file,
               where,
               where.empty() ?
                 ". Check its name and permissions." :
                 ". Check its name; it is searched for in the folder of the "
                 "file that includes it.");
      if (stream.gcount() > most_bytes)
        refuse(file,
               where,
               ": it has more than 16 MB, which no scene needs. Meshes belong "
               "to Mesh/File and surfaces to File of an obstacle.");
      return {text.data(), static_cast<std::size_t>(stream.gcount())};
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

    void
    append(const fs::path        &file,
           const std::string     &where,
           std::vector<fs::path> &open,
           SceneText             &scene)
    {
      std::error_code no_path; // pipes have none
      fs::path        whole = fs::weakly_canonical(file, no_path);
      if (no_path)
        whole = file;
      if (std::find(open.begin(), open.end(), whole) != open.end())
        throw InputError(where + ": the file " + file.string() +
                         " includes itself. Remove one of the includes.");
      open.push_back(whole);
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
          append(file.parent_path() / name, own.place(n), open, scene);
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
    SceneText             scene;
    std::vector<fs::path> open;
    append(file, "", open, scene);
    return scene;
  }
} // namespace conetact::application
