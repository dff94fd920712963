// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_increment_laws_h
#define conetact_contact_increment_laws_h

#include "conetact/contact/contact_points.h"
#include "conetact/solvers/nodal_laws.h"
#include "conetact/solvers/reach.h"

#include <array>
#include <vector>

namespace conetact::contact
{
  /** Friction, layers and wear of an increment, by the laws of its contacts. */
  class IncrementLaws : public solvers::NodalLaws
  {
  public:
    /**
     * `known` of each candidate: pressure and speed are still 0. `r` are the
     * reactions at the start [force]; the increment lasts `duration`. `wet`:
     * candidates that a fluid has reached, or none. The points must outlive
     * the object.
     */
    IncrementLaws(const ContactPoints            &points,
                  std::vector<pairing::Situation> known,
                  const Eigen::VectorXd          &r,
                  const double                    duration,
                  const std::vector<bool>        &wet = {});

    /** The same with a part of what wears. */
    std::shared_ptr<const IncrementLaws>
    with_wear(const double part) const;

    solvers::FrictionLimit
    limit(const Index  i,
          const double s,
          const double slip,
          const double gap) const override;
    solvers::Aspect
    aspect(const Index  i,
           const double s,
           const double slip,
           const double gap) const override;
    bool
    has_ellipses() const override
    {
      return elliptic;
    }
    solvers::Layer
    layer(const Index i, const double r_n, const double slip) const override;
    bool
    has_cones() const override;
    bool
    has_layers() const override
    {
      return soft;
    }
    solvers::Bond
    bond(const Index i, const double slip, const double gap) const override;
    bool
    is_bonded(const Index i) const override
    {
      return bonds[static_cast<std::size_t>(i)] ||
             is_wet(static_cast<std::size_t>(i));
    }
    bool
    has_bonds() const override
    {
      return bonded;
    }
    bool
    is_apart(const Index i) const override
    {
      return !active[static_cast<std::size_t>(i)];
    }
    bool
    is_joined(const Index i) const override
    {
      return joined[static_cast<std::size_t>(i)];
    }

    /** What candidates bear at most where these are their reactions, however
     * they slip or open. */
    solvers::Holding
    holding(const Eigen::VectorXd &r) const;
    /** No less than their coefficients, whatever happens; infinite: nothing is
     * known. */
    Eigen::VectorXd
    largest_coefficients() const;

    /** Of all candidates at the end of the increment: coefficients, slips,
     * without what layers give way by [length], and depths of wear [length]. */
    Eigen::VectorXd
    coefficients(const solvers::ContactState &end) const;
    Eigen::VectorXd
    slips(const solvers::ContactState &end) const;
    Eigen::VectorXd
    wear(const solvers::ContactState &end) const;
    /** Pressures of all candidates at the end; 0 without areas [stress]. */
    Eigen::VectorXd
    pressures(const solvers::ContactState &end) const;
    /** Of nodes that were bonded: openings at the end, without what a layer
     * stretches by, 0 if closed [length]. */
    Eigen::VectorXd
    openings(const solvers::ContactState &end) const;
    /** Work against bonds in the increment, from openings at its start [force x
     * length]. */
    Eigen::VectorXd
    fracture(const Eigen::VectorXd       &openings,
             const solvers::ContactState &end) const;

    /** Whether a candidate is whole after a largest opening and a way of slip
     * [length]. */
    bool
    is_whole(const std::size_t i,
             const double      opened,
             const double      slipped) const;

    /** Whether a fluid presses both sides of a candidate apart. */
    bool
    is_wet(const std::size_t i) const
    {
      return fluids[i] > 0;
    }
    /** Whether both sides of a candidate see each other. */
    bool
    sees(const std::size_t i) const
    {
      return active[i];
    }
    /** A candidate at the start of the increment, at the time of its end. */
    const pairing::Situation &
    known(const std::size_t i) const
    {
      return start[i];
    }
    /** Its reaction along its tangents at the start [force]. */
    Eigen::VectorXd
    friction_at_start(const std::size_t i) const;
    double
    duration() const
    {
      return time;
    }

  private:
    pairing::Situation
    situation(const std::size_t i, const double r_n, const double slip) const;
    double
    coefficient(const std::size_t         i,
                const pairing::Situation &at,
                const unsigned int        axis) const;
    double
    most_friction(const std::size_t  i,
                  const double       r_n,
                  const unsigned int axis) const;
    /** Of what presses by r_n, without a bond, along an axis of friction. */
    solvers::FrictionLimit
    friction(const std::size_t  i,
             const unsigned int axis,
             const double       r_n,
             const double       slip) const;
    /** The same with its bond, as limit(). */
    solvers::FrictionLimit
    limit_along(const std::size_t  i,
                const unsigned int axis,
                const double       s,
                const double       slip,
                const double       gap) const;
    /** Whether friction along its tangents is that of an ellipse, and whether
     * it has both. */
    bool
    has_axes(const std::size_t i) const;
    bool
    is_elliptic(const std::size_t i) const;
    solvers::FrictionLimit
    mean_of(const std::size_t             i,
            const solvers::FrictionLimit &one,
            const solvers::FrictionLimit &two) const;
    /** What little is, to a bond [length]. */
    double
    step_of(const std::size_t i) const;
    double
    slip(const std::size_t i, const solvers::ContactState &end) const;
    Eigen::VectorXd
    seen(const std::size_t i, const solvers::ContactState &end) const;
    /** What is left of a bond. */
    double
    rest(const std::size_t i, const double slip, const double gap) const;
    /** Its largest pull at this gap [force]. */
    double
    pull(const std::size_t i, const double slip, const double gap) const;
    double
    fracture(const std::size_t i,
             const double      gap_at_start,
             const double      gap_at_end,
             const double      slip) const;

    const ContactPoints               &points;
    std::vector<pairing::Situation>    start;
    Eigen::VectorXd                    r_start;
    double                             time;
    double                             part_of_wear = 1;
    std::vector<std::array<double, 2>> constant; ///< mu where it is known
    std::vector<bool>                  active, joined;
    std::vector<double>                strength, cohesion; ///< whole [force]
    std::vector<double>                fluids; ///< of what is wet [force]
    std::vector<bool>                  bonds;
    bool                               soft; ///< something gives way
    bool bonded;   ///< something is bonded, wet or joined
    bool elliptic; ///< something has an ellipse for its limit of friction
  };

  /** Whether any candidate has laws of its own: each of them, whatever it is,
   * comes with a law of friction. */
  bool
  has_nodal_laws(const ContactPoints &points);
} // namespace conetact::contact

#endif
