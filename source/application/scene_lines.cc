// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_lines.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <sstream>
#include <utility>

namespace conetact::application
{
  namespace
  {
    /** What is behind a keyword, if the line starts with it. */
    bool
    starts_with(const std::string &text,
                const std::string &word,
                std::string       &rest)
    {
      if (lower_case(text.substr(0, word.size())) != word ||
          (text.size() > word.size() && text[word.size()] != ' ' &&
           text[word.size()] != '\t'))
        return false;
      rest = one_line(text.substr(word.size()));
      return true;
    }

    std::string
    without_comment(const std::string &line)
    {
      return trim(line.substr(0, line.find('#')));
    }

    [[noreturn]] void
    refuse_depth(const std::string &place)
    {
      throw InputError(place + ": more than " + std::to_string(most_sections) +
                       " subsections are open. Add the 'end' of each.");
    }
  } // namespace



  std::vector<SceneLine>
  read_lines(const std::string &text, const SceneText *scene)
  {
    std::vector<SceneLine>   lines;
    std::vector<std::string> path;
    std::istringstream       stream(text);
    for (std::string raw; std::getline(stream, raw);)
      {
        SceneLine line;
        line.text           = without_comment(raw);
        line.path           = path;
        std::size_t n_lines = 1; // one that ends with a backslash goes on
        while (!line.text.empty() && line.text.back() == '\\')
          {
            line.text.pop_back();
            ++n_lines;
            if (std::getline(stream, raw))
              line.text = trim(line.text) + " " + without_comment(raw);
          }
        if (starts_with(line.text, "set", line.name))
          {
            line.kind = SceneLine::Kind::set;
            line.name = trim(line.name.substr(0, line.name.find('=')));
          }
        else if (starts_with(line.text, "subsection", line.name))
          {
            line.kind = SceneLine::Kind::subsection;
            if (path.size() == most_sections)
              refuse_depth(scene != nullptr ? scene->place(lines.size()) :
                                              "the scene");
            path.push_back(line.name);
          }
        else if (starts_with(line.text, "end", line.name))
          {
            line.kind = SceneLine::Kind::end;
            if (!path.empty())
              path.pop_back();
          }
        else if (!line.text.empty())
          line.kind = SceneLine::Kind::unknown;
        lines.push_back(std::move(line));
        lines.resize(lines.size() + n_lines - 1);
      }
    return lines;
  }



  std::string
  path_of(const SceneLine &line)
  {
    return join(line.path, "/") + (line.path.empty() ? "" : "/") + line.name;
  }



  std::string
  value_of(const SceneLine &line)
  {
    const auto equals = line.text.find('=');
    return equals == line.text.npos ? "" : trim(line.text.substr(equals + 1));
  }



  std::string
  list_of(const std::string &subsection)
  {
    for (const auto &[kind, list] : {std::pair("Body ", "Bodies"),
                                     std::pair("Obstacle ", "Obstacles"),
                                     std::pair("Contact ", "Contacts"),
                                     std::pair("Support ", "Supports"),
                                     std::pair("Load ", "Loads")})
      if (subsection.rfind(kind, 0) == 0)
        return list;
    return {};
  }



  std::string
  in_section(const std::vector<std::string> &path)
  {
    return path.empty() ? "" : " in '" + join(path, "/") + "'";
  }
} // namespace conetact::application
