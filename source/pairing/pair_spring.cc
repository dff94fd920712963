// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/pair_spring.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/bodies/probes.h"
#include "conetact/pairing/node_to_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::pairing
{
  namespace
  {
    using Weights = std::vector<std::pair<unsigned int, double>>;

    /**
     * The shape of what is at no place: springs say themselves where they end.
     */
    class Nowhere : public ObstacleShape
    {
    public:
      Closest
      closest(const Point<3> & /*p*/, const double /*spacing*/) const override
      {
        return {std::numeric_limits<double>::max(), Tensor<1, 3>({0., 1., 0.})};
      }
      bool
      states_gaps() const override
      {
        return true;
      }
    };

    /** How the displacement at a point follows from those of nodes. Throws
     * InputError where no node or cell is there. */
    Weights
    weights_at(const Point<3>          &p,
               const bodies::Structure &body,
               const std::string       &in)
    {
      constexpr unsigned int y      = 1; // also of bodies of revolution
      const auto             shapes = bodies::shapes_at(body, p, y);
      if (!shapes)
        throw InputError(in + to_text(p) +
                         " is in no cell of the body. Give an undeformed point "
                         "inside of it or on its surface.");
      Weights weights;
      double  moments = 0;
      for (const auto &[dof, part] : *shapes)
        if (const auto i = static_cast<unsigned int>(dof);
            i % body.n_components() == y)
          weights.emplace_back(i / body.n_components(), part);
        else
          moments = std::max(moments, std::abs(part));
      // Members share out a force to their nodes by moments, too.
      if (moments > 1e-12 || weights.empty())
        throw InputError(
          in + to_text(p) +
          " is within a member of a frame. Springs of frames "
          "stand at nodes: give the position of one, or add it.");
      return weights;
    }

    /**
     * A contact node has a number for tables: of the nodes of its cell the one
     * that the point is next to.
     */
    unsigned int
    heaviest(const Weights &weights)
    {
      return std::max_element(weights.begin(),
                              weights.end(),
                              [](const auto &one, const auto &other) {
                                return one.second < other.second;
                              })
        ->first;
    }
  } // namespace

  /* One object for all springs that end at no body: contacts keep its
     address. */
  const Obstacle &
  ground()
  {
    static const Obstacle nothing = [] {
      Obstacle made;
      made.name  = "ground";
      made.shape = std::make_unique<Nowhere>();
      return made;
    }();
    return nothing;
  }

  PairedNodes
  pair_spring(const Contact                                &contact,
              const std::vector<const bodies::Structure *> &structures)
  {
    const SpringLaw         &spring = *contact.spring;
    const bodies::Structure &body   = *structures[contact.body];
    const std::string        in     = "Contact '" + contact.name + "', ";
    ContactNode              node;
    node.spring   = contact.spring;
    node.body     = contact.body;
    node.position = spring.point();
    node.slaves   = weights_at(spring.point(), body, in + "Point: ");
    node.node     = heaviest(node.slaves);
    node.obstacle = contact.obstacle;
    node.n        = spring.normal();
    node.gap      = spring.gap();
    // A spring has no faces: a part of the body stands for their edges.
    node.spacing = size_of(body, body) / 100;
    if (contact.obstacle == nullptr)
      {
        node.master  = contact.master;
        node.masters = weights_at(spring.end(),
                                  *structures[contact.master],
                                  in + "Master point: ");
      }
    if (body.is_axisymmetric() && std::abs(node.n[1]) < 1 - 1e-12)
      throw InputError(in + "Master point: a body of revolution feels springs "
                            "along its axis only. Let both points have the "
                            "same x.");
    PairedNodes found;
    found.n_nodes = found.n_paired = 1;
    found.nodes.push_back(std::move(node));
    return found;
  }
} // namespace conetact::pairing
