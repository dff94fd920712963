// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/checkpoint.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    constexpr std::size_t n_states      = 3; // of solvers::NodeState
    constexpr std::size_t most_rows     = std::size_t(1) << 50;
    const std::string     reaction_rows = "rows of reactions.csv";

    [[noreturn]] void
    refuse(const std::string &name, const std::string &what)
    {
      throw InputError("The checkpoint does not fit the scene: its '" + name +
                       "' holds " + what + ". Run the scene from its start.");
    }

    void
    expect(const Archive     &archive,
           const std::string &name,
           const std::size_t  size)
    {
      if (const std::size_t found = archive.get(name).size(); found != size)
        refuse(name,
               std::to_string(found) + " numbers where the scene has " +
                 std::to_string(size));
    }

    /** Whole numbers from 0 to end - 1. */
    std::vector<std::size_t>
    indices(const Archive     &archive,
            const std::string &name,
            const std::size_t  end)
    {
      std::vector<std::size_t> result;
      for (const double value : archive.get(name))
        if (value >= 0 && value < static_cast<double>(end) &&
            value == std::floor(value))
          result.push_back(static_cast<std::size_t>(value));
        else
          refuse(name,
                 to_text(value) + " where there are " + std::to_string(end) +
                   " to choose from, 0 and more");
      return result;
    }
  } // namespace



  void
  check_checkpoint(const Archive                  &archive,
                   const contact::ContactModel    &model,
                   const std::vector<std::string> &supports)
  {
    const auto n_dofs = static_cast<std::size_t>(model.coordinates.n_dofs());
    const auto n_unknowns = static_cast<std::size_t>(
      model.points.n_unknowns() + model.points.n_bound_unknowns());
    const auto n_nodes =
      static_cast<std::size_t>(model.points.layout().n_nodes());
    const std::size_t n_points = model.points.all().size();
    expect(archive, "energies/u", n_dofs);
    expect(archive, "energies/forces", n_dofs);
    expect(archive, "energies/r", n_unknowns);
    expect(archive, "energies/points", 1);
    expect(archive, "energies/reactions", 3 * n_points);
    indices(archive, "energies/points", n_points + 1);
    for (const std::string &support : supports)
      if (const std::string name = "energies/foundation " + support;
          archive.has(name + "/forces"))
        {
          expect(archive, name + "/forces", n_dofs);
          expect(archive, name + "/ground", n_dofs);
        }
    expect(archive, "contact/states", n_nodes);
    indices(archive, "contact/states", n_states);
    indices(archive, "rows/states", n_states);
  }



  std::size_t
  reaction_rows_of(const Archive &archive)
  {
    expect(archive, reaction_rows, 1);
    return indices(archive, reaction_rows, most_rows)[0];
  }



  void
  put_reaction_rows(Archive &archive, const std::size_t n_rows)
  {
    archive.put(reaction_rows, static_cast<double>(n_rows));
  }
} // namespace conetact::analysis
