// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/generator_arguments.h"

#include "conetact/base/errors.h"
#include "conetact/base/nearest.h"
#include "conetact/base/process.h"
#include "conetact/base/text.h"
#include "conetact/bodies/continuum/generator_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

namespace conetact::bodies
{
  namespace
  {
    /** Lengths whose cube is still a number, and its inverse. */
    constexpr double largest_length = 1e90;

    /** Blocks of fewer cells keep nodes that are numbered line by line. */
    constexpr double many_cells = 5e4;

    /** Of a mesh and of the body that is made of it, at least [bytes]. */
    double
    bytes_of_cell(const unsigned int dim)
    {
      return dim == 2 ? 400 : 1200;
    }

    /** What is wrong with an argument and what to do, as a sentence. */
    [[noreturn]] void
    refuse(const MeshParameters &mesh,
           const std::string    &text,
           const std::string    &fault)
    {
      throw InputError(mesh.where + "Arguments: '" + text + "' " + fault);
    }

    /** A number, if it is nothing but a number. */
    std::optional<double>
    read_number(const std::string &text)
    {
      char        *end    = nullptr;
      const double number = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != 0)
        return {};
      return number;
    }

    /** Whole numbers as deal.II reads them: 10, but not 1e1. */
    bool
    is_whole(const std::string &text)
    {
      return !text.empty() && text.size() < 10 &&
             text.find_first_not_of("0123456789") == std::string::npos;
    }

    std::vector<std::string>
    parts_of(std::string argument)
    {
      std::replace(argument.begin(), argument.end(), ';', ',');
      return split(argument, ',');
    }

    /** Those that are no numbers are left to deal.II to refuse. */
    std::vector<double>
    finite_numbers(const MeshParameters &mesh, const std::string &argument)
    {
      std::vector<double> numbers;
      for (const std::string &part : parts_of(argument))
        if (const auto number = read_number(part))
          {
            if (!(std::abs(*number) <= largest_length))
              refuse(mesh,
                     part,
                     "is too large or not a number. Give finite numbers.");
            numbers.push_back(*number);
          }
      return numbers;
    }

    std::vector<double>
    whole_numbers(const MeshParameters &mesh,
                  const std::string    &argument,
                  const unsigned int    least)
    {
      std::vector<double> numbers;
      for (const std::string &part : parts_of(argument))
        {
          if (!is_whole(part) || std::stoul(part) < least)
            refuse(mesh,
                   part,
                   "is not a number of cells. Give whole numbers from " +
                     std::to_string(least) + " to 999999999.");
          numbers.push_back(static_cast<double>(std::stoul(part)));
        }
      return numbers;
    }

    void
    check_count(const MeshParameters &mesh,
                const std::string    &argument,
                const std::size_t     found,
                const std::size_t     wanted,
                const char           *what)
    {
      if (found != wanted)
        refuse(mesh,
               argument,
               "has " + std::to_string(found) + ' ' + what + ". " +
                 mesh.generator + " takes " + std::to_string(wanted) + '.');
    }

    /** Numbers of cells, or the lengths of all cells of each direction. */
    std::vector<double>
    cells_or_steps(const MeshParameters &mesh,
                   const std::string    &argument,
                   const unsigned int    dim)
    {
      if (argument.find(';') == std::string::npos)
        {
          const auto cells = whole_numbers(mesh, argument, 1);
          check_count(mesh, argument, cells.size(), dim, "numbers of cells");
          return cells;
        }
      const auto lists = split(argument, ';');
      check_count(mesh, argument, lists.size(), dim, "lists of steps");
      std::vector<double> cells;
      for (const std::string &list : lists)
        {
          const auto steps = finite_numbers(mesh, list);
          if (steps.empty() ||
              *std::min_element(steps.begin(), steps.end()) <= 0)
            refuse(mesh, list, "are not steps. Give lengths above 0.");
          cells.push_back(static_cast<double>(steps.size()));
        }
      return cells;
    }

    std::vector<double>
    one_number(const MeshParameters &mesh,
               const std::string    &argument,
               const char            kind)
    {
      const auto numbers = finite_numbers(mesh, argument);
      if (numbers.size() == 1 && kind != 'x' &&
          (numbers[0] < 0 || (kind == 'r' && numbers[0] < 1 / largest_length)))
        refuse(mesh,
               argument,
               kind == 'r' ? "is not positive. Give a number above 0." :
                             "is negative. Give a number from 0 on.");
      return numbers;
    }

    std::vector<double>
    points(const MeshParameters &mesh,
           const std::string    &argument,
           const std::size_t     n)
    {
      check_count(mesh, argument, split(argument, ';').size(), n, "points");
      return finite_numbers(mesh, argument);
    }

    std::vector<double>
    read_argument(const MeshParameters &mesh,
                  const std::string    &argument,
                  const char            kind,
                  const unsigned int    dim)
    {
      std::vector<double> numbers;
      switch (kind)
        {
          case 'n':
            return whole_numbers(mesh, argument, 1);
          case 'd':
          case 'i':
            return whole_numbers(mesh, argument, 0);
          case 'c':
            numbers = whole_numbers(mesh, argument, 1);
            check_count(mesh, argument, numbers.size(), dim, "numbers");
            return numbers;
          case 'C':
            numbers = whole_numbers(mesh, argument, 0);
            check_count(mesh, argument, numbers.size(), 2 * dim, "numbers");
            return numbers;
          case 's':
            return cells_or_steps(mesh, argument, dim);
          case 'S':
            return points(mesh, argument, dim + 1);
          case 'V':
            return points(mesh, argument, 1u << dim);
          case 'p':
          case 'b':
            return finite_numbers(mesh, argument);
          default:
            return one_number(mesh, argument, kind);
        }
    }

    /** Those that can be made of hexahedra around a hollow sphere. */
    void
    check_shell(const GeneratorRow   &row,
                const MeshParameters &mesh,
                const Numbers        &a)
    {
      const std::string name = row.name;
      const auto        n    = [&](const std::size_t i) {
        return static_cast<unsigned int>(a[i][0]);
      };
      std::set<unsigned int> allowed;
      unsigned int           given = 0;
      if (name == "half_hyper_shell")
        allowed = {0, 5}, given = n(3);
      else if (name == "quarter_hyper_shell")
        allowed = {0, 3}, given = n(3);
      else if (name == "hyper_shell" || name == "concentric_hyper_shells")
        {
          allowed = {0, 6, 12, 24, 48, 96, 192, 384, 768, 1536, 3072};
          given   = n(name == "hyper_shell" ? 3 : 5);
        }
      if (!allowed.empty() && allowed.count(given) == 0)
        refuse(mesh,
               std::to_string(given),
               "cells do not make a " + name + " in 3D. Give one of " +
                 join(allowed) + '.');
    }

    bool
    is_complete(const Numbers &a, const std::string &kinds)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].empty() && kinds[i] != 'b')
          return false;
      return true;
    }

    /** Lengths of the cells of a block lead from one end to the other. */
    void
    check_steps(const MeshParameters &mesh,
                const std::string    &argument,
                const Numbers        &ends)
    {
      const auto lists = split(argument, ';');
      for (std::size_t d = 0; d < lists.size(); ++d)
        {
          const double length = std::abs(ends[1][d] - ends[0][d]);
          double       sum    = 0;
          for (const double step : finite_numbers(mesh, lists[d]))
            sum += step;
          if (!(std::abs(sum - length) <= 1e-9 * length))
            refuse(mesh,
                   lists[d],
                   "adds up to " + to_text(sum) + ", and the block is " +
                     to_text(length) +
                     " long there. Give the lengths of all its cells, or "
                     "numbers of cells with ',' between them.");
        }
    }

    /** Of a block: cells and ends of its sides; one for all of a cube. */
    struct Sides
    {
      std::vector<double> cells, begin, end;

      /* deal.II gives cells on either side of the coordinate planes materials
         of their own. */
      bool
      can_be_halved() const
      {
        for (std::size_t d = 0; d < cells.size(); ++d)
          {
            if (std::fmod(cells[d], 2) != 0)
              return false;
            const auto [lower, upper] = std::minmax({begin[d], end[d]});
            const double plane        = -lower / (upper - lower) * cells[d] / 2;
            if (lower < 0 && upper > 0 &&
                std::abs(plane - std::round(plane)) > 1e-6)
              return false;
          }
        return true;
      }
    };

    void
    check_row(const GeneratorRow             &row,
              const MeshParameters           &mesh,
              const std::vector<std::string> &arguments,
              const unsigned int              dim)
    {
      const std::string kinds = row.kinds;
      if (arguments.size() != kinds.size())
        return; // deal.II says how many there should be
      Numbers a;
      for (std::size_t i = 0; i < kinds.size(); ++i)
        a.push_back(read_argument(mesh, arguments[i], kinds[i], dim));
      if (!is_complete(a, kinds))
        return; // words instead of numbers
      if (row.smaller >= 0)
        {
          const auto i = static_cast<std::size_t>(row.smaller);
          const auto k = static_cast<std::size_t>(row.larger);
          if (!(a[i][0] < a[k][0]))
            refuse(mesh,
                   arguments[i],
                   "is not smaller than '" + arguments[k] + "', as " +
                     mesh.generator + " wants it. Change one of them.");
        }
      if (kinds[0] == 's' && arguments[0].find(';') != std::string::npos &&
          a[1].size() == dim && a[2].size() == dim)
        check_steps(mesh, arguments[0], {a[1], a[2]});
      if (dim == 3)
        check_shell(row, mesh, a);
      check_mesh_size(mesh, dim, row.n_cells(a, dim), "Arguments");
    }
  } // namespace

  void
  check_generator_arguments(const MeshParameters &parameters,
                            const unsigned int    dim)
  {
    const std::vector<std::string> arguments = split(parameters.arguments, ':');
    for (const std::string &argument : arguments)
      finite_numbers(parameters, argument);
    for (const GeneratorRow &row : generator_table())
      if (row.name == parameters.generator)
        check_row(row, parameters, arguments, dim);
  }

  void
  refine_instead(MeshParameters &mesh, const unsigned int dim)
  {
    const bool is_cube = mesh.generator == "subdivided_hyper_cube";
    if ((!is_cube && mesh.generator != "subdivided_hyper_rectangle") ||
        mesh.cells == MeshParameters::Cells::simplices)
      return;
    std::vector<std::string> arguments = split(mesh.arguments, ':');
    if (arguments.size() != 4 || arguments[0].find(';') != std::string::npos)
      return; // lengths of all cells, or words
    Sides sides = {whole_numbers(mesh, arguments[0], 1),
                   finite_numbers(mesh, arguments[1]),
                   finite_numbers(mesh, arguments[2])};
    for (const auto *const numbers : {&sides.cells, &sides.begin, &sides.end})
      if (numbers->size() != (is_cube ? 1 : dim))
        return;
    if ((is_cube ? std::pow(sides.cells[0], dim) : product(sides.cells)) <
        many_cells)
      return;
    for (; sides.can_be_halved(); ++mesh.global_refinements)
      for (double &number : sides.cells)
        number /= 2;
    std::vector<std::string> cells;
    for (const double number : sides.cells)
      cells.push_back(std::to_string(std::lround(number)));
    arguments[0]   = join(cells);
    mesh.arguments = join(arguments, " : ");
  }

  std::string
  generator_hint(const std::string &name)
  {
    std::vector<std::string> names;
    for (const GeneratorRow &row : generator_table())
      names.emplace_back(row.name);
    const std::string other = nearest(name, names);
    if (other == name)
      return "There is one of the other dimension. ";
    return other.empty() ? "" : "Did you mean '" + other + "'? ";
  }

  void
  check_mesh_size(const MeshParameters &parameters,
                  const unsigned int    dim,
                  const double          n_cells,
                  const std::string    &entry)
  {
    const double bytes = n_cells * bytes_of_cell(dim);
    // numbers of cells are 32 bits wide
    if (bytes > machine_memory() || !(n_cells < 2e9))
      throw InputError(parameters.where + entry + ": a mesh of " +
                       to_text(n_cells) + " cells takes at least " +
                       to_text(std::ceil(bytes / 1e6)) + " MB, and there are " +
                       to_text(std::floor(machine_memory() / 1e6)) +
                       ". Make it coarser.");
  }
} // namespace conetact::bodies
