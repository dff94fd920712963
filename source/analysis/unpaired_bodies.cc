// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/unpaired_bodies.h"

#include "conetact/base/text.h"
#include "conetact/bodies/displaced.h"

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
    deep(const pairing::Solid &body, const pairing::Solid &other)
    {
      const auto found = other.deepest_inside(body);
      return found && found->depth > least_depth * found->edge ? found :
                                                                 std::nullopt;
    }
  } // namespace

  /** Where bodies stand that are displaced by u; none: undeformed. */
  class UnpairedBodies::Places
  {
  public:
    Places(const contact::ContactModel &m,
           const Eigen::VectorXd       &by,
           Boundaries                  &b)
      : model(m)
      , u(by)
      , boundaries(b)
    {}

    /** How deep one is in the other; most are far apart. */
    std::optional<pairing::Overlap>
    overlap(const unsigned int a, const unsigned int b)
    {
      const Place &one = place(a), &other = place(b);
      if (!meet(one.box, other.box))
        return {};
      const auto found = deep(solid(a), solid(b));
      return found ? found : deep(solid(b), solid(a));
    }

  private:
    struct Place
    {
      bodies::Displaced             body;
      Box                           box;
      std::optional<pairing::Solid> solid; ///< once it is asked for
    };

    Place &
    place(const unsigned int body)
    {
      const auto found = places.find(body);
      if (found != places.end())
        return found->second;
      bodies::Displaced where = displaced(model, u, body);
      const Box         box   = box_around(where);
      return places.emplace(body, Place{std::move(where), box, {}})
        .first->second;
    }

    const pairing::Solid &
    solid(const unsigned int body)
    {
      Place &at = place(body);
      if (!at.solid)
        at.solid.emplace(boundaries
                           .try_emplace(body, *model.bodies.structures[body])
                           .first->second,
                         at.body);
      return *at.solid;
    }

    const contact::ContactModel  &model;
    const Eigen::VectorXd        &u;
    Boundaries                   &boundaries;
    std::map<unsigned int, Place> places;
  };

  UnpairedBodies::UnpairedBodies(const application::Scene    &s,
                                 const contact::ContactModel &m)
    : scene(s)
    , model(m)
  {
    if (!scene.near_sides)
      return;
    const Eigen::VectorXd none;
    Places                places(model, none, boundaries);
    for (const Pair &pair : scene.near_sides->apart)
      if (!places.overlap(pair.first, pair.second))
        pairs.push_back(pair);
  }

  std::string
  UnpairedBodies::overlap(const Eigen::VectorXd &u) const
  {
    Places places(model, u, boundaries);
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
