// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_hierarchical_means_h
#define conetact_contact_hierarchical_means_h

#include "conetact/contact/contact_points.h"

#include <map>
#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * Means over faces of second degree, with functions of corners, in the
   * hierarchical basis: a node in the middle of an edge moves as the mean of
   * its ends and by something of its own, one in the middle of a face by
   * something beside the mean of its corners. There each mean over whole faces
   * is its own corner, by a weight of one, and what middles have of their own:
   * no other corner. So a contact point gives its unknown to its node. (B.
   * Wohlmuth, A. Popp, M.W. Gee, W.A. Wall, Comput. Mech. 49 (2012) 735-747.)
   */
  class HierarchicalMeans
  {
  public:
    using Weights = std::vector<std::pair<unsigned int, double>>;
    using Key     = std::pair<unsigned int, unsigned int>; ///< body, node

    HierarchicalMeans(const model::Bodies &bodies,
                      const NodeRules     &rules,
                      const ContactPoints &points);

    /** The corners that a node is in the middle of; null: none. */
    const Weights *
    corners(const unsigned int body, const unsigned int node) const
    {
      const auto found = of_middles.find({body, node});
      return found == of_middles.end() ? nullptr : &found->second;
    }
    const std::map<Key, Weights> &
    all_middles() const
    {
      return of_middles;
    }
    /** All nodes in the middle that a corner carries, and its parts of them. */
    const Weights &
    middles(const unsigned int body, const unsigned int corner) const;

    /** Weights of nodes on the own side of a contact node: those of middles are
     * of what they have of their own. */
    Weights
    weights(const pairing::ContactNode &node) const;
    /** The weight of its own node among them. */
    double
    own_weight(const pairing::ContactNode &node) const;

  private:
    void
    find_middles(const unsigned int       body,
                 const NodeRules         &rules,
                 const bodies::Structure &structure);

    std::map<Key, Weights> of_middles, of_corners;
  };
} // namespace conetact::contact

#endif
