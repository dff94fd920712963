// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/hierarchical_means.h"

#include "conetact/bodies/face_nodes.h"

#include <cmath>
#include <set>

namespace conetact::contact
{
  namespace
  {
    /** Weights below this are the rounding of a sum that is 1. */
    constexpr double weight_rounding = 1e-13;
  } // namespace

  HierarchicalMeans::HierarchicalMeans(const model::Bodies &bodies,
                                       const NodeRules     &rules,
                                       const ContactPoints &points)
  {
    std::set<unsigned int> with_means;
    std::set<Key>          nodes;
    for (const ContactPoint &point : points.all())
      {
        nodes.insert({point.node->body, point.node->node});
        if (!point.node->slaves.empty() &&
            bodies.structures[point.node->body]->meets_at_corners())
          with_means.insert(point.node->body);
      }
    for (const unsigned int body : with_means)
      find_middles(body, rules, *bodies.structures[body]);
    // A middle that has a contact of its own moves by its own unknowns.
    for (const Key &node : nodes)
      of_middles.erase(node);
    for (const auto &[middle, corners] : of_middles)
      for (const auto &[corner, weight] : corners)
        of_corners[{middle.first, corner}].emplace_back(middle.second, weight);
  }

  void
  HierarchicalMeans::find_middles(const unsigned int       body,
                                  const NodeRules         &rules,
                                  const bodies::Structure &structure)
  {
    for (const bodies::SurfaceFace &face :
         structure.surface(structure.boundary_ids()).faces)
      if (face.meets_at_corners)
        for (const bodies::HangingNode &middle :
             bodies::middle_nodes(structure, face))
          if (const NodeRule *const rule = rules.find(body, middle.node);
              rule == nullptr || rule->masters.empty())
            of_middles[{body, middle.node}] = middle.masters;
  }

  const HierarchicalMeans::Weights &
  HierarchicalMeans::middles(const unsigned int body,
                             const unsigned int corner) const
  {
    static const Weights none;
    const auto           found = of_corners.find({body, corner});
    return found == of_corners.end() ? none : found->second;
  }

  /* A middle moves by sum_c p_c u_c, its parts p_c of corners, and by something
     of its own: a mean sum w u has w of that, and w p_c more of each corner.
     With dual functions over whole faces these sums are 0 for all corners but
     one. */
  HierarchicalMeans::Weights
  HierarchicalMeans::weights(const pairing::ContactNode &node) const
  {
    std::map<unsigned int, double> sum;
    pairing::for_each_slave(node,
                            [&](const unsigned int slave, const double weight) {
                              sum[slave] += weight;
                              if (const Weights *const own =
                                    corners(node.body, slave))
                                for (const auto &[corner, part] : *own)
                                  sum[corner] += part * weight;
                            });
    Weights result;
    for (const auto &[slave, weight] : sum)
      if (std::abs(weight) > weight_rounding)
        result.emplace_back(slave, weight);
    return result;
  }

  /* By this a mean is divided where it is the unknown of its node
     (Coordinates::append_own()): it must be far from 0, which
     has_tangled_means() asks for. */
  double
  HierarchicalMeans::own_weight(const pairing::ContactNode &node) const
  {
    for (const auto &[slave, weight] : weights(node))
      if (slave == node.node)
        return weight;
    return 0;
  }
} // namespace conetact::contact
