// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_increment_laws_h
#define conetact_contact_increment_laws_h

#include "conetact/contact/contact_points.h"
#include "conetact/solvers/nodal_laws.h"

#include <vector>

namespace conetact::contact
{
  /** Friction, layers and wear of an increment, by the laws of its contacts. */
  class IncrementLaws : public solvers::NodalLaws
  {
  public:
    /**
     * `known` of each candidate: pressure and speed are still 0. `r` are the
     * reactions at the start [force]; the increment lasts `duration`. The
     * points must outlive the object.
     */
    IncrementLaws(const ContactPoints            &points,
                  std::vector<pairing::Situation> known,
                  const Eigen::VectorXd          &r,
                  const double                    duration);

    solvers::FrictionLimit
    limit(const Index i, const double r_n, const double slip) const override;
    solvers::Layer
    layer(const Index i, const double r_n, const double slip) const override;
    bool
    has_cones() const override;
    bool
    has_layers() const override
    {
      return soft;
    }

    /** Of all candidates at the end of the increment: coefficients, slips,
     * without what layers give way by [length], and depths of wear [length]. */
    Eigen::VectorXd
    coefficients(const solvers::ContactState &end) const;
    Eigen::VectorXd
    slips(const solvers::ContactState &end) const;
    Eigen::VectorXd
    wear(const solvers::ContactState &end) const;

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
    /** 0: it covers nothing. */
    double
    area(const std::size_t i) const;
    pairing::Situation
    situation(const std::size_t i, const double r_n, const double slip) const;
    double
    coefficient(const std::size_t i, const pairing::Situation &at) const;
    double
    slip(const std::size_t i, const solvers::ContactState &end) const;

    const ContactPoints            &points;
    std::vector<pairing::Situation> start;
    Eigen::VectorXd                 r_start;
    double                          time;
    std::vector<double>             constant; ///< mu where it is known
    std::vector<bool>               active;
    bool                            soft; ///< something gives way
  };

  /** Whether any candidate has laws of its own. */
  bool
  has_nodal_laws(const ContactPoints &points);
} // namespace conetact::contact

#endif
