// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/unv_file.h"

#include "conetact/base/deck_elements.h"
#include "conetact/base/deck_groups.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace conetact
{
  namespace
  {
    /** Elements by their number, with their nodes in the order of decks: those
     * of second order stand there round the element, corner by middle. */
    struct UnvKind
    {
      DeckKind                  deck;
      std::vector<unsigned int> order   = {}; ///< empty: as they are
      bool                      is_beam = false;
    };

    const UnvKind *
    unv_kind(const unsigned int number)
    {
      static const std::vector<unsigned int> tri6  = {0, 2, 4, 1, 3, 5};
      static const std::vector<unsigned int> quad8 = {0, 2, 4, 6, 1, 3, 5, 7};
      static const UnvKind line{{1, 2}, {}, true}, curve{{1, 3}, {}, true};
      static const UnvKind triangle{{2, 3}}, triangle_2{{2, 6}, tri6};
      static const UnvKind quad{{2, 4}}, quad_2{{2, 8}, quad8};
      static const UnvKind tetrahedron_2{{3, 10},
                                         {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}};
      static const UnvKind wedge_2{
        {3, 15}, {0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8}};
      static const UnvKind hexahedron_2{{3, 20},
                                        {0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                         5, 7, 13, 15, 17, 19, 8,  9,  10, 11}};
      static const UnvKind tetrahedron{{3, 4}}, wedge{{3, 6}},
        hexahedron{{3, 8}};
      static const std::map<unsigned int, const UnvKind *> kinds = {
        {11, &line},         {21, &line},          {22, &curve},
        {23, &curve},        {24, &curve},         {41, &triangle},
        {42, &triangle_2},   {44, &quad},          {45, &quad_2},
        {51, &triangle},     {52, &triangle_2},    {54, &quad},
        {55, &quad_2},       {81, &triangle},      {82, &triangle_2},
        {84, &quad},         {85, &quad_2},        {91, &triangle},
        {92, &triangle_2},   {94, &quad},          {95, &quad_2},
        {111, &tetrahedron}, {112, &wedge},        {113, &wedge_2},
        {115, &hexahedron},  {116, &hexahedron_2}, {118, &tetrahedron_2}};
      const auto found = kinds.find(number);
      return found == kinds.end() ? nullptr : found->second;
    }

    class UnvReader
    {
    public:
      explicit UnvReader(const std::string &contents)
        : stream(contents)
        , groups(mesh)
      {}

      FileMesh
      read()
      {
        try
          {
            while (next_line())
              if (line == "-1")
                read_dataset();
          }
        catch (const FileFault &fault)
          {
            throw FileFault{"line " + std::to_string(n_lines) + ": " +
                            fault.why};
          }
        if (mesh.elements.empty())
          throw FileFault{"it has no elements (dataset 2412)"};
        groups.find_faces_of_points();
        return std::move(mesh);
      }

    private:
      bool
      next_line()
      {
        if (!std::getline(stream, line))
          return false;
        ++n_lines;
        line = trim(line);
        return true;
      }
      /** The next line, which must be there. */
      void
      need_line()
      {
        if (!next_line() || line == "-1")
          throw FileFault{"the dataset " + dataset + " ends in the middle"};
      }

      /** Whether another line of the dataset comes. */
      bool
      is_in_dataset()
      {
        if (!next_line())
          throw FileFault{"the dataset " + dataset + " does not end"};
        return line != "-1";
      }

      void
      read_dataset()
      {
        if (!next_line())
          return;
        dataset = line;
        if (dataset == "2411" || dataset == "781")
          read_nodes();
        else if (dataset == "2412")
          read_elements();
        else if (dataset == "2467" || dataset == "2477" || dataset == "2452" ||
                 dataset == "2435")
          read_groups();
        else
          while (is_in_dataset())
            ;
      }

      void
      read_nodes()
      {
        while (is_in_dataset())
          {
            const unsigned int label = numbers(line, 1)[0];
            need_line();
            Point<3>           p;
            std::istringstream words(line);
            std::string        word;
            for (unsigned int d = 0; d < 3; ++d)
              p[d] = words >> word ? real(word) : 0;
            const auto point = static_cast<unsigned int>(mesh.points.size());
            if (!points.emplace(label, point).second)
              throw FileFault{"the node " + std::to_string(label) +
                              " stands there twice"};
            mesh.points.push_back(p);
          }
      }

      void
      read_elements()
      {
        while (is_in_dataset())
          {
            const auto     head = numbers(line, 6);
            const UnvKind *kind = unv_kind(head[1]);
            const auto     nodes =
              read_list(head[5], kind != nullptr && kind->is_beam);
            if (kind == nullptr)
              throw FileFault{"elements of the kind " +
                              std::to_string(head[1]) + " are not known"};
            if (nodes.size() != kind->deck.n_nodes)
              throw FileFault{"an element of the kind " +
                              std::to_string(head[1]) + " has " +
                              std::to_string(nodes.size()) + " nodes, not " +
                              std::to_string(kind->deck.n_nodes)};
            add_element(head[0], *kind, nodes);
          }
      }

      /** Numbers on as many lines as they need. */
      std::vector<unsigned int>
      read_list(const std::size_t n, const bool skips_line)
      {
        if (n > 1000)
          throw FileFault{std::to_string(n) +
                          " stands there instead of a number of nodes"};
        if (skips_line)
          need_line(); // where a beam is turned to
        std::vector<unsigned int> all;
        while (all.size() < n)
          {
            need_line();
            const auto more = numbers(line, 1);
            all.insert(all.end(), more.begin(), more.end());
          }
        return all;
      }

      void
      add_element(const unsigned int               label,
                  const UnvKind                   &kind,
                  const std::vector<unsigned int> &nodes)
      {
        std::vector<unsigned int> own;
        for (std::size_t i = 0; i < nodes.size(); ++i)
          {
            const unsigned int node =
              nodes[kind.order.empty() ? i : kind.order[i]];
            const auto found = points.find(node);
            if (found == points.end())
              throw FileFault{"the node " + std::to_string(node) +
                              " is not there"};
            own.push_back(found->second);
          }
        const auto number = static_cast<unsigned int>(mesh.elements.size());
        if (!elements.emplace(label, number).second)
          throw FileFault{"the element " + std::to_string(label) +
                          " stands there twice"};
        mesh.elements.push_back(deck_element(kind.deck, own));
      }

      /** A head with the number of members, a name, then members by four
       * numbers each: kind (7 a node, 8 an element), label, nothing. */
      void
      read_groups()
      {
        while (is_in_dataset())
          {
            const auto head = numbers(line, 8);
            need_line();
            const std::string         name = line;
            std::vector<unsigned int> members;
            while (members.size() < 4 * std::size_t{head[7]})
              {
                need_line();
                const auto more = numbers(line, 4);
                members.insert(members.end(), more.begin(), more.end());
              }
            name_members(name, members);
          }
      }

      void
      name_members(const std::string               &name,
                   const std::vector<unsigned int> &members)
      {
        std::set<unsigned int> nodes, cells;
        for (std::size_t i = 0; i + 1 < members.size(); i += 4)
          if (members[i] == 7 || members[i] == 8)
            {
              const auto &known = members[i] == 7 ? points : elements;
              const auto  found = known.find(members[i + 1]);
              if (found == known.end())
                throw FileFault{"the group '" + name + "' has the " +
                                (members[i] == 7 ? "node " : "element ") +
                                std::to_string(members[i + 1]) +
                                ", which is not there"};
              (members[i] == 7 ? nodes : cells).insert(found->second);
            }
        groups.add_elements(name, cells);
        groups.add_points(name, nodes);
      }

      /** At least `least` whole numbers from 0 on. */
      static std::vector<unsigned int>
      numbers(const std::string &text, const std::size_t least)
      {
        std::vector<unsigned int> result;
        std::istringstream        words(text);
        for (std::string word; words >> word;)
          {
            char        *end   = nullptr;
            const double value = std::strtod(word.c_str(), &end);
            if (*end != '\0' || !(value >= -2e9 && value <= 4e9) ||
                value != std::floor(value))
              throw FileFault{"'" + word.substr(0, 20) +
                              "' stands there instead of a whole number"};
            result.push_back(value < 0 ? 0 : static_cast<unsigned int>(value));
          }
        if (result.size() < least)
          throw FileFault{"there are " + std::to_string(result.size()) +
                          " numbers on it, not " + std::to_string(least)};
        return result;
      }

      static double
      real(const std::string &word)
      {
        const auto value = fortran_number(word);
        if (!value || !std::isfinite(*value))
          throw FileFault{"'" + word.substr(0, 20) +
                          "' stands there instead of a number"};
        return *value;
      }

      std::istringstream                   stream;
      std::string                          line, dataset;
      std::size_t                          n_lines = 0;
      FileMesh                             mesh;
      DeckGroups                           groups;
      std::map<unsigned int, unsigned int> points, elements; ///< by labels
    };
  } // namespace

  FileMesh
  read_unv(const std::string &contents)
  {
    return UnvReader(contents).read();
  }
} // namespace conetact
