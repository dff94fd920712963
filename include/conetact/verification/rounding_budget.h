// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_rounding_budget_h
#define conetact_verification_rounding_budget_h

#include "conetact/base/archive.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/verification/claim.h"

#include <utility>
#include <vector>

namespace conetact::verification
{
  /**
   * Forces that are no more than rounding. Springs and supports carry bodies
   * along, and what is carried is where it is to the rounding of how far that
   * is, or was: what one increment leaves is the start of the next. Only what
   * is prescribed counts, so that a body that floats away gains nothing by it.
   */
  class RoundingBudget
  {
  public:
    /** What is given must outlive the object. */
    RoundingBudget(const model::Bodies          &bodies,
                   const contact::ElasticSystem &elastic,
                   const contact::Coordinates   &plain,
                   const contact::ContactPoints &points,
                   const double                  tolerance);

    /** The rounding of forces at all dofs where springs carry bodies along;
     * empty where none does. */
    Eigen::VectorXd
    of_springs(const Finding &out) const;
    /** Finds bodies on which nothing acts but rounding; false if there are
     * none. */
    bool
    find(const Claim &claim, Finding &out) const;
    /** Sets forces of those bodies to zero, at the dofs of this process
     * (`rest`) and of contacts. */
    void
    forget(const contact::DofShare &share,
           Eigen::VectorXd         &rest,
           Finding                 &out) const;

    /** The ways of an increment at time t that was accepted. */
    void
    accept(const double t, const Finding &finding);
    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive);

  private:
    /** The rounding of forces at all dofs in what supports carry along. */
    Eigen::VectorXd
    of_supports(const double t) const;
    /** Forces that it takes to round such ways of bodies, of all dofs. */
    Eigen::VectorXd
    of_ways(const std::vector<double> &ways) const;
    /** Ways of bodies that are no less than such displacements of all dofs. */
    void
    lengthen(std::vector<double> &ways, const Eigen::VectorXd &u) const;
    /** Rounding of forces on the bodies that a rigid one meets, and the longest
     * arm that they have on it. */
    std::pair<double, double>
    of_those_met(const unsigned int     body,
                 const Eigen::VectorXd &rounding) const;
    double
    of_body(const unsigned int     body,
            const Claim           &claim,
            const Balance         &balance,
            const Eigen::VectorXd &carried,
            Eigen::VectorXd       &rounding) const;

    const model::Bodies          &bodies;
    const contact::ElasticSystem &elastic;
    const contact::Coordinates   &plain;
    const contact::ContactPoints &points;
    double                        tolerance;
    /** Prescribed, the largest so far of each body [length]. */
    std::vector<double> on_springs, on_supports;
  };
} // namespace conetact::verification

#endif
