// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/corners_to_faces.h"

#include "conetact/pairing/corner_parts.h"
#include "conetact/pairing/mortar_rows.h"
#include "conetact/pairing/node_to_face.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace conetact::pairing
{
  namespace
  {
    /** The part of a mean that must be over the master: weights change their
     * sign, and a mean over a sum near 0 reaches far. */
    constexpr double least_part = .1;

    /** The pairs of nodes and feet that a corner is the mean of. */
    struct MeanOfFeet
    {
      std::map<unsigned int, double> slaves, masters; ///< not yet over the sum
      double                         sum = 0, size = 0, gap = 0, cosine = 0;

      void
      add(const unsigned int         node,
          const MasterSurface::Foot &foot,
          const double               weight,
          const Tensor<1, 3>        &normal)
      {
        slaves[node] += weight;
        for (const auto &[master, part] : foot.masters)
          masters[master] += weight * part;
        sum += weight;
        size = std::max(size, foot.size);
        // The vector from a foot to its node is gap times its own normal; the
        // mean sees its part along the normal at the corner.
        gap += weight * foot.gap * (foot.normal * normal);
        cosine += weight * (foot.normal * normal);
      }
    };

    class CornersToFaces
    {
    public:
      CornersToFaces(const Contact                                &c,
                     const std::vector<const bodies::Structure *> &s)
        : contact(c)
        , body(*s[contact.body])
        , one_by_one(contact, s)
        , net(body, one_by_one.slave_surface())
        , rows(net.all(), contact.sharp_edge)
        , thickness(thickness_of(one_by_one.slave_surface(), net.all(), false))
      {
        for (const bodies::SurfaceNode &node : one_by_one.slave_surface().nodes)
          nodes_of_surface[node.node] = &node;
        for (std::size_t f = 0; f < net.all().size(); ++f)
          add(f);
        rows.give_up(body.hanging_nodes());
      }

      PairedNodes
      nodes()
      {
        std::multimap<unsigned int, const MortarRow *> rows_of;
        for (const MortarRow &row : rows.all())
          if (row.area > 0)
            rows_of.emplace(row.node, &row);
        PairedNodes found;
        for (const bodies::SurfaceNode &s : one_by_one.slave_surface().nodes)
          {
            const auto [begin, end] = rows_of.equal_range(s.node);
            if (one_by_one.is_joined(s.node) || begin == end)
              continue;
            const std::size_t before = found.nodes.size();
            bool              meets  = false;
            for (auto row = begin; row != end; ++row)
              if (auto node = mean(s, *row->second))
                {
                  meets = true;
                  found.nodes.push_back(std::move(*node));
                }
              else if (contact.slides)
                found.nodes.push_back(one_by_one.apart(
                  s, row->second->normal / row->second->normal.norm()));
            if (!meets)
              meets = take_edge(s, before, found.nodes);
            ++found.n_nodes;
            found.n_paired += meets;
          }
        found.deepest = one_by_one.deepest_node();
        return found;
      }

    private:
      void
      add(const std::size_t f)
      {
        const FaceNet::Face &face  = net.all()[f];
        const CornerParts    parts = corner_parts(face);
        rows.join(f);
        for (std::size_t j = 0; j < face.n_functions; ++j)
          parts.add(face, j, rows.at(f, j));
      }

      /** An edge or a corner that meets a face along no normal of its own
       * faces; as many rows wherever it slides. */
      bool
      take_edge(const bodies::SurfaceNode &s,
                const std::size_t          before,
                std::vector<ContactNode>  &all)
      {
        auto edge = one_by_one.find(s);
        if (!edge)
          return false;
        if (contact.slides)
          all[before] = std::move(*edge);
        else
          all.push_back(std::move(*edge));
        return true;
      }

      /** The foot of a node along the normal on that side of its edge that a
       * row is on. Rows around share it. */
      const std::optional<MasterSurface::Foot> &
      foot(const unsigned int node, const MortarRow &row)
      {
        const bodies::SurfaceNode &s    = *nodes_of_surface.at(node);
        const auto                 side = static_cast<std::size_t>(
          std::max_element(s.normals.begin(),
                           s.normals.end(),
                           [&](const Tensor<1, 3> &a, const Tensor<1, 3> &b) {
                             return a * row.normal < b * row.normal;
                           }) -
          s.normals.begin());
        const auto [at, is_new] = feet.try_emplace({node, side});
        if (is_new && !one_by_one.is_joined(node))
          at->second = one_by_one.foot(s, {s.normals[side]});
        return at->second;
      }

      /** The mean of the pairs around a corner; none where the corner itself is
       * beside the master, or too little of the mean is over it. */
      std::optional<ContactNode>
      mean(const bodies::SurfaceNode &s, const MortarRow &row)
      {
        const std::optional<MasterSurface::Foot> own = foot(row.node, row);
        // Normal and foot are those of the corner itself. Beside the master
        // there is none, whatever nodes around it meet.
        if (!own)
          return {};
        MeanOfFeet mean;
        for (const auto &[slave, weight] : weights_of(row.slaves, row.area))
          if (const auto &met = foot(slave, row))
            mean.add(slave, *met, weight, own->normal);
        if (mean.sum < least_part)
          return {};
        return with(mean, s, thickness * row.area, *own);
      }

      ContactNode
      with(const MeanOfFeet          &mean,
           const bodies::SurfaceNode &s,
           const double               area,
           const MasterSurface::Foot &own)
      {
        ContactNode node = one_by_one.free_node(s);
        node.master      = contact.master;
        // Nodes beside the master are left out: weights are parts of the sum of
        // those that have a foot.
        node.masters     = weights_of(mean.masters, mean.sum);
        node.slaves      = weights_of(mean.slaves, mean.sum);
        node.n           = own.normal;
        node.mean_cosine = bounded_cosine(mean.cosine / mean.sum);
        // A uniform pressure does the work of the area that is over the master.
        node.area = area * mean.sum / node.mean_cosine;
        node.gap  = contact.gap ?
                      node.mean_cosine * one_by_one.prescribed_gap(node) :
                      mean.gap / mean.sum;
        if (!contact.gap)
          one_by_one.judge(node, std::max(node.spacing, mean.size));
        return node;
      }

      const Contact                                      &contact;
      const bodies::Structure                            &body;
      NodeToFace                                          one_by_one;
      FaceNet                                             net;
      MortarRows                                          rows;
      double                                              thickness;
      std::map<unsigned int, const bodies::SurfaceNode *> nodes_of_surface;
      /** Feet are numbered by their node and the side of its edge. */
      std::map<std::pair<unsigned int, std::size_t>,
               std::optional<MasterSurface::Foot>>
        feet;
    };
  } // namespace

  PairedNodes
  pair_corners_with_faces(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures)
  {
    return CornersToFaces(contact, structures).nodes();
  }
} // namespace conetact::pairing
