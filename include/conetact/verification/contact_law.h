// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_verification_contact_law_h
#define conetact_verification_contact_law_h

#include "conetact/contact/contact_points.h"
#include "conetact/contact/elastic_system.h"
#include "conetact/verification/claim.h"

#include <string>
#include <vector>

namespace conetact::verification
{
  /** An error over its scale; where nothing acts, none is allowed, and what
   * is not a number never is. */
  double
  relative(const double error, const double scale);

  /** What errors of an increment are compared with, of each body. */
  struct Scales
  {
    std::vector<double> nodal;     ///< F_b with thermal forces
    std::vector<double> force;     ///< F_b
    std::vector<double> history;   ///< largest F_b so far
    double              noise = 0; ///< rounding of the largest force so far
    std::vector<double> rounding;  ///< of bodies on which nothing acts
    std::vector<double> reach;     ///< largest coordinate + displacement
  };

  /** Judges reactions and places of contact nodes by the law of each. */
  class ContactLaw
  {
  public:
    /** What is given must outlive the object. */
    ContactLaw(const model::Bodies          &bodies,
               const contact::ElasticSystem &elastic,
               const contact::ContactPoints &points,
               const double                  tolerance);

    /**
     * Stiffness of the softer side of each candidate, and along each unknown
     * of what is bound [force/length], 0: not known.
     */
    void
    set_stiffness(const Eigen::VectorXd &of_candidates,
                  const Eigen::VectorXd &of_bound);

    void
    check(const Claim &claim, const Scales &scales, Finding &out) const;

  private:
    struct Errors;
    Errors
    errors_of(const pairing::ContactNode &node,
              const double                k,
              const Scales               &scales) const;
    Errors
    errors_of_candidate(const std::size_t point,
                        const Claim      &claim,
                        const Scales     &scales,
                        const Finding    &out) const;
    Errors
    errors_of_bound(const contact::ContactPoint &point,
                    const Scales                &scales,
                    const Finding               &out) const;
    void
    check_bound_forces(const Claim &claim, Finding &out) const;

    const model::Bodies          &bodies;
    const contact::ElasticSystem &elastic;
    const contact::ContactPoints &points;
    double                        tolerance;
    Eigen::VectorXd               stiffness, bound_stiffness;
  };
} // namespace conetact::verification

#endif
