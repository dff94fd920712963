// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_increment_friction_h
#define conetact_contact_increment_friction_h

#include "conetact/contact/contact_points.h"
#include "conetact/pairing/friction_law.h"
#include "conetact/solvers/friction_limit.h"

#include <vector>

namespace conetact::contact
{
  /** The limits of friction of an increment, by the laws of its contacts. */
  class IncrementFriction : public solvers::VaryingFriction
  {
  public:
    /**
     * `known` of each candidate: pressure and speed are still 0. The increment
     * lasts `duration`. The points must outlive the object.
     */
    IncrementFriction(const ContactPoints                &points,
                      std::vector<pairing::FrictionPoint> known,
                      const double                        duration);

    solvers::FrictionLimit
    at(const Eigen::Index i,
       const double       r_n,
       const double       slip) const override;
    bool
    is_known() const override;

    /** Coefficients of all candidates in a state. */
    Eigen::VectorXd
    coefficients(const solvers::ContactState &state) const;

    /** A candidate at the start of the increment, at the time of its end. */
    const pairing::FrictionPoint &
    known(const std::size_t i) const
    {
      return start[i];
    }
    double
    duration() const
    {
      return time;
    }

  private:
    /** mu at a pressure and a speed; what is below 0 is none. */
    double
    coefficient(const std::size_t i, const double p, const double v) const;
    /** Its slope along one of them. */
    template <typename Function>
    static double
    slope(const Function &f, const double x);

    const ContactPoints                &points;
    std::vector<pairing::FrictionPoint> start;
    double                              time;
    std::vector<double>                 constant; ///< mu where it is known
  };

  /** Whether friction of any candidate varies. */
  bool
  has_varying_friction(const ContactPoints &points);
} // namespace conetact::contact

#endif
