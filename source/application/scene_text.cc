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
