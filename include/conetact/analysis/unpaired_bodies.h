// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_unpaired_bodies_h
#define conetact_analysis_unpaired_bodies_h

#include "conetact/application/scene.h"
#include "conetact/contact/contact_model.h"
#include "conetact/pairing/overlap.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace conetact::analysis
{
  /**
   * Bodies between which `Contacts = automatic` has found no contact, for they
   * are too far apart at the start: nothing keeps them from passing through
   * each other.
   */
  class UnpairedBodies
  {
  public:
    /** Pairs that overlap from the start on are meant so. Both must outlive
     * the object. */
    UnpairedBodies(const application::Scene    &scene,
                   const contact::ContactModel &model);

    /** Which of them overlap, displaced by u (all dofs, in space [length]): a
     * sentence; empty: none do. */
    std::string
    overlap(const Eigen::VectorXd &u) const;

  private:
    using Pair       = std::pair<unsigned int, unsigned int>;
    using Boundaries = std::map<unsigned int, pairing::Boundary>;
    class Places;

    const application::Scene    &scene;
    const contact::ContactModel &model;
    std::vector<Pair>            pairs;
    mutable Boundaries boundaries; ///< of bodies that come near others
  };
} // namespace conetact::analysis

#endif
