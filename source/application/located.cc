// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/located.h"

#include "conetact/application/scene_file.h"
#include "conetact/application/scene_text.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <regex>

namespace conetact::application
{
  namespace
  {
    /** "Body block/Material/Poisson ratio"; empty: no entry is named. */
    std::string
    path_of(const std::string &sentence)
    {
      static const std::regex of_name(
        "(Body|Obstacle|Contact|Support|Load) '([^']+)'(, ([^:']*))?.*");
      static const std::regex of_nothing(
        "Nothing holds (body|obstacle) '([^']+)'.*");
      static const std::regex of_section(
        "(Time|Solver|Output)((/|, )([^:=']*))?[:=].*");
      static const std::regex of_list(
        "(Dimension|Bodies|Obstacles|Contacts|Supports|Loads|"
        "Adaptive refinement|Adaptive fraction)[,:].*");
      std::smatch parts;
      if (std::regex_match(sentence, parts, of_name))
        return parts[1].str() + ' ' + parts[2].str() +
               (parts[4].matched ? '/' + parts[4].str() : "");
      if (std::regex_match(sentence, parts, of_nothing))
        return (parts[1] == "body" ? "Body " : "Obstacle ") + parts[2].str();
      if (std::regex_match(sentence, parts, of_section))
        return parts[1].str() +
               (parts[4].matched ? '/' + trim(parts[4].str()) : "");
      if (std::regex_match(sentence, parts, of_list))
        return parts[1];
      return {};
    }

    /** Without its last part: "a/b, c" -> "a/b" -> "a" -> "". */
    std::string
    shorter(const std::string &path)
    {
      const auto end = path.find_last_of("/,");
      return end == path.npos ? "" : path.substr(0, end);
    }

    /** "Contact bottom" is one of the names in Contacts. */
    std::string
    list_of(const std::string &section)
    {
      for (const auto &[kind, list] : {std::pair("Body ", "Bodies"),
                                       std::pair("Obstacle ", "Obstacles"),
                                       std::pair("Contact ", "Contacts"),
                                       std::pair("Support ", "Supports"),
                                       std::pair("Load ", "Loads")})
        if (section.rfind(kind, 0) == 0)
          return list;
      return {};
    }

    /** Where an entry is set or a subsection begins; empty: nowhere. */
    std::string
    place_in(const SceneText   &scene,
             const std::string &path,
             const CommandLine &line)
    {
      for (const std::string &override : line.overrides)
        if (sets(override, path))
          return "Option -s '" + override + '\'';
      const auto at = place_of(scene, path);
      return at ? scene.place(*at) : "";
    }
  } // namespace



  std::string
  located(const std::string &sentence, const CommandLine &line)
  try
    {
      std::string path = path_of(one_line(sentence));
      if (path.empty() || line.scene.empty())
        return sentence;
      const SceneText   scene   = read_scene_file(line.scene);
      const std::string section = path.substr(0, path.find('/'));
      for (; !path.empty(); path = shorter(path))
        if (const std::string place = place_in(scene, path, line);
            !place.empty())
          return place + ": " + sentence;
      const std::string list  = list_of(section);
      const std::string place = place_in(scene, list, line);
      return place.empty() ?
               sentence :
               place + ": " + sentence + " There is no subsection '" + section +
                 "': add it, or take its name out of " + list + '.';
    }
  catch (const InputError &) // the scene itself cannot be read
    {
      return sentence;
    }
} // namespace conetact::application
