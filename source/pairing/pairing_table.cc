// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/corners_to_faces.h"
#include "conetact/pairing/face_to_node.h"
#include "conetact/pairing/mortar.h"
#include "conetact/pairing/node_to_face.h"
#include "conetact/pairing/pair_spring.h"

#include <algorithm>

namespace conetact::pairing
{
  namespace
  {
    PairedNodes
    pair_one_by_one(const Contact                                &contact,
                    const std::vector<const bodies::Structure *> &structures)
    {
      const bodies::Structure &body = *structures[contact.body];
      return contact.obstacle == nullptr && body.meets_at_corners() &&
                 FacesOnObstacle::suits(body.surface(contact.ids)) ?
               pair_corners_with_faces(contact, structures) :
               pair_nodes_with_faces(contact, structures);
    }
  } // namespace

  const std::vector<PairingRow> &
  pairings()
  {
    static const std::vector<PairingRow> rows = {
      {"node to face",
       "each node meets the point of the master's faces that is nearest",
       pair_one_by_one,
       false},
      {"mortar",
       "each node meets the mean of the master's faces around it, weighted by "
       "its dual function, so that a constant pressure passes between any two "
       "meshes",
       pair_by_mortar,
       true}};
    return rows;
  }

  /* Mortar needs faces on both sides: frames, obstacles and single nodes are
     met node by node, whatever is asked for. */
  const PairingRow &
  pairing_of(const Contact                                &contact,
             const std::vector<const bodies::Structure *> &structures)
  {
    static const PairingRow nodes  = {"face to node",
                                      "the master's nodes meet faces",
                                      pair_faces_with_nodes,
                                      false};
    static const PairingRow points = {"points",
                                      "a spring joins two points",
                                      pair_spring,
                                      false};
    if (contact.spring)
      return points;
    if (has_nodes_as_masters(contact, structures))
      return nodes;
    const auto has_faces = [&](const unsigned int         body,
                               const bodies::BoundaryIds &ids) {
      const bodies::Surface surface = structures[body]->surface(ids);
      return !surface.two_sided && !surface.faces.empty();
    };
    const bool faces = contact.pairing != "node to face" &&
                       contact.obstacle == nullptr &&
                       has_faces(contact.body, contact.ids) &&
                       has_faces(contact.master, contact.master_ids);
    const std::string name = faces ? contact.pairing : "node to face";
    return *std::find_if(pairings().begin(),
                         pairings().end(),
                         [&](const PairingRow &row) {
                           return row.name == name;
                         });
  }
} // namespace conetact::pairing
