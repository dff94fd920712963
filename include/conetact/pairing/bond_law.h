// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_bond_law_h
#define conetact_pairing_bond_law_h

#include "conetact/pairing/friction_law.h"

#include <deal.II/base/parameter_handler.h>

#include <limits>
#include <string>

namespace conetact::pairing
{
  /** Stands for the largest opening of what was open at the start. */
  constexpr double never_closed = std::numeric_limits<double>::max();

  /**
   * What holds the sides of a contact together until it is lost: they open when
   * they are pulled by the tensile strength T, and friction bears the cohesion
   * c without pressure, |traction| <= mu p + c, p >= -T. Both fall linearly
   * with the way of opening, or of opening and slip, to 0 at the softening
   * length, as in a cohesive zone (Hillerborg, Modeer, Petersson, Cement and
   * Concrete Research 6 (1976) 773-782).
   */
  class BondLaw
  {
  public:
    /** Entries of a contact; `in` is what errors begin with. Throws
     * InputError. */
    BondLaw(const dealii::ParameterHandler &prm, const std::string &in);

    /** Throws InputError where it is negative at a place. */
    void
    check(const dealii::Point<3> &p) const;

    /** T and c of what is whole [stress]. */
    double
    strength(const Situation &at) const;
    double
    cohesion(const Situation &at) const;
    /** What is left of both, 1 to 0, after the largest opening and the way of
     * slip [length]; `least` is a way that is rounding. */
    double
    rest(const double opened, const double slipped, const double least) const;
    /** Whether T and c may be lost, for good. */
    bool
    may_be_lost() const
    {
      return lost != Lost::never;
    }
    /** T and c are lost at a sudden, at the end of an increment. */
    bool
    is_brittle() const
    {
      return may_be_lost() && length == 0;
    }
    /** Pull over the strength that is left, at a gap below the largest one so
     * far: a zone that has opened closes along a line to 0. */
    double
    unloading(const double gap, const double opened, const double least) const;

    bool
    is_none() const;
    /** Whether it is cohesion alone, for ever. */
    bool
    is_plain_cohesion() const;
    bool
    uses_temperature() const;

  private:
    enum class Lost
    {
      never,
      opening,
      slip
    };

    std::string where; ///< what errors begin with
    Expression  tension, shear;
    Lost        lost   = Lost::never;
    double      length = 0; ///< of softening; 0: none
  };

  /** The entries above. */
  void
  declare_bond(dealii::ParameterHandler &prm);
} // namespace conetact::pairing

#endif
