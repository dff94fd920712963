// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/nastran_cards.h"

#include "conetact/base/file_mesh.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <vector>

namespace conetact
{
  namespace
  {
    using Fields = std::vector<std::string>;

    /** How many nodes a cell has: corners alone, or with middles of edges. */
    struct Counts
    {
      std::size_t least, most;
      bool        are_last; ///< nothing stands behind the nodes
    };
    const std::map<std::string, Counts> &
    nastran_cells()
    {
      static const std::map<std::string, Counts> all = {
        {"CTRIA3", {3, 3, false}},
        {"CTRIA6", {6, 6, false}},
        {"CQUAD4", {4, 4, false}},
        {"CQUAD8", {8, 8, false}},
        {"CTETRA", {4, 10, true}},
        {"CPYRAM", {5, 13, true}},
        {"CPENTA", {6, 15, true}},
        {"CHEXA", {8, 20, true}}};
      return all;
    }

    /** Without its comment; a tab goes to the next column of eight. */
    std::string
    without_comment(const std::string &line)
    {
      std::string text;
      for (const char c : line.substr(0, line.find('$')))
        if (c == '\t')
          text.append(8 - text.size() % 8, ' ');
        else if (c != '\r')
          text += c;
      return text;
    }

    /** Of eight columns each, or of sixteen in lines with an asterisk. */
    Fields
    columns(const std::string &line, const bool are_wide)
    {
      Fields            fields{trim(line.substr(0, 8))};
      const std::size_t width = are_wide ? 16 : 8;
      for (std::size_t at = 8; at < std::min<std::size_t>(line.size(), 72);
           at += width)
        fields.push_back(trim(line.substr(at, width)));
      return fields;
    }

    /** The name, or the mark of a line that follows, and the fields behind it,
     * without what marks that another line follows. */
    Fields
    fields_of(const std::string &line)
    {
      const bool are_wide =
        line.substr(0, std::min<std::size_t>(line.find(','), 8)).find('*') !=
        line.npos;
      if (line.find(',') == line.npos)
        return columns(line, are_wide);
      Fields             fields;
      std::istringstream rest(line);
      for (std::string field; std::getline(rest, field, ',');)
        fields.push_back(trim(field));
      if (const std::size_t n = are_wide ? 5 : 9; fields.size() == n + 1)
        fields.pop_back();
      return fields;
    }

    bool
    follows(const std::string &line)
    {
      if (trim(line).empty())
        return false;
      const std::string first = fields_of(line)[0];
      return first.empty() || first[0] == '+' || first[0] == '*';
    }

    std::string
    name_in(const Fields &fields)
    {
      std::string name = fields[0].substr(0, fields[0].find('*'));
      for (char &c : name)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      return trim(name);
    }

    bool
    is_number(const std::string &field)
    {
      return !field.empty() &&
             std::all_of(field.begin(), field.end(), [](const unsigned char c) {
               return std::isdigit(c) != 0;
             });
    }

    /** Of the card behind its name: number, property and nodes. */
    Fields
    nodes_in(const std::string &name, const Fields &card, const Counts &counts)
    {
      Fields nodes;
      for (std::size_t i = 2; i < card.size(); ++i)
        {
          if (!counts.are_last && nodes.size() == counts.most)
            break;
          if (!card[i].empty() && !is_number(card[i]))
            break; // such as CORDM
          if (!card[i].empty())
            nodes.push_back(card[i]);
        }
      if (nodes.size() != counts.least && nodes.size() != counts.most)
        throw FileFault{"the " + name + (card.empty() ? "" : " " + card[0]) +
                        " has " + std::to_string(nodes.size()) +
                        " nodes, and one has " + std::to_string(counts.least) +
                        (counts.most > counts.least ?
                           " or " + std::to_string(counts.most) :
                           "")};
      return nodes;
    }

    void
    write_fields(const std::string &name,
                 const Fields      &fields,
                 std::ostream      &out)
    {
      constexpr std::size_t in_line = 8;
      out << name;
      for (std::size_t i = 0; i < fields.size(); ++i)
        out << (i > 0 && i % in_line == 0 ? ",+\n+," : ",") << fields[i];
      out << '\n';
    }

    /** Of the lines of a deck. */
    class Cards
    {
    public:
      explicit Cards(const std::string &deck)
        : rest(deck)
      {
        next();
      }

      std::string
      whole()
      {
        std::ostringstream out;
        while (has_line)
          {
            const std::string text = without_comment(line);
            const auto        kind = trim(text).empty() ?
                                       nastran_cells().end() :
                                       nastran_cells().find(name_in(fields_of(text)));
            if (kind != nastran_cells().end())
              write_card(kind->first, kind->second, out);
            else
              {
                out << line << '\n';
                next();
              }
          }
        return out.str();
      }

    private:
      void
      next()
      {
        has_line = static_cast<bool>(std::getline(rest, line));
      }

      void
      write_card(const std::string &name,
                 const Counts      &counts,
                 std::ostream      &out)
      {
        Fields card;
        do
          {
            const Fields more = fields_of(without_comment(line));
            card.insert(card.end(), more.begin() + 1, more.end());
            next();
            while (has_line && trim(without_comment(line)).empty())
              next();
          }
        while (has_line && follows(without_comment(line)));
        const Fields nodes = nodes_in(name, card, counts);
        Fields       fields(card.begin(), card.begin() + 2);
        fields.insert(fields.end(), nodes.begin(), nodes.end());
        write_fields(name, fields, out);
      }

      std::istringstream rest;
      std::string        line;
      bool               has_line = false;
    };
  } // namespace

  std::string
  with_whole_cards(const std::string &deck)
  {
    return Cards(deck).whole();
  }
} // namespace conetact
