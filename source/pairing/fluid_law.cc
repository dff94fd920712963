// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/fluid_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    /** Refuses a point that is further from all nodes than half the size of the
     * surface: a slip of the pen would make the nearest node the source. */
    void
    check_point(const std::vector<bodies::SurfaceNode> &nodes,
                const Point<3>                         &point,
                const std::string                      &in)
    {
      double nearest = std::numeric_limits<double>::max(), size = 0;
      for (const bodies::SurfaceNode &node : nodes)
        {
          nearest = std::min(nearest, node.position.distance(point));
          size = std::max(size, node.position.distance(nodes.front().position));
        }
      if (nearest > .5 * size)
        throw InputError(in + "Fluid from point: " + to_text(point) + " is " +
                         to_text(nearest) +
                         " away from the contact. Give a point of it.");
    }
  } // namespace

  FluidLaw::FluidLaw(const dealii::ParameterHandler &prm,
                     const unsigned int              dim,
                     const bodies::Structure        &structure,
                     const std::string              &body,
                     const bodies::BoundaryIds      &of_slave,
                     const std::string              &in)
    : where(in + "Penetrating pressure")
    , law(prm.get("Penetrating pressure"), where)
    , slave(of_slave)
  {
    if (law.uses_space())
      throw InputError(where + ": '" + prm.get("Penetrating pressure") +
                       "' depends on the place. A fluid has one pressure "
                       "wherever it is: use t only.");
    if (const std::string text = prm.get("Fluid from boundary ids");
        !text.empty())
      ids = bodies::find_boundary(text,
                                  structure,
                                  body,
                                  in + "Fluid from boundary ids");
    if (!ids.empty())
      check_source(structure, in);
    if (const std::string text = prm.get("Fluid from point"); !text.empty())
      {
        point = Point<3>(to_vector(text, dim, in + "Fluid from point"));
        check_point(structure.surface(slave).nodes, *point, in);
      }
    if (structure.surface(slave).faces.empty())
      throw InputError(where + ": the nodes of this contact are points of a "
                               "frame, on which no fluid presses. Leave the "
                               "entry empty.");
  }

  /* The fluid enters over nodes that both the source and the contact have: a
     source without any would leave all dry, without a word. */
  void
  FluidLaw::check_source(const bodies::Structure &structure,
                         const std::string       &in) const
  {
    std::set<unsigned int> of_slave;
    for (const bodies::SurfaceNode &node : structure.surface(slave).nodes)
      of_slave.insert(node.node);
    for (const bodies::SurfaceNode &node : structure.surface(ids).nodes)
      if (of_slave.count(node.node) > 0)
        return;
    throw InputError(in + "Fluid from boundary ids: none of their nodes is on "
                          "the Boundary ids of the contact, so that no fluid "
                          "gets in. Give ids beside those, or a point.");
  }

  /* [stress] Below zero it would pull both sides together, which no fluid
     between them does. */
  double
  FluidLaw::pressure(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    const double p = law(Point<3>(), t);
    if (!(p >= 0))
      throw InputError(where + ": it is " + to_text(p) + " at t = " +
                       to_text(t) + ". Give 0 or more at all times.");
    return p;
  }

  bool
  has_fluid(const dealii::ParameterHandler &prm, const std::string &in)
  {
    const bool presses = !prm.get("Penetrating pressure").empty();
    bool       starts  = false;
    for (const char *entry : {"Fluid from boundary ids", "Fluid from point"})
      {
        const bool given = !prm.get(entry).empty();
        if (given && !presses)
          throw InputError(in + entry +
                           ": there is no fluid. Give Penetrating pressure, "
                           "or leave the entry empty.");
        starts = starts || given;
      }
    if (presses && !starts)
      throw InputError(in + "Penetrating pressure: where does the fluid come "
                            "from? Give Fluid from boundary ids of Body, or "
                            "Fluid from point.");
    return presses;
  }

  void
  declare_fluid(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry(
      "Penetrating pressure",
      "",
      Anything(),
      "Pressure of a fluid, a function of t. From its source on, the fluid "
      "wets nodes that are open, or pressed less than this, and presses both "
      "sides apart there. Empty: there is no fluid. [stress]");
    prm.declare_entry(
      "Fluid from boundary ids",
      "",
      Anything(),
      "The fluid comes from contact nodes that are also on these boundary ids "
      "of Body, such as the wall of a bore.");
    prm.declare_entry("Fluid from point",
                      "",
                      Anything(),
                      "The fluid comes from the contact node that is next to "
                      "this point. [length]");
  }
} // namespace conetact::pairing
