// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene.h"
#include "conetact/base/text.h"
#include "conetact/pairing/obstacle_shapes.h"

namespace conetact::application
{
  namespace
  {
    /** What the first increment makes up for; empty: nothing. */
    std::string
    jump(const pairing::Obstacle &obstacle)
    {
      const double turn = obstacle.turn ? (*obstacle.turn)(Point<3>(), 0) : 0.;
      if (turn != 0)
        return "Turn: it is " + to_text(turn) + " degrees";
      const Tensor<1, 3> move = obstacle.displacement_at(0);
      return move.norm() == 0 ? "" : "Displacement: it is " + to_text(move);
    }

    /** The same of a support, whose displacements may be constant: then they
     * are meant. */
    std::string
    jump(const bodies::Support &support, const double end)
    {
      if (support.turn)
        if (const double turn = support.turn->angle(Point<3>(), 0);
            turn != 0 && turn != support.turn->angle(Point<3>(), end))
          return "Turn: it is " + to_text(turn) + " degrees";
      for (const Expression &displacement : support.displacement)
        for (const bodies::SurfaceNode &node : support.surface.nodes)
          if (const double move = displacement(node.position, 0);
              move != 0 && move != displacement(node.position, end))
            return "Displacement: it is " + to_text(move) + " at " +
                   to_text(node.position);
      return "";
    }

    /** The entry of a body in space that says something in the plane only;
     * empty: there is none. */
    std::string
    entry_of_plane(dealii::ParameterHandler &prm, const std::string &body)
    {
      std::string entry;
      prm.enter_subsection("Body " + body);
      if (prm.get("Kind") == "continuum")
        {
          prm.enter_subsection("Material");
          entry = prm.get("Plane") != "strain" ? "Plane" :
                  prm.get("Thickness") != "1"  ? "Thickness" :
                                                 "";
          prm.leave_subsection();
        }
      prm.leave_subsection();
      return entry;
    }
  } // namespace



  std::vector<std::string>
  Scene::cautions() const
  {
    std::vector<std::string> sentences;
    for (const pairing::Obstacle &obstacle : obstacles)
      if (const std::string what = jump(obstacle); !what.empty())
        sentences.push_back(
          "Obstacle '" + obstacle.name + "', " + what +
          " at t = 0, when the obstacle stands as its shape says: the first "
          "increment moves it by that, too. Begin with 0, or place the shape "
          "there.");
    for (const bodies::Support &support : bodies.supports)
      if (const std::string what = jump(support, times.back()); !what.empty())
        sentences.push_back(
          "Support '" + support.name + "', " + what +
          " at t = 0, when bodies are as they are drawn: the first increment "
          "moves by that, too. Begin with 0.");
    for (const pairing::Obstacle &obstacle : obstacles)
      if (const std::string what = pairing::caution_of(*obstacle.shape);
          !what.empty())
        sentences.push_back("Obstacle '" + obstacle.name + "': " + what);
    for (const pairing::Contact &contact : contacts)
      if (contact.preload && contact.preload->locked_from &&
          *contact.preload->locked_from > times.back())
        sentences.push_back("Contact '" + contact.name +
                            "', Preload locked from: it is never locked, for "
                            "the last increment ends at t = " +
                            to_text(times.back()) + " and t = " +
                            to_text(*contact.preload->locked_from) +
                            " is after it.");
    for (std::size_t b = 0; b < bodies.n_elastic() && bodies.dim == 3; ++b)
      if (const std::string entry =
            entry_of_plane(entries.prm, bodies.names[b]);
          !entry.empty())
        sentences.push_back("Body '" + bodies.names[b] + "', Material/" +
                            entry +
                            ": it says nothing of a body in space. Remove the "
                            "entry.");
    return sentences;
  }



  std::vector<const pairing::Obstacle *>
  Scene::idle_obstacles() const
  {
    std::vector<const pairing::Obstacle *> idle;
    for (const pairing::Obstacle &obstacle : obstacles)
      if (std::none_of(contacts.begin(),
                       contacts.end(),
                       [&](const pairing::Contact &contact) {
                         return contact.obstacle == &obstacle;
                       }))
        idle.push_back(&obstacle);
    return idle;
  }
} // namespace conetact::application
