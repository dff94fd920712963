// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_file.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace conetact::application
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string
    read_file(const fs::path &file, const std::string &where)
    {
      std::ifstream      stream(file, std::ios::binary);
      std::ostringstream text;
      // Of an empty file nothing can be inserted, which is no failure to read.
      const bool is_empty = stream.peek() == std::ifstream::traits_type::eof();
      if (fs::is_directory(file) || !stream.is_open() ||
          (!is_empty && !(text << stream.rdbuf())))
        throw InputError(
          where.empty() ?
            "The scene file " + file.string() +
              " cannot be read. Check its name and permissions." :
            where + ": the file " + file.string() +
              " cannot be included. Check its name; it is searched for in the "
              "folder of the file that includes it.");
      return text.str();
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

    /** As editors of all systems leave it: UTF-8 with line feeds. */
    std::string
    plain(const std::string &raw, const std::string &file)
    {
      const std::string mark = "\xef\xbb\xbf";
      std::string       text =
        raw.rfind(mark, 0) == 0 ? raw.substr(mark.size()) : raw;
      if (text.find('\0') != text.npos)
        throw InputError(file + " is no text. Save it as plain text in UTF-8.");
      if (!is_utf8(text))
        text = from_latin1(text);
      std::string lines;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] != '\r')
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
      const fs::path whole = fs::weakly_canonical(file);
      if (std::find(open.begin(), open.end(), whole) != open.end())
        throw InputError(where + ": the file " + file.string() +
                         " includes itself. Remove one of the includes.");
      open.push_back(whole);
      const SceneText    own(plain(read_file(file, where), file.string()),
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
