// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/reader.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace conetact::bodies
{
  namespace
  {
    using Strings = std::vector<std::string>;

    /** A blank part after a last ';' is no item. */
    Strings
    items(const std::string &text)
    {
      Strings parts = split(text, ';');
      if (!parts.empty() && parts.back().empty())
        parts.pop_back();
      return parts;
    }

    /** Options after the section of a member. */
    struct Options
    {
      std::array<bool, 2> hinges = {{false, false}};
      BoundaryIds         ids;
      unsigned int        n_elements = 1;

      Options(const Strings &words, const std::string &entry)
      {
        for (auto word = words.begin() + 1; word < words.end(); ++word)
          {
            const std::string option = one_line(*word);
            const auto        blank  = option.find(' ');
            const std::string value =
              blank == option.npos ? "" : option.substr(blank + 1);
            if (option == "hinges" || option == "hinge start")
              hinges[0] = true;
            if (option == "hinges" || option == "hinge end")
              hinges[1] = true;
            else if (option.rfind("group ", 0) == 0)
              ids.merge(conetact::to_ids(value, entry));
            else if (option.rfind("elements ", 0) == 0)
              n_elements = *conetact::to_ids(value, entry).begin();
            else if (option != "hinge start")
              throw InputError(entry + ": '" + option +
                               "' is no option of a member. Give 'hinge "
                               "start', 'hinge end', 'hinges', 'group 5' or "
                               "'elements 10'.");
          }
        if (n_elements == 0 || n_elements > 1000000)
          throw InputError(entry +
                           ": a member has at least one element, and at most "
                           "1000000.");
      }
    };
  } // namespace

  FrameReader::FrameReader(FrameModel &frame)
    : model(frame)
  {}

  void
  FrameReader::read_nodes(const std::string &text, const std::string &entry)
  {
    for (const std::string &item : items(text))
      {
        const Strings parts = split(item, ':');
        if (parts.size() < 2 || parts.size() > 3)
          throw InputError(entry + ": '" + item +
                           "' is not 'name: coordinates' or 'name: "
                           "coordinates : ids', such as " +
                           (model.dim == 2 ? "7: 1.5, 0." : "7: 1.5, 0, 2."));
        add_node(parts[0],
                 parts[1],
                 parts.size() == 3 ? parts[2] : std::string(),
                 entry);
      }
  }

  void
  FrameReader::read_members(const std::string &text, const std::string &entry)
  {
    for (const std::string &item : items(text))
      {
        const auto colon = item.find(':');
        if (colon == item.npos)
          throw InputError(entry + ": '" + item +
                           "' is not 'a-b: section', two nodes and the name "
                           "of a section.");
        add_chain(split(item.substr(0, colon), '-'),
                  split(item.substr(colon + 1), ','),
                  entry);
      }
  }

  void
  FrameReader::read_file(const std::filesystem::path &file,
                         const std::string           &entry)
  {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
      throw InputError(entry + ": the file " + file.string() +
                       " cannot be read. Check its name and permissions.");
    std::string line;
    for (unsigned int number = 1; std::getline(stream, line); ++number)
      {
        const Strings     words = split(line.substr(0, line.find('#')), ',');
        const std::string at    = entry + " (" + file.string() + ", line " +
                               std::to_string(number) + ")";
        if (words.empty())
          continue;
        const Strings rest(words.begin() + 1, words.end());
        if (words[0] == "node" && rest.size() > model.dim)
          {
            const auto end_of_point =
              rest.begin() + 1 + static_cast<std::ptrdiff_t>(model.dim);
            add_node(rest[0],
                     join(Strings(rest.begin() + 1, end_of_point)),
                     join(Strings(end_of_point, rest.end())),
                     at);
          }
        else if (words[0] == "member" && rest.size() >= 3)
          add_chain({rest[0], rest[1]},
                    Strings(rest.begin() + 2, rest.end()),
                    at);
        else
          throw InputError(at + ": '" + trim(line) + "' is neither 'node, " +
                           "name, " + (model.dim == 2 ? "x, y" : "x, y, z") +
                           "[, id]' nor 'member, a, b, section[, option]'.");
      }
  }

  void
  FrameReader::add_node(const std::string &name,
                        const std::string &coordinates,
                        const std::string &ids,
                        const std::string &entry)
  {
    if (name.empty() || name.find_first_of("-:;, \t") != name.npos)
      throw InputError(entry + ": '" + name +
                       "' is not a node's name. Give a number or a word "
                       "without blanks, '-', ':', ';' and ','.");
    const auto number = static_cast<unsigned int>(model.nodes.size());
    if (!numbers.emplace(name, number).second)
      throw InputError(entry + ": node '" + name +
                       "' is defined twice. Give each node its own name.");
    FrameNode node;
    node.name = name;
    node.position =
      Point<3>(to_vector(coordinates, model.dim, entry + ", node " + name));
    if (!ids.empty())
      node.ids = conetact::to_ids(ids, entry + ", node " + name);
    model.nodes.push_back(node);
  }

  void
  FrameReader::add_chain(const Strings     &names,
                         const Strings     &words,
                         const std::string &entry)
  {
    const std::string what = entry + ", member " + join(names, "-");
    if (names.size() < 2)
      throw InputError(what + ": it has one node. Write 'a-b: section'.");
    if (words.empty() || words[0].empty())
      throw InputError(what + ": its section is missing. Write 'a-b: "
                              "section'.");
    const Options options(words, what);
    FrameMember   member;
    member.section = find_section(words[0], what);
    member.ids     = options.ids;
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
      {
        member.nodes = {
          {find_node(names[i], what), find_node(names[i + 1], what)}};
        member.hinges = {{i == 0 && options.hinges[0],
                          i + 2 == names.size() && options.hinges[1]}};
        add_member(member, options.n_elements);
      }
  }

  void
  FrameReader::add_member(const FrameMember &member, const unsigned int n)
  {
    const auto  ends  = member.nodes;
    FrameMember piece = member;
    BoundaryIds common;
    for (const unsigned int id : model.nodes[ends[0]].ids)
      if (model.nodes[ends[1]].ids.count(id) > 0)
        common.insert(id);
    for (unsigned int i = 0; i < n; ++i)
      {
        if (i + 1 < n)
          {
            const double s = double(i + 1) / n;
            FrameNode    node;
            node.name = model.nodes[ends[0]].name + "-" +
                        model.nodes[ends[1]].name + "." + std::to_string(i + 1);
            node.position  = Point<3>((1 - s) * model.nodes[ends[0]].position +
                                     s * model.nodes[ends[1]].position);
            node.ids       = common;
            node.between   = ends;
            piece.nodes[1] = static_cast<unsigned int>(model.nodes.size());
            model.nodes.push_back(node);
          }
        else
          piece.nodes[1] = ends[1];
        piece.hinges = {
          {i == 0 && member.hinges[0], i + 1 == n && member.hinges[1]}};
        model.members.push_back(piece);
        piece.nodes[0] = piece.nodes[1];
      }
  }

  unsigned int
  FrameReader::find_node(const std::string &name,
                         const std::string &entry) const
  {
    const auto found = numbers.find(name);
    if (found == numbers.end())
      throw InputError(entry + ": there is no node '" + name +
                       "'. Define it before the members, or correct its "
                       "name.");
    return found->second;
  }

  unsigned int
  FrameReader::find_section(const std::string &name,
                            const std::string &entry) const
  {
    Strings names;
    for (const FrameSection &section : model.sections)
      names.push_back(section.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw InputError(entry + ": there is no section '" + name +
                       "'. Give one of: " + join(names) + ".");
    return static_cast<unsigned int>(found - names.begin());
  }
} // namespace conetact::bodies
