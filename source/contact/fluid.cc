// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/fluid.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>

namespace conetact::contact
{
  namespace
  {
    /** Candidates of a contact by nodes of its body. */
    using Candidates = std::map<unsigned int, std::size_t>;

    std::map<unsigned int, Candidates>
    candidates_with_fluid(const ContactPoints &points)
    {
      std::map<unsigned int, Candidates> contacts;
      for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i].node->fluid)
          contacts[points[i].node->contact].emplace(points[i].node->node, i);
      return contacts;
    }

    /** Nodes at the source that supports hold are no candidates and carry no
     * fluid: it comes to the candidates next to them. */
    std::set<std::size_t>
    beside_held_sources(const pairing::FluidLaw      &fluid,
                        const bodies::Structure      &structure,
                        const Candidates             &candidates,
                        const std::set<unsigned int> &held)
    {
      std::set<unsigned int> starts;
      if (!fluid.source().empty())
        for (const bodies::SurfaceNode &node :
             structure.surface(fluid.source()).nodes)
          if (held.count(node.node) > 0 && candidates.count(node.node) == 0)
            starts.insert(node.node);
      std::set<std::size_t> found;
      if (!starts.empty())
        for (const auto &face : structure.surface(fluid.surface()).faces)
          if (std::any_of(face.nodes.begin(),
                          face.nodes.end(),
                          [&](const unsigned int i) {
                            return starts.count(i) > 0;
                          }))
            for (const unsigned int i : face.nodes)
              if (const auto at = candidates.find(i); at != candidates.end())
                found.insert(at->second);
      return found;
    }

    std::set<unsigned int>
    held_nodes_of(const model::Bodies &bodies, const unsigned int body)
    {
      std::set<unsigned int> nodes;
      for (const auto &[key, directions] : supported_nodes(bodies))
        if (key.first == body)
          nodes.insert(key.second);
      return nodes;
    }

    std::set<std::size_t>
    on(const bodies::Structure   &structure,
       const bodies::BoundaryIds &ids,
       const Candidates          &candidates)
    {
      std::set<std::size_t> found;
      if (!ids.empty())
        for (const bodies::SurfaceNode &node : structure.surface(ids).nodes)
          if (const auto at = candidates.find(node.node);
              at != candidates.end())
            found.insert(at->second);
      return found;
    }

    /** Candidates on the boundary that the fluid comes from, and the one
     * nearest to a point of its source. */
    std::set<std::size_t>
    sources_of(const pairing::FluidLaw &fluid,
               const bodies::Structure &structure,
               const Candidates        &candidates,
               const ContactPoints     &points)
    {
      std::set<std::size_t> found = on(structure, fluid.source(), candidates);
      if (!fluid.source_point())
        return found;
      const auto next =
        std::min_element(candidates.begin(),
                         candidates.end(),
                         [&](const auto &a, const auto &b) {
                           const Point<3> &p = *fluid.source_point();
                           return points[a.second].node->position.distance(p) <
                                  points[b.second].node->position.distance(p);
                         });
      found.insert(next->second);
      return found;
    }

    bool
    is_supported(const model::Bodies &bodies,
                 const unsigned int   body,
                 const unsigned int   id)
    {
      return std::any_of(bodies.supports.begin(),
                         bodies.supports.end(),
                         [&](const bodies::Support &support) {
                           return support.body == body &&
                                  support.ids.count(id) > 0;
                         });
    }
  } // namespace

  Fluid::Fluid(const model::Bodies &bodies, const ContactPoints &points)
  {
    const auto contacts = candidates_with_fluid(points);
    if (contacts.empty())
      return;
    neighbours.resize(points.size());
    exits.assign(points.size(), false);
    for (const auto &[contact, candidates] : contacts)
      {
        const pairing::ContactNode &node =
          *points[candidates.begin()->second].node;
        const bodies::Structure &structure = *bodies.structures[node.body];
        const pairing::FluidLaw &fluid     = *node.fluid;
        // Candidates of one face are next to each other; repetitions do no
        // harm.
        for (const auto &face : structure.surface(fluid.surface()).faces)
          for (const unsigned int a : face.nodes)
            for (const unsigned int b : face.nodes)
              if (a != b && candidates.count(a) > 0 && candidates.count(b) > 0)
                neighbours[candidates.at(a)].push_back(candidates.at(b));
        auto starts = sources_of(fluid, structure, candidates, points);
        starts.merge(beside_held_sources(
          fluid, structure, candidates, held_nodes_of(bodies, node.body)));
        sources.insert(sources.end(), starts.begin(), starts.end());
        // An edge of the contact belongs to other boundaries as well. One that
        // a source wets or a support holds, such as a plane of symmetry, is
        // closed to the fluid; over any other one it leaves.
        for (const unsigned int id : structure.boundary_ids())
          {
            const auto edge = on(structure, {id}, candidates);
            const bool is_source =
              std::any_of(edge.begin(), edge.end(), [&](const std::size_t i) {
                return starts.count(i) > 0;
              });
            if (fluid.surface().count(id) == 0 && !is_source &&
                !is_supported(bodies, node.body, id))
              for (const std::size_t i : edge)
                exits[i] = true;
          }
      }
  }

  /* Spreads from the sources over neighbours that are wet already, or that
     press by less than the fluid does. An area without a way from a source
     stays dry, even if it is open. */
  std::vector<bool>
  Fluid::wet(const std::vector<bool> &before,
             const Eigen::VectorXd   &r,
             const ContactPoints     &points,
             const double             t) const
  {
    AssertDimension(neighbours.size(), points.size());
    Assert(r.size() >= points.n_unknowns(),
           dealii::ExcMessage("Each candidate has a reaction."));
    AssertDimension(before.size(), points.size());
    const auto lets_in = [&](const std::size_t i) {
      const pairing::ContactNode &node = *points[i].node;
      // [force]: r_n / area < p_fluid, without a division by an area that may
      // be 0.
      const double force = node.fluid->pressure(t) * node.covered_area();
      // Sides that do not see each other have no gap between them.
      return node.is_active(t) && (before[i] || r[points[i].normal()] < force);
    };
    std::vector<std::size_t> front;
    for (const std::size_t i : sources)
      if (lets_in(i))
        front.push_back(i);
    std::vector<bool> reached(points.size(), false);
    // A node that is wet once stays so within an increment (`before`): nodes
    // are only added, and the loop of increments over this ends.
    while (!front.empty())
      {
        const std::size_t i = front.back();
        front.pop_back();
        if (reached[i])
          continue;
        reached[i] = true;
        for (const std::size_t j : neighbours[i])
          if (!reached[j] && lets_in(j))
            front.push_back(j);
      }
    return reached;
  }

  std::set<unsigned int>
  Fluid::leaks(const std::vector<bool> &wet, const ContactPoints &points) const
  {
    AssertDimension(wet.size(), exits.size());
    AssertDimension(wet.size(), points.size());
    std::set<unsigned int> contacts;
    for (std::size_t i = 0; i < wet.size(); ++i)
      if (wet[i] && exits[i])
        contacts.insert(points[i].node->contact);
    return contacts;
  }
} // namespace conetact::contact
