// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/generators.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/process.h"
#include "conetact/base/text.h"

#include <cmath>

namespace conetact::bodies
{
  namespace
  {
    using Arguments = std::vector<std::string>;

    unsigned int
    to_count(const std::string &text, const std::string &entry)
    {
      const double n = to_number(text, entry);
      if (!(n >= 1 && n <= 1e6 && n == std::floor(n)))
        throw InputError(entry + ": '" + text +
                         "' is not a number of pieces. Give a whole number "
                         "from 1 to 1000000.");
      return static_cast<unsigned int>(n);
    }

    void
    check_room(const double n_members, const std::string &entry)
    {
      constexpr double bytes_of_member = 800; // and its nodes, at least
      if (n_members * bytes_of_member > machine_memory())
        throw InputError(entry + ": a frame of " + to_text(n_members) +
                         " members has no room in the memory. Give a smaller "
                         "number.");
    }

    [[noreturn]] void
    throw_arguments(const std::string &where,
                    const std::string &name,
                    const std::string &expected)
    {
      throw InputError(where + "Arguments: '" + name + "' takes " + expected +
                       ".");
    }

    /** Nodes from a to b in n equal members; ids 1 and 2 at the ends. */
    void
    generate_line(const Arguments   &arguments,
                  const std::string &where,
                  FrameModel        &model)
    {
      if (arguments.size() != 3)
        throw_arguments(where,
                        "line",
                        "two points and the number of members, such as "
                        "0, 0 : 0, 5 : 20");
      const std::string entry = where + "Arguments";
      const auto        a     = to_vector(arguments[0], model.dim, entry);
      const auto        b     = to_vector(arguments[1], model.dim, entry);
      const auto        n     = to_count(arguments[2], entry);
      for (unsigned int i = 0; i <= n; ++i)
        {
          FrameNode node;
          node.name = std::to_string(i);
          node.position =
            Point<3>(a * (double(n - i) / n) + b * (double(i) / n));
          node.ids = {0};
          model.nodes.push_back(node);
        }
      model.nodes.front().ids.insert(1);
      model.nodes.back().ids.insert(2);
      for (unsigned int i = 0; i < n; ++i)
        {
          FrameMember member;
          member.nodes = {{i, i + 1}};
          model.members.push_back(member);
        }
    }

    /** A layer of n x n nodes about the origin; returns the first's number. */
    unsigned int
    add_layer(FrameModel        &model,
              const unsigned int n,
              const double       a,
              const double       b,
              const double       z,
              const unsigned int id)
    {
      const auto first = static_cast<unsigned int>(model.nodes.size());
      const auto share = [n](const unsigned int i) {
        return n == 1 ? 0. : i == 0 || i + 1 == n ? .5 : 1.;
      };
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            FrameNode node;
            node.name = std::string(id == 1 ? "l" : "u") + std::to_string(i) +
                        "_" + std::to_string(j);
            node.position = {a * (i - .5 * (n - 1)), b * (j - .5 * (n - 1)), z};
            node.ids      = {id};
            node.area     = n == 1 ? a * b : a * b * share(i) * share(j);
            node.normal[2] = id == 1 ? -1 : 1;
            model.nodes.push_back(node);
          }
      return first;
    }

    void
    add_member(FrameModel &model, const unsigned int a, const unsigned int b)
    {
      FrameMember member;
      member.nodes = {{a, b}};
      model.members.push_back(member);
    }

    void
    connect_layer(FrameModel        &model,
                  const unsigned int first,
                  const unsigned int n)
    {
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int node = first + i + n * j;
            if (i + 1 < n)
              add_member(model, node, node + 1);
            if (j + 1 < n)
              add_member(model, node, node + n);
          }
    }

    /** The grids of [K] 5.3. */
    void
    generate_double_layer_grid(const Arguments   &arguments,
                               const std::string &where,
                               FrameModel        &model)
    {
      const std::string entry = where + "Arguments";
      if (model.dim != 3)
        throw InputError(where + "Generator: a double layer grid needs " +
                         "Dimension = 3.");
      const auto sizes = arguments.size() == 3 ?
                           to_numbers(arguments[1], entry) :
                           std::vector<double>();
      if (sizes.size() != 2)
        throw_arguments(where,
                        "double layer grid",
                        "the number of lower nodes a side, the cell's size "
                        "along x and y, and the height, such as 7 : 2, 3 : 2");
      const unsigned int n = to_count(arguments[0], entry);
      const double       h = to_number(arguments[2], entry);
      if (!(sizes[0] > 0 && sizes[1] > 0 && h > 0))
        throw InputError(entry + ": lengths must be above 0.");
      check_room(8. * n * n, entry);

      const unsigned int lower = add_layer(model, n, sizes[0], sizes[1], 0, 1);
      const unsigned int upper =
        add_layer(model, n + 1, sizes[0], sizes[1], h, 2);
      connect_layer(model, lower, n);
      connect_layer(model, upper, n + 1);
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          for (const unsigned int k : {0u, 1u, n + 1, n + 2})
            add_member(model, lower + i + n * j, upper + i + (n + 1) * j + k);
    }
  } // namespace

  const std::vector<FrameGenerator> &
  frame_generators()
  {
    static const std::vector<FrameGenerator> table = {
      {"line",
       "a straight line of members, 'x0, y0 : x1, y1 : members' (3D: three "
       "coordinates a point); boundary id 0 is all of it, 1 its first node, 2 "
       "its last one",
       &generate_line},
      {"double layer grid",
       "3D space truss 'n : a, b : h' of two square grids: a lower layer of n "
       "x n nodes at z = 0 about the origin (boundary id 1), an upper one of "
       "(n + 1) x (n + 1) nodes at z = h (boundary id 2) that reaches half a "
       "cell beyond it, cells of a x b, and four diagonals from each lower "
       "node. The area of a node is a b, half of it on edges, a quarter at "
       "corners",
       &generate_double_layer_grid}};
    return table;
  }
} // namespace conetact::bodies
