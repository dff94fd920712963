// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/face_to_node.h"

#include "conetact/base/errors.h"
#include "conetact/pairing/face_net.h"
#include "conetact/pairing/nodal_shapes.h"
#include "conetact/pairing/node_to_face.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {
    /**
     * The point of the faces that a node meets; none where it is out of reach,
     * or beside the faces by more than a little: past the rim the nearest point
     * is not perpendicular.
     */
    std::optional<FaceNet::Closest>
    met_by(const Point<3> &p, const FaceNet &faces, const Contact &contact)
    {
      constexpr double overhang = 1e-2; // of a face

      // The faces are those of the slave: the nearest one is met, and a normal
      // out of it points to the node of the master.
      const FaceNet::Closest at   = faces.nearest(p);
      const FaceNet::Face   &face = faces.all()[at.face];
      const Tensor<1, 3>     arm  = p - at.point;
      const double           gap  = arm * at.normal;
      if ((arm - gap * at.normal).norm() > overhang * face.size ||
          gap > contact.reach)
        return {};
      return at;
    }
  } // namespace

  PairedNodes
  pair_faces_with_nodes(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures)
  {
    NodeToFace             own(contact, structures);
    const bodies::Surface &surface = own.slave_surface();
    const FaceNet          faces(*structures[contact.body], surface);
    PairedNodes            found;
    for (const bodies::SurfaceNode &master :
         structures[contact.master]->surface(contact.master_ids).nodes)
      {
        ++found.n_nodes;
        const auto at = met_by(master.position, faces, contact);
        if (!at)
          continue;
        ++found.n_paired;
        const FaceNet::Face      &face = faces.all()[at->face];
        const std::vector<double> N =
          nodal_shape_values(face.nodes.size(), face.corners.size(), at->at);
        // Hanging nodes of a face are no nodes of the surface.
        const bodies::SurfaceNode *nearest = nullptr;
        double                     most    = 0;
        for (const bodies::SurfaceNode &node : surface.nodes)
          for (std::size_t i = 0; i < N.size(); ++i)
            if (face.nodes[i] == node.node && N[i] > most)
              {
                most    = N[i];
                nearest = &node;
              }
        if (nearest == nullptr)
          throw InputError("Contact '" + contact.name +
                           "': the nodes of its Master body meet a face whose "
                           "nodes all hang. Refine the body there.");
        ContactNode node = own.free_node(*nearest);
        // Normals point from what is met to the body, here into its face.
        node.n       = -at->normal;
        node.master  = contact.master;
        node.masters = {{master.node, 1.}};
        for (std::size_t i = 0; i < N.size(); ++i)
          // Shape functions that vanish at an edge leave rounding.
          if (std::abs(N[i]) > 1e-14)
            node.slaves.emplace_back(face.nodes[i], N[i]);
        node.gap = contact.gap ? (*contact.gap)(master.position) :
                                 (master.position - at->point) * at->normal;
        if (!contact.gap)
          own.judge(node, face.size);
        found.nodes.push_back(std::move(node));
      }
    found.deepest = own.deepest_node();
    return found;
  }
} // namespace conetact::pairing
