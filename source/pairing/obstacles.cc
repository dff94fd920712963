// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/obstacles.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/placement.h"
#include "conetact/pairing/obstacle_motion.h"
#include "conetact/pairing/obstacle_shapes.h"

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

  Tensor<1, 3>
  Obstacle::displacement_at(const double t) const
  {
    Tensor<1, 3> d;
    for (unsigned int c = 0; c < displacement.size(); ++c)
      // a translation: the same everywhere
      d[c] = displacement[c](Point<3>(), t);
    return d;
  }

  RigidMotion
  Obstacle::motion_at(const double t) const
  {
    if (free.any())
      return {};
    RigidMotion motion = RigidMotion::translated(displacement_at(t));
    if (turn)
      {
        motion.centre = reference;
        motion.rotation =
          bodies::rotation_about(turn_axis, (*turn)(Point<3>(), t));
      }
    return motion;
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

  Obstacle
  create_obstacle(dealii::ParameterHandler    &prm,
                  const std::string           &name,
                  const unsigned int           dim,
                  const std::filesystem::path &folder)
  {
    const std::string in = "Obstacle '" + name + "', ";
    Obstacle          obstacle;
    obstacle.name = name;
    // Shapes see whole paths; the scene keeps what is written in it.
    const std::string file = prm.get("File");
    if (!file.empty())
      prm.set("File", (folder / file).string());
    for (const ObstacleRow &row : obstacle_table())
      if (prm.get("Shape") == row.name)
        obstacle.shape = row.create(prm, dim, in);
    prm.set("File", file);
    read_motion(prm, dim, in, obstacle);
    return obstacle;
  }
} // namespace conetact::pairing
