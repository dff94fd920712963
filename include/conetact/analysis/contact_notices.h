// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_contact_notices_h
#define conetact_analysis_contact_notices_h

#include "conetact/analysis/facet_moments.h"
#include "conetact/analysis/ways_of_wear.h"
#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_model.h"
#include "conetact/output/output.h"
#include "conetact/pairing/contact_facets.h"
#include "conetact/pairing/pressure_pattern.h"

#include <set>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * What a user must know of contacts and cannot see in a result: nodes that
   * start inside what they meet; facets of curved surfaces that are taken for
   * gaps; contacts narrower than cells; contacts that never close.
   */
  class ContactNotices
  {
  public:
    ContactNotices(const application::Scene    &scene,
                   const contact::ContactModel &model);

    /** Of the undeformed bodies, to the log. */
    void
    say_start(Log &log) const;

    /** Takes down what is closed at the end of an increment. */
    void
    see(const model::IncrementRecord &record);

    /** Contacts whose pressures are those of facets at the last increment. */
    const std::set<unsigned int> &
    faceted() const
    {
      return of_facets;
    }
    /** Of the last increment, and of all if the run has come to its end. */
    void
    say_end(const bool is_whole, Log &log) const;

  private:
    struct Closed
    {
      std::vector<double>       gaps; ///< where bodies are undeformed [length]
      std::vector<double>       facets; ///< what they may be off by [length]
      std::vector<Tensor<1, 3>> normals;
      pairing::PressurePattern::Pressures pressures;
    };
    /** What a warning says of one that is not meant; empty: there is none. */
    std::string
    interference(const unsigned int contact, Log &log) const;
    /** What facets do to a bilateral contact; empty: there are none. */
    std::string
    hinge(const unsigned int contact) const;
    void
    judge_facets(const unsigned int contact, const Closed &closed);
    /** What facets do to pressures; empty: nothing. */
    std::string
    of_second_degree(const unsigned int c) const;
    std::string
    of_facet(const unsigned int contact,
             const Closed      &closed,
             const double       facet) const;
    /** Of pressures that go up and down from node to node; else empty. */
    std::string
    uneven(const unsigned int contact, const Closed &closed) const;
    void
    find_what_could_press();
    void
    judge_lonely(const unsigned int contact, const Closed &closed);
    void
    judge_thin(const unsigned int contact, const Closed &closed);
    /** Whether a side is curved, so that contact begins at a point or line. */
    bool
    is_curved(const unsigned int contact) const;
    void
    say_never_closed(Log &log) const;

    const application::Scene           &scene;
    const contact::ContactModel        &model;
    pairing::SlidingContacts            contacts;
    std::vector<pairing::ContactFacets> facets; ///< of each contact
    /** Of contacts, by number. */
    std::map<unsigned int, pairing::PressurePattern> patterns;
    /** Nodes of these that could press, or gave that to others. */
    std::map<unsigned int, std::set<unsigned int>> could_press;
    std::vector<bool>                              second_degree, has_closed;
    std::vector<double>                 least_gaps; ///< of the last increment
    WaysOfWear                          ways_of_wear;
    FacetMoments                        facet_moments;
    std::set<unsigned int>              of_facets;
    std::map<unsigned int, std::string> sentences; ///< of these contacts
  };
} // namespace conetact::analysis

#endif
