// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_text.h"

#include "conetact/base/errors.h"
#include "conetact/base/nearest.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <utility>

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    /** One line of a scene and where it stands. */
    struct Line
    {
      enum class Kind
      {
        none, ///< blank or a comment
        set,
        subsection,
        end,
        unknown
      };
      Kind                     kind = Kind::none;
      std::string              name, text;
      std::vector<std::string> path; ///< of subsections around it
    };

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
    path_of(const Line &line)
    {
      return join(line.path, "/") + (line.path.empty() ? "" : "/") + line.name;
    }

    std::string
    without_comment(const std::string &line)
    {
      return trim(line.substr(0, line.find('#')));
    }

    /** Far more than any scene has inside of each other. */
    constexpr std::size_t most_sections = 20;

    [[noreturn]] void
    refuse_depth(const std::string &place)
    {
      throw InputError(place + ": more than " + std::to_string(most_sections) +
                       " subsections are open. Add the 'end' of each.");
    }

    std::vector<Line>
    read_lines(const std::string &text, const SceneText *scene = nullptr)
    {
      std::vector<Line>        lines;
      std::vector<std::string> path;
      std::istringstream       stream(text);
      for (std::string raw; std::getline(stream, raw);)
        {
          Line line;
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
              line.kind = Line::Kind::set;
              line.name = trim(line.name.substr(0, line.name.find('=')));
            }
          else if (starts_with(line.text, "subsection", line.name))
            {
              line.kind = Line::Kind::subsection;
              if (path.size() == most_sections)
                refuse_depth(scene != nullptr ? scene->place(lines.size()) :
                                                "the scene");
              path.push_back(line.name);
            }
          else if (starts_with(line.text, "end", line.name))
            {
              line.kind = Line::Kind::end;
              if (!path.empty())
                path.pop_back();
            }
          else if (!line.text.empty())
            line.kind = Line::Kind::unknown;
          lines.push_back(std::move(line));
          lines.resize(lines.size() + n_lines - 1);
        }
      return lines;
    }

    /** Declared names of one kind in the subsection `path`. */
    std::vector<std::string>
    declared(const Handler                  &prm,
             const Line::Kind                kind,
             const std::vector<std::string> &path)
    {
      std::ostringstream stream;
      prm.print_parameters(stream, Handler::ShortText);
      std::vector<std::string> names;
      for (const Line &line : read_lines(stream.str()))
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

    std::string
    in_section(const std::vector<std::string> &path)
    {
      return path.empty() ? "" : " in '" + join(path, "/") + "'";
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

    /** "Contact bottom" belongs to the list Contacts. */
    std::string
    list_of(const std::string &subsection, std::string &name)
    {
      for (const auto &[kind, list] : {std::make_pair("Body ", "Bodies"),
                                       std::make_pair("Obstacle ", "Obstacles"),
                                       std::make_pair("Contact ", "Contacts"),
                                       std::make_pair("Support ", "Supports"),
                                       std::make_pair("Load ", "Loads")})
        if (subsection.rfind(kind, 0) == 0)
          {
            name = subsection.substr(std::string(kind).size());
            return list;
          }
      return {};
    }

    /** The section that has an entry of this name, for one that has not. */
    std::string
    section_with(const Handler &prm, const std::string &entry)
    {
      std::ostringstream stream;
      prm.print_parameters(stream, Handler::ShortText);
      for (const Line &line : read_lines(stream.str()))
        if (line.kind == Line::Kind::set && line.name == entry)
          return line.path.empty() ? "the scene, outside of all sections" :
                                     "'" + join(line.path, "/") + "'";
      return {};
    }

    std::string
    undeclared(const Handler &prm, const Line &line)
    {
      std::string       name;
      const bool        entry = line.kind == Line::Kind::set;
      const std::string what  = entry ? "entry" : "subsection";
      std::string       text =
        "there is no " + what + " '" + line.name + "'" + in_section(line.path);
      const std::string list =
        line.path.empty() && !entry ? list_of(line.name, name) : "";
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
        return text + ". Weight is a Load of Kind = body force.";
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

    /** "[Double 0...1 (inclusive)]" as a request. */
    std::string
    request(std::string pattern, const std::string &value)
    {
      pattern = trim(pattern);
      if (pattern.size() > 1 && pattern.front() == '[' && pattern.back() == ']')
        pattern = trim(pattern.substr(1, pattern.size() - 2));
      const auto behind = [&](const std::string &start) {
        return trim(pattern.substr(start.size()));
      };
      const auto is = [&](const std::string &start) {
        return pattern.rfind(start, 0) == 0;
      };
      const auto range = [](std::string text) {
        text            = text.substr(0, text.find(" (inclusive)"));
        const auto dots = text.find("...");
        if (dots == text.npos)
          return std::string();
        const std::string upper = text.substr(dots + 3);
        return upper == "2147483647" || upper == "MAX_DOUBLE" ?
                 ", " + text.substr(0, dots) + " or more" :
                 " from " + text.substr(0, dots) + " to " + upper;
      };
      if (is("Selection"))
        {
          const auto        names = split(behind("Selection"), '|');
          const std::string other = nearest(value, names);
          return (other.empty() ? "" : "Did you mean '" + other + "'? ") +
                 "Give one of: " + join(names) + ".";
        }
      if (is("Integer range"))
        return "Give a whole number" + range(behind("Integer range")) + ".";
      if (is("Integer"))
        return "Give a whole number.";
      if (is("Double"))
        return "Give a number" + range(behind("Double")) + ".";
      if (is("Bool"))
        return "Give true or false.";
      return "Give what fits the pattern " + pattern + ".";
    }

    /** An entry, or one of its values, that is not of this program any more. */
    struct MovedEntry
    {
      const char *section, *name;
      const char *value; ///< empty: any
      const char *text;  ///< where it is, what to do
    };
    const MovedEntry moved_entries[] = {
      {"Solver",
       "Method",
       "lemke",
       "Lemke's method of [P] is in conetact-reproductions: choose load path "
       "with Output/Text increments = all, then run 'conetact-reproductions "
       "lemke' on the problem files."},
      {"Solver",
       "Tightening weight",
       "",
       "Lemke's method of [P] is in conetact-reproductions, whose option "
       "--weight this is. Remove the entry."},
      {"Solver",
       "Scaling",
       "",
       "smoothing is always free of units; the published form of [K] is in "
       "conetact-reproductions: remove the entry, set Output/Text increments = "
       "all and run 'conetact-reproductions smoothing' on the problem files."}};

    std::string
    value_of(const Line &line)
    {
      const auto equals = line.text.find('=');
      return equals == line.text.npos ? "" : trim(line.text.substr(equals + 1));
    }

    /** Where a moved entry is; empty for all others. */
    std::string
    moved(const Line &line)
    {
      for (const MovedEntry &entry : moved_entries)
        if (line.kind == Line::Kind::set &&
            line.path == std::vector<std::string>{entry.section} &&
            line.name == entry.name &&
            (*entry.value == 0 || value_of(line) == entry.value))
          return std::string(entry.section) + '/' + entry.name + ": " +
                 entry.text;
      return {};
    }

    /** What no value may be, whatever the entry; empty: nothing. */
    std::string
    misread(const Line &line)
    {
      if (line.kind == Line::Kind::set && value_of(line).rfind('=', 0) == 0)
        return "'" + line.text + "' has two equals signs. Write 'set " +
               line.name + " = " + trim(value_of(line).substr(1)) + "'.";
      return {};
    }

    /** The value and the pattern that it does not match, of deal.II's text. */
    std::string
    mismatch(const std::string &message, const Line &line)
    {
      const std::string pattern = "does not match the given pattern:";
      return line.name + in_section(line.path) + ": '" + value_of(line) +
             "' is not possible. " +
             request(message.substr(message.find(pattern) + pattern.size()),
                     value_of(line));
    }

    /** A hint for a line that is none. */
    std::string
    what_is_meant(const Line &line)
    {
      const std::string word =
        line.text.substr(0, line.text.find_first_of(" ="));
      const std::string rest = trim(line.text.substr(word.size()));
      const auto        mark = line.text.find(':');
      if (line.kind == Line::Kind::set && mark != line.text.npos)
        return "Write '" + trim(line.text.substr(0, mark)) + " = " +
               trim(line.text.substr(mark + 1)) + "'.";
      if (line.kind == Line::Kind::set)
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

    std::string
    sentence(const Handler &prm, const Line &line, const std::string &message)
    {
      if (const std::string elsewhere = moved(line); !elsewhere.empty())
        return elsewhere;
      if (message.find("does not match the given pattern") != message.npos)
        return mismatch(message, line);
      if (message.find("no such subsection") != message.npos ||
          message.find("No entry with name") != message.npos)
        return undeclared(prm, line);
      if (line.kind == Line::Kind::end && line.text.size() > 3)
        return "'" + line.text + "' is not understood. Write 'end' alone.";
      if (line.kind == Line::Kind::end)
        return "'" + line.text +
               "' ends no subsection. Remove it, or add "
               "the line 'subsection NAME' before.";
      return "'" + line.text + "' is not understood. " + what_is_meant(line);
    }

    /** Where a subsection that is not ended begins. */
    std::string
    unbalanced(const SceneText &scene, const std::vector<Line> &lines)
    {
      std::vector<std::size_t> open;
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (lines[i].kind == Line::Kind::subsection)
          open.push_back(i);
        else if (lines[i].kind == Line::Kind::end && !open.empty())
          open.pop_back();
      if (open.empty())
        return scene.place(lines.size()) +
               ": an 'end' ends no subsection. Remove it.";
      return scene.place(open.back()) + ": subsection '" +
             lines[open.back()].name + "' has no 'end'. Add it.";
    }

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
    const std::vector<Line> lines = read_lines(scene.text, &scene);
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
                           sentence(prm, lines[number - 1], message));
        if (message.find("unequal numbers of 'subsection'") != message.npos)
          throw InputError(unbalanced(scene, lines));
        throw InputError(scene.place(0) + ": " + message);
      }
  }

  void
  refuse_repeats(const SceneText &scene)
  {
    const std::vector<Line>            lines = read_lines(scene.text, &scene);
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        const Line &line  = lines[i];
        const bool  entry = line.kind == Line::Kind::set;
        if (!entry && line.kind != Line::Kind::subsection)
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
    const std::vector<Line>    lines = read_lines(scene.text, &scene);
    std::optional<std::size_t> place;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if ((lines[i].kind == Line::Kind::set ||
           lines[i].kind == Line::Kind::subsection) &&
          path_of(lines[i]) == path)
        place = i;
    return place;
  }

  Entries
  entries_of(const std::string &text)
  {
    Entries entries;
    for (const Line &line : read_lines(text))
      if (line.kind == Line::Kind::set)
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

    Line line;
    line.kind = Line::Kind::set;
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
            line.kind = Line::Kind::subsection;
            line.name = path[number - 1];
            line.path.resize(number - 1);
          }
        throw InputError(start + sentence(prm, line, message));
      }
  }
} // namespace conetact::application
