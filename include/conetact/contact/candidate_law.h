// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_candidate_law_h
#define conetact_contact_candidate_law_h

#include "conetact/contact/candidate_bond.h"
#include "conetact/contact/contact_points.h"

#include <array>
#include <optional>

namespace conetact::contact
{
  /** What is known of a candidate before an increment is solved. */
  struct CandidateStart
  {
    pairing::Situation   situation; ///< at the time of its end
    solvers::SmallVector friction;  ///< reaction along its tangents [force]
    double               duration;  ///< of the increment
    double               part_of_wear = 1; ///< that it wears by
  };

  /** The length of the slip in (slip, gap). */
  inline double
  slip_in(const solvers::SmallVector &seen)
  {
    return seen.head(seen.size() - 1).norm();
  }

  /** Friction, layer, bond and wear of one candidate in an increment, as
   * solvers::NodalLaws has them of all. */
  class CandidateLaw
  {
  public:
    /** Pressure and speed of the start are 0; a fluid may have reached it. The
     * points must outlive it. */
    CandidateLaw(const ContactPoints &points,
                 const std::size_t    number,
                 CandidateStart       start,
                 const bool           is_wet);

    void
    set_wear(const double part)
    {
      known.part_of_wear = part;
    }
    const CandidateStart &
    start() const
    {
      return known;
    }
    const CandidateBond &
    bond() const
    {
      return bonded;
    }
    /** Whether both sides see each other. */
    bool
    sees() const
    {
      return active;
    }
    /** Whether both sides stay together whatever the reaction. */
    bool
    is_joined() const
    {
      return active && node().is_joined();
    }
    /** Whether a fluid presses both sides apart. */
    bool
    is_wet() const
    {
      return fluid > 0;
    }
    /** Whether its coefficient is known before anything is solved. */
    bool
    has_cone() const
    {
      return constant[0] >= 0;
    }
    /** Whether friction along its tangents is that of an ellipse. */
    bool
    is_elliptic() const;
    /** Whether anything gives way between both sides. */
    bool
    is_soft() const;

    solvers::FrictionLimit
    limit(const double s, const double slip, const double gap) const;
    solvers::Aspect
    aspect(const double s, const double slip, const double gap) const;
    solvers::Layer
    layer(const double r_n, const double slip) const;
    /** Of its bond, less what a fluid presses its sides apart by. */
    solvers::Bond
    pull(const double slip, const double gap) const;

    /** What laws see at a reaction and a slip: place, time, temperature and the
     * way so far are those of the increment. */
    pairing::Situation
    situation(const double r_n, const double slip) const;
    /** What it bears at most along its tangents at this reaction, however it
     * slips or opens [force]. */
    double
    most_friction(const double r_n) const;
    /** No less than its coefficient, whatever happens; infinite: nothing is
     * known. */
    double
    largest_coefficient() const;

    /** Displacements of the sides at the end of the increment, without what the
     * layer between them closes or gives way by. */
    solvers::SmallVector
    seen(const solvers::ContactState &end) const;
    /** The coefficient then. */
    double
    coefficient(const solvers::ContactState &end) const;

  private:
    const ContactPoint &
    point() const
    {
      return points[number];
    }
    const pairing::ContactNode &
    node() const
    {
      return *point().node;
    }
    /** Numbers of a layer that are known before the increment is solved. */
    struct LinearLayer
    {
      double closing = 0; ///< over pressure [length/stress]
      double wear    = 0; ///< over pressure and way [1/stress]
      double shear   = 0; ///< along over traction [length/stress]
    };

    /** Whether pressure and friction make a layer give way. */
    bool
    has_layer() const;
    /** Of a layer and what wears in the increment, pressed by r_n. */
    solvers::Layer
    soft_layer(const double r_n, const double slip) const;
    solvers::Layer
    linear_layer(const LinearLayer &of,
                 const double       r_n,
                 const double       slip) const;
    /** Of what presses by r_n, without a bond, along an axis of friction. */
    solvers::FrictionLimit
    friction(const unsigned int axis,
             const double       r_n,
             const double       slip) const;
    /** The same with its bond, as limit(). */
    solvers::FrictionLimit
    limit_along(const unsigned int axis,
                const double       s,
                const double       slip,
                const double       gap) const;
    /** Whether friction differs along its axes. */
    bool
    has_axes() const;
    solvers::FrictionLimit
    mean_of(const solvers::FrictionLimit &one,
            const solvers::FrictionLimit &two) const;

    const ContactPoints  &points;
    std::size_t           number;
    CandidateStart        known;
    std::array<double, 2> constant; ///< mu where it is known
    bool                  active;
    CandidateBond         bonded;
    /** Nothing: pressure or speed change it, or there is no layer. */
    std::optional<LinearLayer> linear;
    double                     fluid = 0; ///< of what is wet [force]
  };
} // namespace conetact::contact

#endif
