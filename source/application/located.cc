// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/located.h"

#include "conetact/application/automatic_contacts.h"
#include "conetact/application/scene_file.h"
#include "conetact/application/scene_lines.h"
#include "conetact/application/scene_text.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace conetact::application
{
  namespace
  {
    /** Removes what the text starts with; whether it does. */
    bool
    take(std::string_view &text, const std::string_view start)
    {
      if (text.substr(0, start.size()) != start)
        return false;
      text.remove_prefix(start.size());
      return true;
    }

    /** Removes and returns what stands before any of these letters. */
    std::string
    take_until(std::string_view &text, const std::string_view letters)
    {
      const std::string before(text.substr(0, text.find_first_of(letters)));
      text.remove_prefix(before.size());
      return before;
    }

    /** "Body 'block', Material/Poisson ratio: ..." */
    std::string
    path_of_name(std::string_view text)
    {
      for (const std::string kind :
           {"Body", "Obstacle", "Contact", "Support", "Load"})
        if (take(text, kind + " '"))
          {
            const std::string path = kind + ' ' + take_until(text, "'");
            return take(text, "', ") ? path + '/' + take_until(text, "':") :
                                       path;
          }
      return {};
    }

    /** "Nothing holds body 'block' ..." */
    std::string
    path_of_nothing(std::string_view text)
    {
      if (!take(text, "Nothing holds "))
        return {};
      for (const auto &[word, kind] :
           {std::pair("body '", "Body "), std::pair("obstacle '", "Obstacle ")})
        if (take(text, word))
          return kind + take_until(text, "'");
      return {};
    }

    /** "Time/End: ...", "Time, End = ..." */
    std::string
    path_of_section(std::string_view text)
    {
      for (const std::string section :
           {"Time", "Solver", "Output", "Automatic contact"})
        if (take(text, section))
          {
            const bool        entry = take(text, "/") || take(text, ", ");
            const std::string name  = take_until(text, ":='");
            if (text.empty() || text[0] == '\'' || (!entry && !name.empty()))
              return {};
            return section + (entry ? '/' + trim(name) : "");
          }
      return {};
    }

    /** "Bodies: ..." */
    std::string
    path_of_list(std::string_view text)
    {
      for (const std::string list : {"Dimension",
                                     "Bodies",
                                     "Obstacles",
                                     "Contacts",
                                     "Supports",
                                     "Loads",
                                     "Adaptive refinement",
                                     "Adaptive fraction"})
        if (take(text, list))
          return take(text, ",") || take(text, ":") ? list : "";
      return {};
    }

    /** "Body block/Material/Poisson ratio"; empty: no entry is named. */
    std::string
    path_of(const std::string &sentence)
    {
      for (const auto &read :
           {path_of_name, path_of_nothing, path_of_section, path_of_list})
        if (std::string path = read(sentence); !path.empty())
          return path;
      return {};
    }

    /** Without its last part: "a/b, c" -> "a/b" -> "a" -> "". */
    std::string
    shorter(const std::string &path)
    {
      const auto end = path.find_last_of("/,");
      return end == path.npos ? "" : path.substr(0, end);
    }

    /** Whether it is a contact that no name stands for. */
    bool
    is_found(const SceneText &scene, const std::string &section)
    {
      const Entries entries = entries_of(scene.text);
      const auto    list    = entries.find("Contacts");
      if (section.rfind("Contact ", 0) != 0 || list == entries.end())
        return false;
      const std::vector<std::string> names = split(list->second, ',');
      return std::find(names.begin(), names.end(), automatic_contacts) !=
             names.end();
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
      if (is_found(scene, section))
        return sentence + " It is one of Contacts = automatic: name its sides "
                          "in Automatic contact/Exceptions.";
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
