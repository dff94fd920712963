// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/axisymmetry.h"

#include "conetact/base/errors.h"

#include <algorithm>

namespace conetact::application
{
  namespace
  {
    using Structures = std::vector<const bodies::Structure *>;

    void
    check_obstacle(const pairing::Obstacle &obstacle)
    {
      const auto demand = [&](const bool holds, const std::string &entry) {
        if (!holds)
          throw InputError("Obstacle '" + obstacle.name + "', " + entry +
                           ": bodies of revolution (Plane = axisymmetric) " +
                           "meet an obstacle that goes round the axis, too, " +
                           "and moves along y only. Leave out what is along " +
                           "x or turns.");
      };
      const auto &free = obstacle.free;
      demand(obstacle.displacement.empty() ||
               obstacle.displacement.front().is_zero(),
             "Displacement");
      demand(!obstacle.turn, "Turn");
      demand(!free.components.at(0) && !free.components.at(5), "Free");
      demand(free.force.empty() || free.force.front().is_zero(), "Force");
      demand(std::all_of(free.moment.begin(),
                         free.moment.end(),
                         [](const Expression &m) { return m.is_zero(); }),
             "Moment");
    }

    void
    refuse_axis(const bodies::Structure   &structure,
                const bodies::BoundaryIds &ids,
                const std::string         &entry)
    {
      const auto on_axis = [&](const unsigned int node) {
        return structure.position(node)[0] == 0;
      };
      for (const bodies::SurfaceFace &face : structure.surface(ids).faces)
        if (std::all_of(face.nodes.begin(), face.nodes.end(), on_axis))
          throw InputError(entry + ": some of these faces lie on the axis of " +
                           "a body of revolution, where it has no surface. " +
                           "Leave them out: the axis stays by itself.");
    }
  } // namespace

  void
  check_axisymmetric(const std::vector<std::string>       &names,
                     const Structures                     &structures,
                     const std::vector<pairing::Obstacle> &obstacles,
                     const std::vector<pairing::Contact>  &contacts)
  {
    const auto goes_round = [](const bodies::Structure *structure) {
      return structure->is_axisymmetric();
    };
    const auto first =
      std::find_if(structures.begin(), structures.end(), goes_round);
    if (first == structures.end())
      return;
    const auto other =
      std::find_if_not(structures.begin(), structures.end(), goes_round);
    if (other != structures.end())
      throw InputError(
        "Body '" + names[static_cast<std::size_t>(other - structures.begin())] +
        "', Material/Plane: body '" +
        names[static_cast<std::size_t>(first - structures.begin())] +
        "' is axisymmetric and this one is not. Bodies of one scene go round " +
        "the axis all or none: give them the same, or solve two scenes.");
    for (const pairing::Obstacle &obstacle : obstacles)
      check_obstacle(obstacle);
    for (const pairing::Contact &contact : contacts)
      {
        const std::string in = "Contact '" + contact.name + "', ";
        refuse_axis(*structures[contact.body],
                    contact.ids,
                    in + "Boundary ids");
        if (contact.obstacle == nullptr)
          refuse_axis(*structures[contact.master],
                      contact.master_ids,
                      in + "Master boundary ids");
      }
  }

  void
  hold_axes(model::Bodies &bodies)
  {
    if (bodies.are_axisymmetric())
      for (unsigned int b = 0; b < bodies.structures.size(); ++b)
        if (auto axis =
              bodies::axis_support(*bodies.structures[b], b, bodies.names[b]))
          bodies.supports.push_back(std::move(*axis));
  }
} // namespace conetact::application
