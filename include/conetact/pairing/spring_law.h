// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_spring_law_h
#define conetact_pairing_spring_law_h

#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>

namespace conetact::pairing
{
  /**
   * A spring between a point of a body and one of another body, of an obstacle
   * or of the ground, along the line through both: a force in proportion to how
   * far they have come nearer, or parted.
   */
  class SpringLaw
  {
  public:
    /** Entries of a contact; `in` is what errors begin with. Throws InputError.
     */
    SpringLaw(const dealii::ParameterHandler &prm,
              const unsigned int              dim,
              const std::string              &in);

    /** Displacement over force [length/force]. */
    double
    compliance() const
    {
      return 1 / stiffness;
    }
    /** Whether it pushes and pulls; else one of both. */
    bool
    acts_both_ways() const
    {
      return pushes && pulls;
    }
    /** How far its points move before it acts; negative where it does from the
     * start [length]. */
    double
    gap() const;

    /** From what it meets to the body where it pushes only, or both ways; the
     * other way where it pulls. Throws InputError where both points are one and
     * no axis is given. */
    Tensor<1, 3>
    normal() const;

    const Point<3> &
    point() const
    {
      return own;
    }
    /** Undeformed; where the spring ends. */
    const Point<3> &
    end() const
    {
      return other;
    }

  private:
    std::string  where; ///< what errors begin with
    double       stiffness = 0, play = 0, preload = 0;
    bool         pushes = true, pulls = true;
    Point<3>     own, other;
    Tensor<1, 3> axis; ///< zero: that through both points
  };

  /** The entries above. */
  void
  declare_spring(dealii::ParameterHandler &prm);
  /** Throws InputError where entries of a spring stand in another Kind. */
  void
  refuse_spring_entries(const dealii::ParameterHandler &prm,
                        const std::string              &in);
} // namespace conetact::pairing

#endif
