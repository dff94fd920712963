// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/spring_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"

#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    const char *const both_ways = "push and pull";

    Point<3>
    point_of(const dealii::ParameterHandler &prm,
             const std::string              &entry,
             const unsigned int              dim,
             const std::string              &in)
    {
      if (prm.get(entry).empty())
        throw InputError(in + entry +
                         ": a spring ends at two points. Give its " +
                         std::to_string(dim) + " coordinates.");
      return Point<3>(to_vector(prm.get(entry), dim, in + entry));
    }

    /** The number of an entry; an empty one is 0. */
    double
    number_of(const dealii::ParameterHandler &prm,
              const std::string              &entry,
              const std::string              &in)
    {
      const std::string text = prm.get(entry);
      return text.empty() ? 0. : to_number(text, in + entry);
    }
  } // namespace

  SpringLaw::SpringLaw(const dealii::ParameterHandler &prm,
                       const unsigned int              dim,
                       const std::string              &in)
    : where(in)
    , stiffness(number_of(prm, "Stiffness", in))
    , play(number_of(prm, "Gap", in))
    , preload(number_of(prm, "Preload", in))
    , pushes(prm.get("Acts") != "pull")
    , pulls(prm.get("Acts") != "push")
    , own(point_of(prm, "Point", dim, in))
    , other(point_of(prm, "Master point", dim, in))
  {
    if (!(stiffness > 0))
      throw InputError(in + "Stiffness: a spring has one above 0. Give its "
                            "force over how far its points part.");
    if (!prm.get("Spring axis").empty())
      axis = to_vector(prm.get("Spring axis"), dim, in + "Spring axis");
    if (play < 0)
      throw InputError(in + "Gap: it is " + prm.get("Gap") +
                       ". Give how far the points of the spring move before it "
                       "acts, 0 or more, or a Preload.");
    if (play > 0 && acts_both_ways())
      throw InputError(in + "Gap: a spring that pushes and pulls has no play. "
                            "Set Acts = push or pull, or leave the entry "
                            "empty.");
    if (play > 0 && preload != 0)
      throw InputError(in + "Gap: a spring with a Preload acts from the start. "
                            "Leave one of both empty.");
    if (preload < 0 && !acts_both_ways())
      throw InputError(in + "Preload: it is " + prm.get("Preload") +
                       ", and this spring only " + prm.get("Acts") +
                       "es. Give 0 or more.");
    normal();
  }

  /**
   * A Preload F stands for a gap of F over the stiffness. Springs that act one
   * way press from the start, as an interference does; one that acts both ways
   * pulls, as if its sides had been drawn apart.
   */
  double
  SpringLaw::gap() const
  {
    return play + (acts_both_ways() ? preload : -preload) * compliance();
  }

  /* From the Master point to the Point; the other way round for springs that
     only pull: so a reaction that presses, r_n > 0, is a tension of the
     spring. */
  Tensor<1, 3>
  SpringLaw::normal() const
  {
    const Tensor<1, 3> between = own - other;
    Tensor<1, 3>       n       = axis.norm() > 0 ? axis : between;
    if (cross_product_3d(n, between).norm() > 1e-9 * n.norm() * between.norm())
      throw InputError(where + "Spring axis: it is not along the line through "
                               "Point and Master point. Leave it empty: it is "
                               "for points that are one.");
    if (n.norm() == 0)
      throw InputError(where + "Master point: it is the Point, and gives the "
                               "spring no direction. Give a Spring axis, from "
                               "the Master point to the Point.");
    n /= n.norm();
    return pushes ? n : -n;
  }

  void
  declare_spring(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Point",
                      "",
                      Anything(),
                      "Kind = spring: where it acts on Body, undeformed. "
                      "[length]");
    prm.declare_entry("Master point",
                      "",
                      Anything(),
                      "Kind = spring: its other end, a point of the Master "
                      "body, of an Obstacle, which carries it along, or with "
                      "neither of both of the ground. [length]");
    prm.declare_entry("Spring axis",
                      "",
                      Anything(),
                      "Kind = spring: its direction from the Master point to "
                      "the Point, where both are at one place. Empty: the line "
                      "through both.");
    prm.declare_entry("Stiffness",
                      "",
                      Anything(),
                      "Kind = spring: its force over the change of the "
                      "distance of its points. [force/length]");
    prm.declare_entry(
      "Acts",
      both_ways,
      Selection(std::string(both_ways) + "|push|pull"),
      "Kind = spring: push, only where its points come nearer, as a stop or a "
      "disc spring; pull, only where they part, as a strap. Such a spring may "
      "have a Gap: how far they move before it acts. Preload: its force at the "
      "start; of one that pushes and pulls, a tension. [-]");
  }

  void
  refuse_spring_entries(const dealii::ParameterHandler &prm,
                        const std::string              &in)
  {
    bodies::refuse_given(prm,
                         {"Point", "Master point", "Spring axis", "Stiffness"},
                         in,
                         "it is one of a spring. Set Kind = spring, or leave "
                         "the entry empty.");
    if (prm.get("Acts") != both_ways)
      throw InputError(in + "Acts: it is an entry of a spring. Set Kind = "
                            "spring, or leave the entry at its default.");
  }
} // namespace conetact::pairing
