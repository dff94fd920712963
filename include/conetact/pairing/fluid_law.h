// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_fluid_law_h
#define conetact_pairing_fluid_law_h

#include "conetact/base/expression.h"
#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>

namespace conetact::pairing
{
  /**
   * A fluid that presses the sides of a contact apart wherever it gets to: from
   * its source on, over what is open or less pressed than the fluid is.
   */
  class FluidLaw
  {
  public:
    /** Entries of a contact whose slave surface is `ids` of a structure; `in`
     * is what errors begin with. Throws InputError. */
    FluidLaw(const dealii::ParameterHandler &prm,
             const unsigned int              dim,
             const bodies::Structure        &structure,
             const std::string              &body,
             const bodies::BoundaryIds      &ids,
             const std::string              &in);

    /** Throws InputError where it is negative [stress]. */
    double
    pressure(const double t) const;

    /** The slave surface. */
    const bodies::BoundaryIds &
    surface() const
    {
      return slave;
    }
    /** Where it comes from: nodes of these ids, and the node next to a point.
     */
    const bodies::BoundaryIds &
    source() const
    {
      return ids;
    }
    const std::optional<Point<3>> &
    source_point() const
    {
      return point;
    }

  private:
    void
    check_source(const bodies::Structure &structure,
                 const std::string       &in) const;

    std::string             where; ///< what errors begin with
    Expression              law;
    bodies::BoundaryIds     slave, ids;
    std::optional<Point<3>> point;
  };

  /** Whether the entries ask for one; throws InputError where they ask for half
   * of one. */
  bool
  has_fluid(const dealii::ParameterHandler &prm, const std::string &in);

  /** The entries above. */
  void
  declare_fluid(dealii::ParameterHandler &prm);
} // namespace conetact::pairing

#endif
