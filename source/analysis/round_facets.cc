// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/round_facets.h"

#include "conetact/bodies/face_nodes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace conetact::analysis
{
  namespace
  {
    /** Largest angle between faces of a patch at each node [rad], where it is
     * no rounding. */
    std::map<unsigned int, double>
    turns_at_nodes(const std::vector<bodies::SurfaceFace> &faces)
    {
      constexpr double                                  flat = 1e-3; // rad
      std::map<unsigned int, std::vector<Tensor<1, 3>>> normals;
      for (const bodies::SurfaceFace &face : faces)
        for (const unsigned int i : face.nodes)
          normals[i].push_back(face.normal);
      std::map<unsigned int, double> turns;
      for (const auto &[node, at] : normals)
        {
          double turn = 0;
          for (const Tensor<1, 3> &a : at)
            for (const Tensor<1, 3> &b : at)
              if (const double angle = std::acos(std::min(1., a * b));
                  angle <= bodies::angle_of_patches)
                turn = std::max(turn, angle);
          if (turn > flat)
            turns[node] = turn;
        }
      return turns;
    }
  } // namespace

  RoundFacets::RoundFacets(const application::Scene    &s,
                           const contact::ContactModel &m)
    : scene(s)
    , model(m)
  {}

  const RoundFacets::AtNodes &
  RoundFacets::side(const unsigned int contact, const bool is_master)
  {
    const auto found = known.find({contact, is_master});
    if (found != known.end())
      return found->second;
    const pairing::Contact  &of = scene.contacts[contact];
    const bodies::Structure &body =
      *model.bodies.structures[is_master ? of.master : of.body];
    return known
      .emplace(std::make_pair(contact, is_master),
               turns_at_nodes(
                 body.surface(is_master ? of.master_ids : of.ids).faces))
      .first->second;
  }

  double
  RoundFacets::at(const pairing::ContactNode &node)
  {
    const auto in = [](const AtNodes &all, const unsigned int i) {
      const auto found = all.find(i);
      return found == all.end() ? 0. : found->second;
    };
    double largest = in(side(node.contact, false), node.node);
    if (node.obstacle == nullptr)
      for (const auto &[master, weight] : node.masters)
        largest = std::max(largest, in(side(node.contact, true), master));
    return largest;
  }
} // namespace conetact::analysis
