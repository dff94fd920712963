// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/contact_facets.h"

#include "conetact/pairing/obstacle_shapes.h"

#include <algorithm>

namespace conetact::pairing
{
  namespace
  {
    std::optional<Facets>
    facets_of(const bodies::Structure &body, const bodies::BoundaryIds &ids)
    {
      const bodies::Surface surface = body.surface(ids);
      if (surface.two_sided || surface.faces.empty())
        return {};
      return Facets(FaceNet(body, surface).all());
    }
  } // namespace

  ContactFacets::ContactFacets(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures)
    : slave(facets_of(*structures[contact.body], contact.ids))
  {
    if (contact.obstacle == nullptr)
      master = facets_of(*structures[contact.master], contact.master_ids);
  }

  /** The sagitta of the facets that a node meets; of several masters the
   * largest. */
  double
  ContactFacets::of_other_side(const ContactNode &node) const
  {
    if (node.obstacle != nullptr)
      return sagitta_at(*node.obstacle->shape, node.foot());
    double largest = 0;
    if (master)
      for (const auto &[number, weight] : node.masters)
        largest = std::max(largest, master->at(number));
    return largest;
  }

  double
  ContactFacets::in_gap(const ContactNode &node) const
  {
    // A mean over faces has gaps of all points of them, a single node only its
    // own: it stands on the curve unless it is inside of a facet.
    const double own = !slave       ? 0 :
                       node.is_mean ? slave->at(node.node) :
                                      slave->of_node(node.node);
    return own + of_other_side(node);
  }

  double
  ContactFacets::around(const ContactNode &node) const
  {
    return (slave ? slave->at(node.node) : 0) + of_other_side(node);
  }

  /* How far a gap may be from what was meant because faces are chords: bent
     faces follow a curve, but as parabolas, and means weigh both. */
  double
  ContactFacets::allowance(const ContactNode &node) const
  {
    double result = around(node);
    if (node.slaves.empty())
      return result;
    if (node.obstacle != nullptr)
      result += std::abs(gap_beside_own(node));
    result += slave ? slave->bent_at(node.node) : 0.;
    for (const auto &[number, weight] : node.masters)
      if (master)
        result += std::abs(weight) * master->bent_at(number);
    return result;
  }
} // namespace conetact::pairing
