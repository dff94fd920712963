// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_fluid_h
#define conetact_contact_fluid_h

#include "conetact/contact/contact_points.h"

#include <set>
#include <vector>

namespace conetact::contact
{
  /** Ways of fluids over the candidates of contacts that have one. */
  class Fluid
  {
  public:
    /** `bodies` and `points` are read now only. */
    Fluid(const model::Bodies &bodies, const ContactPoints &points);

    bool
    is_none() const
    {
      return sources.empty();
    }

    /**
     * Candidates that are wet at time t: those that were, and those next to
     * them, or at a source, that reactions r press less than the fluid. In one
     * increment they grow only, so that few repetitions find all.
     */
    std::vector<bool>
    wet(const std::vector<bool> &before,
        const Eigen::VectorXd   &r,
        const ContactPoints     &points,
        const double             t) const;

    /** Contacts of which wet candidates are at an edge that is no source and
     * that no support holds. */
    std::set<unsigned int>
    leaks(const std::vector<bool> &wet, const ContactPoints &points) const;

  private:
    std::vector<std::size_t>              sources;
    std::vector<std::vector<std::size_t>> neighbours; ///< of all candidates
    std::vector<bool>                     exits;
  };
} // namespace conetact::contact

#endif
