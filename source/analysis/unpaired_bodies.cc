// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/unpaired_bodies.h"

#include "conetact/base/text.h"
#include "conetact/bodies/displaced.h"
#include "conetact/pairing/overlap.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <map>

namespace conetact::analysis
{
  namespace
  {
    using Box = dealii::BoundingBox<3>;

    /** Of an edge: what is inside by less may be that of curved sides. */
    constexpr double least_depth = .02;

    bodies::Displaced
    displaced(const contact::ContactModel &model,
              const Eigen::VectorXd       &u,
              const unsigned int           body)
    {
      const bodies::Structure  &structure = *model.bodies.structures[body];
      std::vector<Tensor<1, 3>> by(structure.n_nodes());
      if (u.size() > 0)
        for (unsigned int node = 0; node < structure.n_nodes(); ++node)
          by[node] = model.displacement(u, body, node);
      return bodies::Displaced(structure, std::move(by));
    }

    Box
    box_around(const bodies::Structure &body)
    {
      std::vector<Point<3>> places;
      for (unsigned int node = 0; node < body.n_nodes(); ++node)
        places.push_back(body.position(node));
      return Box(places);
    }

    bool
    meet(const Box &one, const Box &other)
    {
      for (unsigned int d = 0; d < 3; ++d)
        if (one.lower_bound(d) > other.upper_bound(d) ||
            other.lower_bound(d) > one.upper_bound(d))
          return false;
      return true;
    }

    std::optional<pairing::Overlap>
    deep(const bodies::Structure &body, const bodies::Structure &other)
    {
      const auto found = pairing::deepest_inside(body, other);
      return found && found->depth > least_depth * found->edge ? found :
                                                                 std::nullopt;
    }

    /** Where bodies stand that are displaced by u; none: undeformed. */
    class Places
    {
    public:
      Places(const contact::ContactModel &m, const Eigen::VectorXd &by)
        : model(m)
        , u(by)
      {}

      /** How deep one is in the other; most are far apart. */
      std::optional<pairing::Overlap>
      overlap(const unsigned int a, const unsigned int b)
      {
        if (!meet(box(a), box(b)))
          return {};
        const auto one = displaced(model, u, a), other = displaced(model, u, b);
        const auto found = deep(one, other);
        return found ? found : deep(other, one);
      }

    private:
      const Box &
      box(const unsigned int body)
      {
        const auto found = boxes.find(body);
        return found != boxes.end() ?
                 found->second :
                 boxes.emplace(body, box_around(displaced(model, u, body)))
                   .first->second;
      }

      const contact::ContactModel &model;
      const Eigen::VectorXd       &u;
      std::map<unsigned int, Box>  boxes;
    };
  } // namespace

  UnpairedBodies::UnpairedBodies(const application::Scene    &s,
                                 const contact::ContactModel &m)
    : scene(s)
    , model(m)
  {
    if (!scene.near_sides)
      return;
    const Eigen::VectorXd none;
    Places                places(model, none);
    for (const Pair &pair : scene.near_sides->apart)
      if (!places.overlap(pair.first, pair.second))
        pairs.push_back(pair);
  }

  std::string
  UnpairedBodies::overlap(const Eigen::VectorXd &u) const
  {
    Places places(model, u);
    for (const auto &[a, b] : pairs)
      if (const auto found = places.overlap(a, b))
        return scene.bodies.called(a) + " and " + scene.bodies.called(b) +
               " come " + to_text(found->depth) + " into each other at " +
               to_text(found->position) +
               ", and have no contact: Contacts = automatic finds those that "
               "are near at the start. Set Automatic contact/Largest gap to "
               "what is between them there, or write a Contact of theirs";
    return "";
  }
} // namespace conetact::analysis
