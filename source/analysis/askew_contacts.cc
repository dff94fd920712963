// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/askew_contacts.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    /** Between where a node is pressed from and the normals of its body [rad].
     * An edge or a corner of the body may be pressed along any direction
     between the normals of its faces, whether these are in the contact or not.
   */
    double
    angle_to_body(const model::Bodies &bodies, const pairing::ContactNode &node)
    {
      const auto  &frames_now = bodies.frames;
      Tensor<1, 3> towards    = -node.n;
      if (node.body < frames_now.size())
        towards = transpose(frames_now[node.body].rotation) * towards;
      const auto angle = [&](const std::vector<Tensor<1, 3>> &normals) {
        return std::acos(
          std::min(1., pairing::nearest_in_cone(towards, normals).norm()));
      };
      double nearest = M_PI / 2;
      for (const Tensor<1, 3> &n : node.outward)
        nearest = std::min(nearest, angle({n}));
      if (nearest < M_PI / 12) // most often
        return nearest;
      const bodies::Structure &body  = *bodies.structures[node.body];
      const auto               nodes = body.surface(body.boundary_ids()).nodes;
      const auto               found = std::lower_bound(nodes.begin(),
                                          nodes.end(),
                                          node.node,
                                          [](const auto        &surface_node,
                                             const unsigned int number) {
                                            return surface_node.node < number;
                                          });
      if (found == nodes.end() || found->node != node.node)
        return nearest;
      return std::min(nearest, angle(found->normals));
    }
  } // namespace

  std::string
  meets_askew(const contact::ContactModel &model, const Eigen::VectorXd &r)
  {
    constexpr double largest = M_PI / 6, little = 1e-2; // of the largest force
    double           scale = 0;
    for (const contact::ContactPoint &point : model.points)
      scale = std::max(scale, contact::force_of(point, r).norm());
    for (const contact::ContactPoint &point : model.points)
      {
        const pairing::ContactNode &node = *point.node;
        if (node.obstacle == nullptr || node.outward.empty() ||
            contact::force_of(point, r).norm() <= little * scale)
          continue;
        const double askew = angle_to_body(model.bodies, node);
        if (askew > largest)
          return "obstacle '" + node.obstacle->name + "' presses on " +
                 model.bodies.called(node.body) + " at the node " +
                 to_text(node.position) + " along " +
                 to_text(Point<3>(node.n)) + ", " +
                 to_text(askew * 180 / M_PI) +
                 " degrees off the body's normal there, as where an edge is in "
                 "between nodes: its reactions are as wrong. Use smaller cells "
                 "there, a rounded obstacle, or a body in its place";
      }
    return "";
  }
} // namespace conetact::analysis
