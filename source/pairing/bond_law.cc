// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/bond_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    Expression
    read_bond(const dealii::ParameterHandler &prm,
              const std::string              &entry,
              const std::string              &in)
    {
      Expression law(prm.get(entry), in + entry, names_of_situation());
      for (const char *of_increment : {"s", "p", "v"})
        if (law.uses(of_increment))
          throw InputError(in + entry + ": it depends on " + of_increment +
                           ". A bond is that of a place: use x, y, z, t and "
                           "T, and Softening length for how it is lost.");
      return law;
    }

    double
    strength_at(const Expression  &law,
                const Situation   &at,
                const std::string &what)
    {
      const double value = value_of(law, at);
      if (!(value >= 0))
        throw InputError(what + ": it is " + to_text(value) + " at " +
                         to_text(at.position) + ", t = " + to_text(at.t) +
                         ". Give 0 or more at all places and times.");
      return value;
    }
  } // namespace

  BondLaw::BondLaw(const dealii::ParameterHandler &prm, const std::string &in)
    : where(in)
    , tension(read_bond(prm, "Tensile strength", in))
    , shear(read_bond(prm, "Cohesion", in))
  {
    const std::string how = prm.get("Cohesion lost");
    lost                  = how == "opening" ? Lost::opening :
                            how == "slip"    ? Lost::slip :
                                               Lost::never;
    if (const std::string way = prm.get("Softening length"); !way.empty())
      {
        length = to_number(way, in + "Softening length");
        if (!(length > 0))
          throw InputError(
            in + "Softening length: " + way +
            " is no way over which anything is lost. Give a "
            "length above 0, or nothing: then a bond is lost "
            "at the end of the increment in which it gives way.");
        if (lost == Lost::never)
          throw InputError(in + "Softening length: Cohesion lost = never keeps "
                                "the bond. Choose opening or slip, or leave "
                                "the entry empty.");
      }
  }

  void
  BondLaw::check(const dealii::Point<3> &p) const
  {
    Situation at;
    at.position = p;
    strength(at);
    cohesion(at);
  }

  double
  BondLaw::strength(const Situation &at) const
  {
    return strength_at(tension, at, where + "Tensile strength");
  }

  double
  BondLaw::cohesion(const Situation &at) const
  {
    return strength_at(shear, at, where + "Cohesion");
  }

  /**
   * The part 1 - w / l of T and c that is left, with the softening length l and
   * the way w, which is the opening or sqrt(opening^2 + slip^2). So the energy
   * of fracture is half the strength times l.
   */
  double
  BondLaw::rest(const double opened,
                const double slipped,
                const double least) const
  {
    Assert(opened >= 0 && slipped >= 0 && least > 0,
           dealii::ExcMessage("Ways have no sign."));
    // What is open at the start was never glued.
    if (opened == never_closed)
      return 0;
    if (lost == Lost::never)
      return 1;
    const double way =
      lost == Lost::opening ? opened : std::hypot(opened, slipped);
    if (length == 0)
      return way > least ? 0. : 1.;
    constexpr double rounding = 1e-9; // of a way that is all of the length
    const double     rest     = 1 - way / length;
    return rest > rounding ? rest : 0.;
  }

  /** A zone that has opened by w closes along a line to 0: at a gap g it pulls
   * by g / w of the strength that is left at w. */
  double
  BondLaw::unloading(const double gap,
                     const double opened,
                     const double least) const
  {
    Assert(opened >= 0 && least > 0, dealii::ExcMessage("Ways have no sign."));
    if (lost == Lost::never || opened <= least || gap >= opened)
      return 1;
    return std::max(gap, 0.) / opened;
  }

  bool
  BondLaw::is_none() const
  {
    return tension.is_zero() && shear.is_zero();
  }

  bool
  BondLaw::is_plain_cohesion() const
  {
    return tension.is_zero() && lost == Lost::never && !shear.uses_time() &&
           !shear.uses("T");
  }

  bool
  BondLaw::uses_temperature() const
  {
    return tension.uses("T") || shear.uses("T");
  }

  void
  declare_bond(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry(
      "Cohesion",
      "0",
      Anything(),
      "Friction without pressure of nodes that are closed at the start: "
      "|traction| <= mu p + cohesion. It is 0 or more, an expression of x, y, "
      "z, t, T. [stress; contact nodes of frames: force] With Method = load "
      "path in 2D it is a force at each contact node, open ones too, a "
      "function of x, y, z: |r_t| <= mu r_n + cohesion.");
    prm.declare_entry(
      "Tensile strength",
      "0",
      Anything(),
      "Largest pull that nodes which are closed at the start bear before they "
      "open: p >= -strength. It is an expression of x, y, z, t, T. [stress; "
      "contact nodes of frames: force]");
    prm.declare_entry(
      "Cohesion lost",
      "never",
      Selection("never|opening|slip"),
      "When Cohesion and Tensile strength are lost for good: where the joint "
      "has opened, or where it has opened or slipped.");
    prm.declare_entry(
      "Softening length",
      "",
      Anything(),
      "Opening (Cohesion lost = slip: opening and slip together) over which "
      "both fall linearly to 0; the energy of fracture is half the strength "
      "times this. Empty: all is lost at the end of the increment. [length]");
  }
} // namespace conetact::pairing
