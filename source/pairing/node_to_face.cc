// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/node_to_face.h"

#include "conetact/bodies/face_nodes.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /** The longest edge of the faces at each node of a surface. */
    std::map<unsigned int, double>
    spacings(const bodies::Surface &surface, const bodies::Structure &body)
    {
      std::map<unsigned int, double> result;
      for (const bodies::SurfaceFace &face : surface.faces)
        {
          const std::size_t n       = bodies::n_corners(body, face);
          double            longest = 0;
          const auto edge = [&](const std::size_t i, const std::size_t j) {
            longest = std::max(longest,
                               body.position(face.nodes[i])
                                 .distance(body.position(face.nodes[j])));
          };
          edge(0, 1);
          if (n == 3)
            for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
              edge(i, 2);
          if (n == 4)
            for (const auto &[i, j] : {std::pair(0, 2), {1, 3}, {2, 3}})
              edge(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
          for (const unsigned int node : face.nodes)
            result[node] = std::max(result[node], longest);
        }
      for (const bodies::SurfaceNode &node :
           surface.nodes) // of frames without faces
        result.insert({node.node, std::sqrt(node.area)});
      return result;
    }
  } // namespace

  namespace
  {
    /** Nodes that both sides of a contact of a body with itself have. */
    std::set<unsigned int>
    joined_nodes(const Contact           &contact,
                 const bodies::Structure &body,
                 const bodies::Surface   &surface)
    {
      std::set<unsigned int> joined;
      if (contact.obstacle != nullptr || contact.body != contact.master)
        return joined;
      const bodies::Surface master = body.surface(contact.master_ids);
      for (const bodies::SurfaceNode &node : master.nodes)
        if (std::binary_search(surface.nodes.begin(),
                               surface.nodes.end(),
                               node,
                               [](const auto &a, const auto &b) {
                                 return a.node < b.node;
                               }))
          joined.insert(node.node);
      return joined;
    }
  } // namespace

  double
  interference_allowed(const Contact &contact, const double face_size)
  {
    return contact.interference.value_or(.25 * face_size);
  }

  NodeToFace::NodeToFace(
    const Contact                                &c,
    const std::vector<const bodies::Structure *> &structures)
    : contact(c)
    , body(*structures[contact.body])
    , surface(body.surface(contact.ids))
    , spacing(spacings(surface, body))
    , joined(joined_nodes(contact, body, surface))
  {
    if (contact.obstacle == nullptr)
      master.emplace(*structures[contact.master], contact.master_ids);
  }

  ContactNode
  NodeToFace::free_node(const bodies::SurfaceNode &s) const
  {
    ContactNode node;
    node.body     = contact.body;
    node.node     = s.node;
    node.position = s.position;
    node.area     = s.area;
    node.obstacle = contact.obstacle;
    node.spacing  = spacing.at(s.node);
    if (!surface.two_sided)
      node.outward = s.normals;
    return node;
  }

  ContactNode
  NodeToFace::apart(const bodies::SurfaceNode &s) const
  {
    ContactNode node = free_node(s);
    node.master      = contact.master;
    node.gap         = contact.reach;
    node.n           = -(s.normals.empty() ? s.normal : s.normals.front());
    return node;
  }

  std::optional<ContactNode>
  NodeToFace::find(const bodies::SurfaceNode &s)
  {
    ContactNode node = free_node(s);
    if (!(contact.obstacle ? face_obstacle(node) : face_master(node, s)))
      return {};
    return node;
  }

  bool
  NodeToFace::face_obstacle(ContactNode &node)
  {
    const auto closest =
      contact.obstacle->shape->closest(node.position, node.spacing);
    node.gap = closest.gap;
    node.n   = closest.normal;
    if (!contact.obstacle->shape->states_gaps())
      judge(node, node.spacing);
    return true;
  }

  bool
  NodeToFace::face_master(ContactNode &node, const bodies::SurfaceNode &s)
  {
    auto normals = s.normals;
    if (surface.two_sided)
      // Members of frames have no outside.
      normals.push_back(-s.normal);
    auto foot = master->foot(s.position,
                             normals,
                             {contact.reach,
                              std::cos(contact.largest_angle),
                              interference_allowed(contact, node.spacing),
                              contact.body != contact.master});
    if (!foot)
      return false;
    // A gap that is written down replaces the distance, not the direction.
    node.gap     = contact.gap ? (*contact.gap)(s.position) : foot->gap;
    node.n       = foot->normal;
    node.master  = contact.master;
    node.masters = std::move(foot->masters);
    if (!contact.gap)
      // Facets of either side may stand inside the other by a part of their
      // size.
      judge(node, std::max(node.spacing, foot->size));
    return true;
  }

  void
  NodeToFace::judge(const ContactNode &node, const double face_size)
  {
    const double bound = interference_allowed(contact, face_size);
    // One message, for the worst node.
    if (node.gap < -bound && (!deepest || node.gap < deepest->gap))
      deepest = {node.position, node.gap, bound};
  }

  PairedNodes
  pair_nodes_with_faces(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures)
  {
    NodeToFace  pairing(contact, structures);
    PairedNodes found;
    for (const bodies::SurfaceNode &s : pairing.slave_surface().nodes)
      {
        if (pairing.is_joined(s.node))
          continue;
        ++found.n_nodes;
        auto node = pairing.find(s);
        if (node)
          ++found.n_paired;
        else if (contact.slides)
          node = pairing.apart(s);
        if (node)
          found.nodes.push_back(std::move(*node));
      }
    found.deepest = pairing.deepest_node();
    return found;
  }
} // namespace conetact::pairing
