// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/mesh_notices.h"

#include "conetact/base/joined_warnings.h"
#include "conetact/base/text.h"
#include "conetact/bodies/doubled_nodes.h"
#include "conetact/contact/pieces.h"

#include <algorithm>

namespace conetact::analysis
{
  namespace
  {
    using Pairs = std::vector<std::pair<unsigned int, unsigned int>>;

    std::set<unsigned int>
    nodes_of(const bodies::Structure   &body,
             const bodies::BoundaryIds &one,
             const bodies::BoundaryIds &other)
    {
      std::set<unsigned int> nodes;
      for (const auto *ids : {&one, &other})
        for (const bodies::SurfaceNode &node : body.surface(*ids).nodes)
          nodes.insert(node.node);
      return nodes;
    }

    /** Takes out those that a contact of the body with itself is between. */
    void
    leave_out_contacts(const application::Scene &scene,
                       const unsigned int        body,
                       Pairs                    &doubled)
    {
      const pairing::SlidingContacts contacts = scene.sliding_contacts();
      for (unsigned int c = 0; c < scene.contact_names.size(); ++c)
        {
          const pairing::Contact &contact = contacts.contact(c);
          if (contact.obstacle != nullptr || contact.body != body ||
              contact.master != body)
            continue;
          const auto nodes = nodes_of(*scene.bodies.structures[body],
                                      contact.ids,
                                      contact.master_ids);
          doubled.erase(std::remove_if(doubled.begin(),
                                       doubled.end(),
                                       [&](const auto &pair) {
                                         return nodes.count(pair.first) > 0 &&
                                                nodes.count(pair.second) > 0;
                                       }),
                        doubled.end());
        }
    }
  } // namespace

  void
  say_doubled_nodes(const application::Scene &scene, Log &log)
  {
    std::vector<std::string> sentences;
    for (unsigned int b = 0; b < scene.bodies.n_elastic(); ++b)
      {
        const bodies::Structure &body    = *scene.bodies.structures[b];
        Pairs                    doubled = bodies::doubled_nodes(body);
        if (!doubled.empty())
          leave_out_contacts(scene, b, doubled);
        if (doubled.empty())
          continue;
        const unsigned int n = contact::n_pieces(body);
        sentences.push_back(
          "body '" + scene.bodies.names[b] + "'" +
          (n > 1 ?
             " is of " + std::to_string(n) + " pieces that are not joined" :
             " has nodes that are not joined") +
          "; nodes at " + to_text(body.position(doubled[0].first)) +
          " coincide, " + std::to_string(doubled.size()) +
          (doubled.size() == 1 ? " pair" : " pairs") +
          " in all. Nothing passes between them. Join them by Merge = "
          "1e-6 in Mesh or in the program that wrote the mesh (in Gmsh "
          "by BooleanFragments or Coherence), or put a Contact there.");
      }
    warn(sentences, log);
  }

  void
  say_what_is_not_refined(const application::Scene &scene, Log &log)
  {
    if (scene.adaptive.cycles == 0)
      return;
    for (unsigned int b = 0; b < scene.bodies.n_elastic(); ++b)
      if (const bodies::Structure &body = *scene.bodies.structures[b];
          !body.can_be_refined() && body.elements().count().elements > 0)
        log.say("warning: body '" + scene.bodies.names[b] +
                "': Adaptive refinement leaves triangles and tetrahedra as "
                "they are, and the estimated error does not count theirs. "
                "Use quadrilaterals or hexahedra for it, or Global "
                "refinements.");
  }
} // namespace conetact::analysis
