// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/blunt_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::pairing
{
  namespace
  {
    /** So much may faces of one surface turn more than others by the mesh:
     * `twice` the angle, and a little. */
    constexpr double twice = 2, by_mesh = 5 * M_PI / 180;

    /** Faces at a node, and the largest angle between two of them that is none
     * of a sharp edge [rad]. */
    struct Around
    {
      std::vector<const FaceNet::Face *> faces;
      double                             turn = 0;

      /** At the rim of a surface there is nothing to turn to. */
      bool
      is_inside() const
      {
        return faces.size() >= faces.front()->corners.size();
      }
    };

    /** Between the middles of two faces, less what bends in them. */
    double
    turn_at_edge(const FaceNet::Face &one,
                 const FaceNet::Face &other,
                 const double         cosine)
    {
      const auto half_of_arc = [](const FaceNet::Face &face) {
        return 4 * face.sagitta / face.size;
      };
      return std::acos(cosine) - half_of_arc(one) - half_of_arc(other);
    }

    double
    largest_turn(const std::vector<const FaceNet::Face *> &faces,
                 const double                              sharp)
    {
      double turn = 0;
      for (const FaceNet::Face *const one : faces)
        for (const FaceNet::Face *const other : faces)
          if (const double cosine = one->outward * other->outward;
              cosine >= sharp && cosine < 1)
            turn = std::max(turn, turn_at_edge(*one, *other, cosine));
      return turn;
    }
    /** By how much normals turn from the middle of a face to that of the next
     * one over the way between [1/length], where it is most. */
    double
    largest_curvature(const std::vector<const FaceNet::Face *> &faces,
                      const double                              sharp)
    {
      constexpr double flat    = 1e-4; // rad
      double           largest = 0;
      for (const FaceNet::Face *const one : faces)
        for (const FaceNet::Face *const other : faces)
          {
            const Tensor<1, 3> turn = other->outward - one->outward,
                               way  = other->centre - one->centre;
            if (one->outward * other->outward < sharp || turn.norm() < flat)
              continue;
            const double curvature =
              std::copysign(turn.norm() / way.norm(), turn * way);
            if (std::abs(curvature) > std::abs(largest))
              largest = curvature;
          }
      return largest;
    }

    /** Which part the normal of a side has by how much both are bent: a side
     * that is flat beside the other one has all of it. */
    double
    part_by_curvature(const double own, const double other)
    {
      constexpr double flat = .05, bent = .2; // over the other curvature
      const double     less = std::min(std::abs(own), std::abs(other)),
                   more     = std::max(std::abs(own), std::abs(other));
      const bool is_flat    = std::abs(own) < std::abs(other);
      if (more == 0 || (is_flat ? other : own) < 0) // both are, or a hollow
        return .5;
      const double part =
        .5 * std::clamp((bent - less / more) / (bent - flat), 0., 1.);
      return is_flat ? .5 + part : .5 - part;
    }

    /** A mean over nodes, by the sizes of their weights; 0 at those without. */
    double
    mean_of(const std::map<unsigned int, double>               &values,
            const std::vector<std::pair<unsigned int, double>> &nodes)
    {
      double sum = 0, whole = 0;
      for (const auto &[node, weight] : nodes)
        {
          const auto found = values.find(node);
          sum += std::abs(weight) * (found == values.end() ? 0 : found->second);
          whole += std::abs(weight);
        }
      return whole > 0 ? sum / whole : 0.;
    }
  } // namespace

  BluntEdges::BluntEdges(const std::vector<FaceNet::Face> &faces,
                         const double                      cosine)
  {
    std::map<unsigned int, Around> around;
    for (const FaceNet::Face &face : faces)
      for (std::size_t c = 0; c < face.corners.size(); ++c)
        around[face.nodes[c]].faces.push_back(&face);
    for (auto &[node, at_node] : around)
      {
        at_node.turn     = largest_turn(at_node.faces, cosine);
        curvatures[node] = largest_curvature(at_node.faces, cosine);
      }
    for (const FaceNet::Face &face : faces) // nodes between corners
      {
        double sum = 0;
        for (std::size_t c = 0; c < face.corners.size(); ++c)
          sum += curvatures.at(face.nodes[c]);
        for (std::size_t i = face.corners.size(); i < face.nodes.size(); ++i)
          curvatures[face.nodes[i]] =
            sum / static_cast<double>(face.corners.size());
      }
    for (const auto &[node, at_node] : around)
      {
        if (at_node.turn <= by_mesh || !at_node.is_inside())
          continue;
        double beside = std::numeric_limits<double>::max();
        for (const FaceNet::Face *const face : at_node.faces)
          for (std::size_t c = 0; c < face->corners.size(); ++c)
            if (const Around &other = around.at(face->nodes[c]);
                face->nodes[c] != node && other.is_inside())
              beside = std::min(beside, other.turn);
        const double usual = twice * beside + by_mesh;
        if (beside < at_node.turn && at_node.turn > usual)
          excess[node] = at_node.turn - usual;
      }
  }

  double
  BluntEdges::at(const unsigned int node) const
  {
    const auto found = excess.find(node);
    return found == excess.end() ? 0. : found->second;
  }

  double
  BluntEdges::at(
    const std::vector<std::pair<unsigned int, double>> &nodes) const
  {
    return mean_of(excess, nodes);
  }

  double
  BluntEdges::curvature(
    const std::vector<std::pair<unsigned int, double>> &nodes) const
  {
    return mean_of(curvatures, nodes);
  }

  double
  part_of_normal(const BentSide &own, const BentSide &other)
  {
    constexpr double little = 2 * M_PI / 180;
    const auto       power  = [](const double angle) {
      return std::pow(angle / little, 4);
    };
    const double by_curvature =
      part_by_curvature(own.curvature, other.curvature);
    return (power(other.edge) + 2 * by_curvature) /
           (power(own.edge) + power(other.edge) + 2);
  }
} // namespace conetact::pairing
