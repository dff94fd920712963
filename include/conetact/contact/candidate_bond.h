// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_candidate_bond_h
#define conetact_contact_candidate_bond_h

#include "conetact/pairing/contact_nodes.h"
#include "conetact/solvers/nodal_laws.h"

#include <memory>

namespace conetact::contact
{
  /** What is left of the bond of a candidate at slips and gaps of an
   * increment; none: of a node without bond. */
  class CandidateBond
  {
  public:
    CandidateBond() = default;
    /** Of a node with a bond, where it is at the start. */
    CandidateBond(const pairing::ContactNode &node,
                  const pairing::Situation   &start);

    /** Whether it bears anything at the start. */
    bool
    holds() const
    {
      return bears;
    }
    /** Its largest pull at this gap [force]. */
    double
    pull(const double slip, const double gap) const;
    /** The same with its slopes. */
    solvers::Bond
    with_slopes(const double slip, const double gap) const;
    /** Friction without pressure, with its slopes. */
    solvers::FrictionLimit
    friction(const double slip, const double gap) const;
    /** Whether it is whole after a largest opening and a way of slip
     * [length]. */
    bool
    is_whole(const double opened, const double shorn) const;
    /** Work against it in an increment [force x length]. */
    double
    fracture(const double gap_at_start,
             const double gap_at_end,
             const double slip) const;

  private:
    /** The part that is left of it. */
    double
    rest(const double slip, const double gap) const;

    std::shared_ptr<const pairing::BondLaw> law;
    double strength = 0, cohesion = 0; ///< whole [force]
    double opened = 0, shorn = 0;      ///< so far [length]
    double least = 0;                  ///< what little is to it [length]
    bool   bears = false;
  };
} // namespace conetact::contact

#endif
