// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/adjusted_gaps.h"

#include "conetact/pairing/contact_facets.h"
#include "conetact/pairing/node_to_face.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace conetact::pairing
{
  namespace
  {
    /**
     * Gaps g up to a margin m are those of facets: zero. So that there is no
     * step to gaps that are drawn, beyond it they are 3/2 (|g| - m) with the
     * sign of g, which from 3 m on is g itself.
     */
    double
    without_facets(const double gap, const double margin)
    {
      constexpr double ramp = 3;
      const double     size = std::abs(gap);
      if (size <= margin || size >= ramp * margin)
        return size <= margin ? 0 : gap;
      return std::copysign(ramp * (size - margin) / (ramp - 1), gap);
    }
    /** Gaps of nodes by themselves, of which means are taken. */
    class OwnGaps
    {
    public:
      OwnGaps(const Contact                                &contact,
              const std::vector<const bodies::Structure *> &structures)
        : one_by_one(contact, structures)
      {
        for (const bodies::SurfaceNode &s : one_by_one.slave_surface().nodes)
          places[s.node] = &s;
      }

      /** Nothing of a node that is no mean, or meets nothing by itself. */
      std::optional<double>
      at(const ContactNode &node) const
      {
        if (!node.least_gap)
          return {};
        if (node.obstacle != nullptr)
          {
            const auto closest =
              node.obstacle->shape->closest_after(node.position,
                                                  Tensor<1, 3>(),
                                                  node.spacing);
            return closest ? std::optional<double>(closest->gap) : std::nullopt;
          }
        const bodies::SurfaceNode &place = *places.at(node.node);
        const auto                 foot = one_by_one.foot(place, place.normals);
        return foot ? std::optional<double>(foot->gap) : std::nullopt;
      }

    private:
      NodeToFace                                          one_by_one;
      std::map<unsigned int, const bodies::SurfaceNode *> places;
    };

    /** By as much as all, but no further than its own gap: where faces are
     * plane, or less bent, its mean is less below that. */
    void
    lift_node(ContactNode                 &node,
              const double                 lift,
              const std::optional<double> &own_gap)
    {
      const double below = own_gap ? *own_gap - node.gap : lift;
      if (const double by = std::clamp(below, 0., lift); by > 0)
        node.growth = [by](const double) { return by; };
    }
  } // namespace

  bool
  lift_convex_faces(const Contact                                &contact,
                    const unsigned int                            number,
                    const std::vector<const bodies::Structure *> &structures,
                    std::vector<ContactNode>                     &nodes)
  {
    if (contact.kind != ContactKind::contact || contact.gap)
      return 0;
    std::optional<ContactFacets> facets; // few contacts need them
    double                       lift = 0;
    for (const ContactNode &node : nodes)
      if (node.contact == number && node.least_gap)
        if (const double below = *node.least_gap - node.gap; below > lift)
          {
            if (!facets)
              facets.emplace(contact, structures);
            // Facets of what it meets leave differences of their own.
            if (below > facet_margin * facets->around(node))
              lift = below;
          }
    if (lift == 0)
      return false;
    const OwnGaps own_gaps(contact, structures);
    for (ContactNode &node : nodes)
      if (node.contact == number)
        lift_node(node, lift, own_gaps.at(node));
    return true;
  }

  /* A gap that is adjusted stays the drawn one, and grows by the difference
     from t = 0 on: feet, arms of moments and true gaps are those of the faces.
   */
  void
  adjust_gaps(const Contact                                &contact,
              const unsigned int                            number,
              const std::vector<const bodies::Structure *> &structures,
              std::vector<ContactNode>                     &nodes)
  {
    const ContactFacets facets(contact, structures);
    const auto          margin = [&](const ContactNode &node) {
      return facet_margin * facets.around(node);
    };
    // Sides that nowhere touch are meant to be apart: their gaps are not those
    // of facets, however small.
    const bool touches =
      std::any_of(nodes.begin(), nodes.end(), [&](const ContactNode &node) {
        return node.contact == number && !node.meets_nothing() &&
               std::abs(gap_at_start(node)) <= margin(node);
      });
    for (ContactNode &node : nodes)
      if (node.contact == number)
        {
          const double start = gap_at_start(node);
          const double taken = touches && !node.meets_nothing() ?
                                 without_facets(start, margin(node)) :
                                 start;
          node.growth        = [change = taken - node.gap](const double) {
            return change;
          };
        }
  }

  double
  gap_at_start(const ContactNode &node)
  {
    return node.gap + (node.growth ? node.growth(0) : 0);
  }
} // namespace conetact::pairing
