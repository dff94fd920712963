// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_mistakes.h"

#include "conetact/application/value_kind.h"
#include "conetact/base/nearest.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    /** Declared names of one kind in the subsection `path`. */
    std::vector<std::string>
    declared(const Handler                  &prm,
             const SceneLine::Kind           kind,
             const std::vector<std::string> &path)
    {
      std::ostringstream stream;
      prm.print_parameters(stream, Handler::ShortText);
      std::vector<std::string> names;
      for (const SceneLine &line : read_lines(stream.str()))
        if (line.kind == kind && line.path == path)
          names.push_back(line.name);
      return names;
    }

    /** What other programs, or formulas, call an entry. */
    struct OtherName
    {
      const char *name, *here;
    };
    const OtherName other_names[] = {{"mu", "Friction coefficient"},
                                     {"friction", "Friction coefficient"},
                                     {"friction coeff", "Friction coefficient"},
                                     {"coefficient of friction",
                                      "Friction coefficient"},
                                     {"e", "Young modulus"},
                                     {"youngs modulus", "Young modulus"},
                                     {"young's modulus", "Young modulus"},
                                     {"elastic modulus", "Young modulus"},
                                     {"modulus of elasticity", "Young modulus"},
                                     {"nu", "Poisson ratio"},
                                     {"poisson's ratio", "Poisson ratio"},
                                     {"poissons ratio", "Poisson ratio"},
                                     {"steps", "Increments"},
                                     {"number of steps", "Increments"},
                                     {"number of increments", "Increments"},
                                     {"time step", "Increments"},
                                     {"end time", "End"},
                                     {"body", "Bodies"},
                                     {"block", "Bodies"},
                                     {"boundary", "Boundary ids"},
                                     {"ids", "Boundary ids"},
                                     {"method", "Method"},
                                     {"alpha", "Expansion coefficient"},
                                     {"force", "Value"},
                                     {"type", "Kind"},
                                     {"refinement", "Global refinements"},
                                     {"refinements", "Global refinements"}};

    /** The declared name that is meant, as far as one can tell; or empty. */
    std::string
    meant(const std::string &name, const std::vector<std::string> &names)
    {
      for (const OtherName &other : other_names)
        if (lower_case(name) == other.name &&
            std::find(names.begin(), names.end(), other.here) != names.end())
          return other.here;
      return nearest(name, names);
    }

    /** 'Body block' with its name in quotes: 'Body "block"'. */
    std::string
    quoted(const std::string &subsection,
           const std::string &name,
           const char         mark)
    {
      return subsection.substr(0, subsection.size() - name.size()) + mark +
             name + mark;
    }

    /** The section that has an entry of this name, for one that has not. */
    std::string
    section_with(const Handler &prm, const std::string &entry)
    {
      std::ostringstream stream;
      prm.print_parameters(stream, Handler::ShortText);
      for (const SceneLine &line : read_lines(stream.str()))
        if (line.kind == SceneLine::Kind::set && line.name == entry)
          return line.path.empty() ? "the scene, outside of all sections" :
                                     "'" + join(line.path, "/") + "'";
      return {};
    }

    std::string
    undeclared(const Handler &prm, const SceneLine &line)
    {
      const bool        entry = line.kind == SceneLine::Kind::set;
      const std::string what  = entry ? "entry" : "subsection";
      std::string       text =
        "there is no " + what + " '" + line.name + "'" + in_section(line.path);
      const std::string list =
        line.path.empty() && !entry ? list_of(line.name) : "";
      const std::string name =
        list.empty() ? "" : line.name.substr(line.name.find(' ') + 1);
      if (!list.empty())
        text += ", since the list " + list + " does not name '" + name + "'";
      const std::vector<std::string> names =
        declared(prm, line.kind, line.path);
      // one name where several are meant: "top bottom", "top; bottom"
      for (const std::string &other : names)
        if (!list.empty() && (other == quoted(line.name, name, '"') ||
                              other == quoted(line.name, name, '\'')))
          return text + " but one in quotes. Leave them out.";
        else if (!list.empty() && other.rfind(line.name, 0) == 0 &&
                 other.size() > line.name.size())
          return text + " but '" +
                 other.substr(line.name.size() - name.size()) +
                 "'. Separate names by commas, begin comments with #.";
      if (line.name == "Density" && entry)
        return text +
               ". Weight is a Load of Kind = body force, or Gravity with a "
               "Density in Material.";
      const std::string other = meant(line.name, names);
      if (!other.empty())
        return text + ". Did you mean '" + other + "'?";
      if (!list.empty())
        return text + ". Add it there, or remove the subsection.";
      if (const std::string section = section_with(prm, line.name);
          entry && !section.empty())
        return text + ". It belongs to " + section + ".";
      return text + ". Option --parameters lists what may stand there.";
    }

    /** " from 0 to 1" */
    std::string
    range(const ValueKind &kind)
    {
      if (kind.least.empty())
        return kind.most.empty() ? "" : ", " + kind.most + " or less";
      return kind.most.empty() ? ", " + kind.least + " or more" :
                                 " from " + kind.least + " to " + kind.most;
    }

    /** A pattern as a request. */
    std::string
    request(const std::string &pattern, const std::string &value)
    {
      using Type           = ValueKind::Type;
      const ValueKind kind = value_kind(pattern);
      switch (kind.type)
        {
          case Type::word:
            {
              const std::string other = nearest(value, kind.words);
              return (other.empty() ? "" : "Did you mean '" + other + "'? ") +
                     "Give one of: " + join(kind.words) + ".";
            }
          case Type::integer:
            return "Give a whole number" + range(kind) + ".";
          case Type::number:
            return "Give a number" + range(kind) + ".";
          case Type::boolean:
            return "Give true or false.";
          case Type::text:
            break;
        }
      return "Give what fits the pattern " + trim(pattern) + ".";
    }

    /** The value and the pattern that it does not match, of deal.II's text. */
    std::string
    mismatch(const std::string &message, const SceneLine &line)
    {
      const std::string pattern = "does not match the given pattern:";
      return line.name + in_section(line.path) + ": '" + value_of(line) +
             "' is not possible. " +
             request(message.substr(message.find(pattern) + pattern.size()),
                     value_of(line));
    }

    /** A hint for a line that is none. */
    std::string
    what_is_meant(const SceneLine &line)
    {
      const std::string word =
        line.text.substr(0, line.text.find_first_of(" ="));
      const std::string rest = trim(line.text.substr(word.size()));
      const auto        mark = line.text.find(':');
      if (line.kind == SceneLine::Kind::set && mark != line.text.npos)
        return "Write '" + trim(line.text.substr(0, mark)) + " = " +
               trim(line.text.substr(mark + 1)) + "'.";
      if (line.kind == SceneLine::Kind::set)
        return "It lacks the '=': write 'set Entry = value'.";
      for (const char *comment : {"//", "/*", "<!--", "--", ";", "%", "!", "*"})
        if (line.text.rfind(comment, 0) == 0)
          return "Comments begin with '#'.";
      if (line.text == "include")
        return "It lacks a file: write 'include FILE.prm'.";
      if (lower_case(word) == "subsection")
        return "It lacks a name: write 'subsection NAME'.";
      if (rest.rfind('=', 0) == 0 || line.text.find('=') != line.text.npos)
        if (n_changes(lower_case(word), "set") > 1)
          return "Write 'set " + line.text + "' to set an entry.";
      for (const char *keyword : {"set", "subsection", "end", "include"})
        if (n_changes(lower_case(word), keyword) <= 2)
          return std::string("Did you mean '") + keyword + "'?";
      return "Write 'set Entry = value', 'subsection NAME' or 'end'.";
    }
  } // namespace



  std::string
  misread(const SceneLine &line)
  {
    if (line.kind == SceneLine::Kind::set && value_of(line).rfind('=', 0) == 0)
      return "'" + line.text + "' has two equals signs. Write 'set " +
             line.name + " = " + trim(value_of(line).substr(1)) + "'.";
    return {};
  }



  std::string
  mistake(const Handler &prm, const SceneLine &line, const std::string &message)
  {
    if (message.find("does not match the given pattern") != message.npos)
      return mismatch(message, line);
    if (message.find("no such subsection") != message.npos ||
        message.find("No entry with name") != message.npos)
      return undeclared(prm, line);
    if (line.kind == SceneLine::Kind::end && line.text.size() > 3)
      return "'" + line.text + "' is not understood. Write 'end' alone.";
    if (line.kind == SceneLine::Kind::end)
      return "'" + line.text +
             "' ends no subsection. Remove it, or add "
             "the line 'subsection NAME' before.";
    return "'" + line.text + "' is not understood. " + what_is_meant(line);
  }



  std::string
  unbalanced(const SceneText &scene, const std::vector<SceneLine> &lines)
  {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].kind == SceneLine::Kind::subsection)
        open.push_back(i);
      else if (lines[i].kind == SceneLine::Kind::end && !open.empty())
        open.pop_back();
    if (open.empty())
      return scene.place(lines.size()) +
             ": an 'end' ends no subsection. Remove it.";
    return scene.place(open.back()) + ": subsection '" +
           lines[open.back()].name + "' has no 'end'. Add it.";
  }
} // namespace conetact::application
