// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_round_facets_h
#define conetact_analysis_round_facets_h

#include "conetact/application/scene.h"
#include "conetact/contact/contact_model.h"

#include <map>
#include <utility>

namespace conetact::analysis
{
  /** What smooth sides of contacts turn by from one face to the next; found for
   * sides that are asked for. */
  class RoundFacets
  {
  public:
    /** Both must outlive the object. */
    RoundFacets(const application::Scene    &scene,
                const contact::ContactModel &model);

    /** At a node, on either side of it [rad]; 0: neither is round. */
    double
    at(const pairing::ContactNode &node);

  private:
    using AtNodes = std::map<unsigned int, double>;
    const AtNodes &
    side(const unsigned int contact, const bool is_master);

    const application::Scene                        &scene;
    const contact::ContactModel                     &model;
    std::map<std::pair<unsigned int, bool>, AtNodes> known; ///< by contact
  };
} // namespace conetact::analysis

#endif
