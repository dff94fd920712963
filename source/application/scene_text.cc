// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_text.h"

#include "conetact/application/scene_lines.h"
#include "conetact/application/scene_mistakes.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    /** What deal.II calls the text in its messages, which are rewritten. */
    const std::string the_text = "scene";

    /** Number of the line that deal.II names, or 0. */
    std::size_t
    line_number(const std::string &message)
    {
      const std::string start = "Line <";
      if (message.rfind(start, 0) != 0)
        return 0;
      std::istringstream stream(message.substr(start.size()));
      std::size_t        number = 0;
      stream >> number;
      return number;
    }

    std::string
    message_of(const dealii::ExceptionBase &error)
    {
      std::ostringstream stream;
      error.print_info(stream);
      return one_line(stream.str());
    }
  } // namespace

  void
  parse_scene_text(Handler         &prm,
                   const SceneText &scene,
                   const bool       skip_undefined)
  {
    const std::vector<SceneLine> lines = read_lines(scene.text, &scene);
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (const std::string text = misread(lines[i]); !text.empty())
        throw InputError(scene.place(i) + ": " + text);
    std::istringstream stream(scene.text);
    try
      {
        prm.parse_input(stream, the_text, "", skip_undefined);
      }
    catch (const dealii::ExceptionBase &error)
      {
        const std::string message = message_of(error);
        const std::size_t number  = line_number(message);
        if (number > 0 && number <= lines.size())
          throw InputError(scene.place(number - 1) + ": " +
                           mistake(prm, lines[number - 1], message));
        if (message.find("unequal numbers of 'subsection'") != message.npos)
          throw InputError(unbalanced(scene, lines));
        throw InputError(scene.place(0) + ": " + message);
      }
  }

  void
  refuse_repeats(const SceneText &scene)
  {
    const std::vector<SceneLine>       lines = read_lines(scene.text, &scene);
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        const SceneLine &line  = lines[i];
        const bool       entry = line.kind == SceneLine::Kind::set;
        if (!entry && line.kind != SceneLine::Kind::subsection)
          continue;
        const std::string what = (entry ? "entry '" : "subsection '") +
                                 line.name + "'" + in_section(line.path);
        const auto [known, is_new] = first.emplace(what, i);
        const std::size_t before   = known->second;
        known->second              = i;
        if (is_new || scene.origins[i].depth < scene.origins[before].depth)
          continue;
        const bool same_file =
          scene.origins[i].file == scene.origins[before].file;
        throw InputError(
          scene.place(i) + ": the " + what + " stands in " +
          (same_file ? "line " + std::to_string(scene.origins[before].number) :
                       scene.place(before)) +
          " already. Remove one of them" +
          (same_file ? "." :
                       ", or include that file before the entry that is to "
                       "replace what it says."));
      }
  }

  namespace
  {
    /** A list of names, and how far from the user it is: -1 on the command
     * line, else the depth of its file. */
    struct List
    {
      std::vector<std::string> names;
      int                      depth = 0;
    };

    /** By their entries, as the last one of each says. */
    std::map<std::string, List>
    lists_in_force(const SceneText                &scene,
                   const std::vector<SceneLine>   &lines,
                   const std::vector<std::string> &overrides)
    {
      std::map<std::string, List> lists;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].kind == SceneLine::Kind::set && lines[i].path.empty())
          lists[lines[i].name] = {split(value_of(lines[i]), ','),
                                  static_cast<int>(scene.origins[i].depth)};
      for (const std::string &override : overrides)
        if (const auto equals = override.find('='); equals != override.npos)
          lists[one_line(override.substr(0, equals))] = {
            split(one_line(override.substr(equals + 1)), ','), -1};
      return lists;
    }

    /** The line behind the end of a subsection; 0: it has none. */
    std::size_t
    end_of(const std::size_t begin, const std::vector<SceneLine> &lines)
    {
      unsigned int open = 0;
      for (std::size_t i = begin; i < lines.size(); ++i)
        if (lines[i].kind == SceneLine::Kind::subsection)
          ++open;
        else if (lines[i].kind == SceneLine::Kind::end && --open == 0)
          return i + 1;
      return 0;
    }
  } // namespace

  std::vector<std::string>
  leave_out_unlisted(SceneText                      &scene,
                     const std::vector<std::string> &overrides)
  {
    const std::vector<SceneLine> lines = read_lines(scene.text, &scene);
    const auto               lists = lists_in_force(scene, lines, overrides);
    std::vector<bool>        stays(lines.size(), true);
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        const std::string &name = lines[i].name;
        if (lines[i].kind != SceneLine::Kind::subsection ||
            !lines[i].path.empty())
          continue;
        const auto        list = lists.find(list_of(name));
        const std::size_t end  = end_of(i, lines);
        if (list == lists.end() || end == 0 ||
            list->second.depth >= static_cast<int>(scene.origins[i].depth))
          continue;
        const auto &names = list->second.names;
        if (std::count(names.begin(),
                       names.end(),
                       name.substr(name.find(' ') + 1)) > 0)
          continue;
        std::fill(stays.begin() + static_cast<std::ptrdiff_t>(i),
                  stays.begin() + static_cast<std::ptrdiff_t>(end),
                  false);
        sentences.push_back(name + " of " + scene.place(i) +
                            " is left out, since " + list->first +
                            " does not name it any more");
      }
    std::string        text;
    std::istringstream stream(scene.text);
    std::size_t        i = 0;
    for (std::string line; std::getline(stream, line); ++i)
      text += (i >= stays.size() || stays[i] ? line : "") + '\n';
    scene.text = text;
    return sentences;
  }

  std::optional<std::size_t>
  place_of(const SceneText &scene, const std::string &path)
  {
    const std::vector<SceneLine> lines = read_lines(scene.text, &scene);
    std::optional<std::size_t>   place;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if ((lines[i].kind == SceneLine::Kind::set ||
           lines[i].kind == SceneLine::Kind::subsection) &&
          path_of(lines[i]) == path)
        place = i;
    return place;
  }

  Entries
  entries_of(const std::string &text)
  {
    Entries entries;
    for (const SceneLine &line : read_lines(text))
      if (line.kind == SceneLine::Kind::set)
        entries[path_of(line)] = value_of(line);
    return entries;
  }

  bool
  sets(const std::string &override, const std::string &path)
  {
    const auto equals = override.find('=');
    if (equals == override.npos)
      return false;
    std::vector<std::string> parts = split(override.substr(0, equals), '/');
    for (std::string &part : parts)
      part = one_line(part);
    return join(parts, "/") == path;
  }

  void
  parse_override(Handler           &prm,
                 const std::string &override,
                 const bool         skip_undefined)
  {
    const std::string        start  = "Option -s '" + override + "': ";
    const std::size_t        equals = override.find('=');
    std::vector<std::string> path =
      split(override.substr(0, equals == override.npos ? 0 : equals), '/');
    for (std::string &part : path)
      part = one_line(part);
    if (path.empty() || path.size() > most_sections ||
        std::count(path.begin(), path.end(), "") > 0)
      throw InputError(start + "it is not Section/Entry=value. Write for " +
                       "example -s \"Time/End=2\".");

    SceneLine line;
    line.kind = SceneLine::Kind::set;
    line.name = path.back();
    path.pop_back();
    std::string begin, end;
    for (const std::string &part : path)
      {
        begin += "subsection " + part + "\n";
        end += "end\n";
      }
    line.text =
      "set " + line.name + " = " + one_line(override.substr(equals + 1));
    line.path = path;
    std::istringstream stream(begin + line.text + "\n" + end);
    try
      {
        prm.parse_input(stream, "", "", skip_undefined);
      }
    catch (const dealii::ExceptionBase &error)
      {
        const std::string message = message_of(error);
        const std::size_t number  = line_number(message);
        if (number > 0 && number <= path.size())
          {
            line.kind = SceneLine::Kind::subsection;
            line.name = path[number - 1];
            line.path.resize(number - 1);
          }
        throw InputError(start + mistake(prm, line, message));
      }
  }
} // namespace conetact::application
