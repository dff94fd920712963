// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_facet_moments_h
#define conetact_analysis_facet_moments_h

#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_points.h"
#include "conetact/model/increment_record.h"
#include "conetact/pairing/round_surface.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /** Warns where two round sides about one axis turn each other by normal
   * forces: round bodies cannot, their facets do. */
  class FacetMoments
  {
  public:
    /** The scene must outlive the object. */
    explicit FacetMoments(const application::Scene &s)
      : scene(s)
    {}

    /** An increment, with a row for each point of contact first. */
    void
    see(const contact::ContactPoints         &points,
        const std::vector<model::ContactRow> &rows);
    /** Of the last one. */
    void
    say(Log &log) const;

  private:
    /** About the axis, of one contact. */
    struct Moments
    {
      double normal   = 0; ///< of normal forces [force x length]
      double friction = 0; ///< of friction [force x length]
      double most     = 0; ///< of friction that slips everywhere, if it may
      bool   all_slip = true;
    };
    /** What both sides are round about; none: they are not, or move far. */
    const std::optional<pairing::RoundSurface> &
    round(const unsigned int contact);

    const application::Scene                                    &scene;
    std::map<unsigned int, std::optional<pairing::RoundSurface>> rounds;
    std::map<unsigned int, Moments>                              last;
  };
} // namespace conetact::analysis

#endif
