// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_layer_law_h
#define conetact_pairing_layer_law_h

#include "conetact/pairing/friction_law.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>

namespace conetact::pairing
{
  /**
   * What is between the sides of a contact, or is rubbed off them: a thin layer
   * that pressure closes by C(p) p and that shear displaces by C_t times the
   * traction, and wear by Archard's law, k p ds.
   */
  class LayerLaw
  {
  public:
    /** Entries of a contact; `in` is what errors begin with. Throws
     * InputError. */
    LayerLaw(const dealii::ParameterHandler &prm, const std::string &in);

    /** Throws InputError where it gives way the wrong way at a place. */
    void
    check(const dealii::Point<3> &p) const;

    /** C: closing over pressure, of what has not borne more yet
     * [length/stress]. */
    double
    closing_by_pressure(const Situation &at) const;
    /** How far pressure has closed it, C(p) p; below the largest pressure P so
     * far C(P) P less the way back [length]. */
    double
    closing(const Situation &at) const;
    /** Whether it is on that way back, and how much that is over the change of
     * pressure [length/stress]. */
    bool
    is_unloaded(const Situation &at) const
    {
      return unloading && at.pressure < at.packed;
    }
    double
    unloading_by_pressure(const Situation &at) const;
    /** Displacement along the traction over that [length/stress]. */
    double
    shear(const Situation &at) const;
    /** Depth over pressure and way [1/stress], of all cycles that an increment
     * counts for. */
    double
    wear_by_pressure(const Situation &at) const;

    /** Whether it is none at all. */
    bool
    is_none() const
    {
      return !compliance && !shear_compliance && !wear;
    }
    bool
    wears() const
    {
      return wear.has_value();
    }
    /** Whether it remembers the largest pressure that it has carried. */
    bool
    stays_packed() const
    {
      return unloading.has_value();
    }
    /** Whether wear of an increment gives way in it, else in the next one. */
    bool
    wears_at_once() const
    {
      return wear && at_once;
    }
    /** Whether anything gives way in an increment. */
    bool
    is_soft() const
    {
      return compliance || shear_compliance || wears_at_once();
    }
    /** Whether what sticks may displace, or close, by its own force. */
    bool
    is_sheared() const
    {
      return shear_compliance.has_value();
    }
    bool
    closes() const
    {
      return compliance || wears_at_once();
    }
    /** Whether closing and wear over pressure are known before an increment is
     * solved. */
    bool
    is_linear() const;
    bool
    uses_temperature() const;
    bool
    uses_speed() const;
    /** How many times the slip of an increment counts. */
    double
    acceleration() const
    {
      return cycles;
    }
    /** Of the depth, what the slave loses. */
    double
    share_of_slave() const
    {
      return share;
    }

  private:
    std::string               where; ///< what errors begin with
    std::optional<Expression> compliance, unloading, shear_compliance, wear;
    double                    share = 1, cycles = 1;
    bool                      at_once = false;
  };

  /** The entries above. */
  void
  declare_layer(dealii::ParameterHandler &prm);
} // namespace conetact::pairing

#endif
