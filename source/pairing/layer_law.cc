// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/layer_law.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    const char *const unloads = "Unloading compliance";

    std::optional<Expression>
    read(const dealii::ParameterHandler &prm,
         const std::string              &entry,
         const std::string              &in)
    {
      const std::string text = trim(prm.get(entry));
      if (text.empty())
        return {};
      return Expression(text, in + entry, names_of_situation());
    }

    double
    not_negative(const Expression  &law,
                 const Situation   &at,
                 const std::string &in,
                 const char *const  entry)
    {
      const double value = value_of(law, at);
      if (value < 0)
        throw InputError(in + entry + ": it is " + to_text(value) + " at " +
                         to_text(at.position) + ", t = " + to_text(at.t) +
                         ", p = " + to_text(at.pressure) +
                         ". Give 0 or more at all places and times.");
      return value;
    }

    void
    allow_only(const std::optional<Expression> &law,
               const std::string               &variables,
               const std::string               &what)
    {
      for (const std::string &name : names_of_situation())
        if (law && law->uses(name) && variables.find(name) == variables.npos)
          throw InputError(what + ": it depends on " + name + ". Use x, y, z" +
                           (variables.empty() ? " only." : " and p only."));
      if (law && law->uses_time())
        throw InputError(
          what + ": it depends on t. A layer stays the same: " + "use x, y, z" +
          (variables.empty() ? " only." : " and p only."));
    }
  } // namespace

  LayerLaw::LayerLaw(const dealii::ParameterHandler &prm, const std::string &in)
    : where(in)
    , compliance(read(prm, "Compliance", in))
    , unloading(read(prm, unloads, in))
    , shear_compliance(read(prm, "Shear compliance", in))
    , wear(read(prm, "Wear coefficient", in))
    , share(to_number(prm.get("Wear share"), in + "Wear share"))
    , cycles(to_number(prm.get("Wear acceleration"), in + "Wear acceleration"))
    , at_once(prm.get("Wear integration") == "implicit")
  {
    allow_only(compliance, "p", in + "Compliance");
    allow_only(unloading, "p", in + "Unloading compliance");
    allow_only(shear_compliance, "", in + "Shear compliance");
    if (share < 0 || share > 1)
      throw InputError(in + "Wear share: " + prm.get("Wear share") +
                       " is not a part of the depth. Give 0 (the other side "
                       "wears) to 1 (Body does).");
    if (!(cycles > 0))
      throw InputError(in +
                       "Wear acceleration: " + prm.get("Wear acceleration") +
                       " is not a number of cycles. Give 1, or how many an "
                       "increment counts for.");
  }

  void
  LayerLaw::check(const dealii::Point<3> &p) const
  {
    Situation at;
    at.position = p;
    closing_by_pressure(at);
    if (unloading)
      unloading_by_pressure(at);
    shear(at);
    wear_by_pressure(at);
  }

  double
  LayerLaw::closing_by_pressure(const Situation &at) const
  {
    return compliance ? not_negative(*compliance, at, where, "Compliance") : 0.;
  }

  /** The closing C(p) p; below the largest pressure P so far it is C(P) P -
   * U(P) (P - p), which at p = P is the same. */
  double
  LayerLaw::closing(const Situation &at) const
  {
    if (!is_unloaded(at))
      return closing_by_pressure(at) * at.pressure;
    Situation most = at;
    most.pressure  = at.packed;
    return closing_by_pressure(most) * at.packed -
           unloading_by_pressure(at) * (at.packed - at.pressure);
  }

  /* U is asked at the largest pressure P so far, for what springs back depends
     on how far the layer was pressed. */
  double
  LayerLaw::unloading_by_pressure(const Situation &at) const
  {
    Situation most = at;
    most.pressure  = at.packed;
    // With U above C, C(P) P - U(P) (P - p) would be negative at p = 0.
    const double back  = not_negative(*unloading, most, where, unloads);
    const double there = closing_by_pressure(most);
    if (back > there * (1 + 1e-12))
      throw InputError(where + unloads + ": it is " + to_text(back) +
                       " after p = " + to_text(at.packed) +
                       ", more than the Compliance of " + to_text(there) +
                       ": the layer would be thicker than at the start. Give "
                       "no more than that.");
    return std::min(back, there);
  }

  double
  LayerLaw::shear(const Situation &at) const
  {
    return shear_compliance ?
             not_negative(*shear_compliance, at, where, "Shear compliance") :
             0.;
  }

  /* k of Archard's law [1/stress], times the number of cycles that an increment
     stands for. */
  double
  LayerLaw::wear_by_pressure(const Situation &at) const
  {
    return wear ? cycles * not_negative(*wear, at, where, "Wear coefficient") :
                  0.;
  }

  bool
  LayerLaw::is_linear() const
  {
    const auto depends = [](const std::optional<Expression> &law) {
      return law && (law->uses("p") || law->uses("v"));
    };
    return !unloading && !depends(compliance) && !depends(wear);
  }

  bool
  LayerLaw::uses_temperature() const
  {
    return wear && wear->uses("T");
  }

  bool
  LayerLaw::uses_speed() const
  {
    return wear && wear->uses("v");
  }

  void
  declare_layer(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry(
      "Compliance",
      "",
      Anything(),
      "A thin layer between both sides, such as a gasket or roughness, closes "
      "by this times the pressure. It is an expression of x, y, z, p, such as "
      "table(p; 0 : 2e-3; 10 : 1e-3); its product with p must not fall. A "
      "closed contact then has a negative gap. Empty: there is no layer. "
      "[length/stress]");
    prm.declare_entry(
      unloads,
      "",
      Anything(),
      "For a layer that stays compressed, as a gasket does. Where the "
      "pressure falls below P, the largest so far, the layer springs back by "
      "this times the change, and closes by it again up to P. It is an "
      "expression of x, y, z and p, which is P here, and at most the "
      "Compliance. Empty: the layer springs back as it closed. "
      "[length/stress]");
    prm.declare_entry(
      "Shear compliance",
      "",
      Anything(),
      "The layer gives way along the sides, too: what sticks is displaced by "
      "this times the traction of friction. It is an expression of x, y, z. "
      "Empty: it does not. [length/stress]");
    prm.declare_entry(
      "Wear coefficient",
      "",
      Anything(),
      "Archard's k: a slip ds under the pressure p takes off k p ds, an "
      "expression of x, y, z, t, T, s, p, v. Empty: no wear. [1/stress]");
    prm.declare_entry("Wear share",
                      "1",
                      Anything(),
                      "Part of the depth that Body loses; the other side "
                      "loses the rest, a master body at its own nodes. 0 to "
                      "1. [-]");
    prm.declare_entry("Wear acceleration",
                      "1",
                      Anything(),
                      "Number of times that the slip of an increment happens: "
                      "100 computes 100 cycles by the increments of one. At "
                      "the end of a run the log estimates how depths of wear "
                      "would change with half this value. For that each "
                      "increment is solved two more times. [-]");
    prm.declare_entry(
      "Wear integration",
      "explicit",
      Selection("explicit|implicit"),
      "explicit: the depth that wears in an increment opens the gap of the "
      "next increment; it must be small compared with the compression by "
      "pressure. implicit: the depth opens the gap of its own increment, "
      "which is stable for increments of any size.");
  }
} // namespace conetact::pairing
