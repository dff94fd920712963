// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/obstacle_table.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/pairing/obstacle_motion.h"
#include "conetact/pairing/obstacle_shapes.h"

#include <algorithm>

namespace conetact::pairing
{
  const std::vector<ObstacleRow> &
  obstacle_table()
  {
    static const std::vector<ObstacleRow> table = {half_space_row(),
                                                   prescribed_gap_row(),
                                                   sphere_row(),
                                                   cylinder_row(),
                                                   cone_row(),
                                                   box_row(),
                                                   surface_mesh_row(),
                                                   implicit_row()};
    return table;
  }

  void
  declare_obstacle(dealii::ParameterHandler &prm)
  {
    std::vector<std::string> names, lines;
    for (const ObstacleRow &row : obstacle_table())
      {
        names.push_back(row.name);
        lines.push_back(std::string(row.name) + ": " + row.description);
      }
    prm.declare_entry("Shape",
                      names.front(),
                      dealii::Patterns::Selection(join(names, "|")),
                      join(lines, "; ") + ".");
    for (const ObstacleRow &row : obstacle_table())
      row.declare(prm);
    declare_motion(prm);
  }

  namespace
  {
    bool
    reads(const ObstacleRow &row, const std::string &entry)
    {
      return std::find(row.entries.begin(), row.entries.end(), entry) !=
             row.entries.end();
    }

    /** Entries of other shapes, which this one would not see. */
    void
    refuse_others(const dealii::ParameterHandler &prm,
                  const ObstacleRow              &row,
                  const std::string              &in)
    {
      // An entry is given if it is not what it is without being written.
      dealii::ParameterHandler defaults;
      declare_obstacle(defaults);
      for (const ObstacleRow &other : obstacle_table())
        for (const std::string &entry : other.entries)
          if (!reads(row, entry) && prm.get(entry) != defaults.get(entry))
            throw InputError(
              in + entry + ": Shape = " + row.name +
              " does not know it, it is one of Shape = " + other.name +
              ". Remove it, or choose another Shape.");
    }
  } // namespace

  Obstacle
  create_obstacle(dealii::ParameterHandler    &prm,
                  const std::string           &name,
                  const unsigned int           dim,
                  const std::filesystem::path &folder)
  {
    const std::string in = "Obstacle '" + name + "', ";
    Obstacle          obstacle;
    obstacle.name          = name;
    const ObstacleRow &row = *std::find_if(obstacle_table().begin(),
                                           obstacle_table().end(),
                                           [&](const ObstacleRow &r) {
                                             return prm.get("Shape") == r.name;
                                           });
    refuse_others(prm, row, in);
    // Shapes see whole paths; the scene keeps what is written in it.
    const std::string file = prm.get("File");
    if (!file.empty())
      prm.set("File", (folder / file).string());
    obstacle.shape = row.create(prm, dim, in);
    prm.set("File", file);
    read_motion(prm, dim, in, obstacle);
    return obstacle;
  }
} // namespace conetact::pairing
