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
    /** Weights below this part of the sum are rounding. */
    constexpr double part_rounding = 1e-13;
    /** Part of a mean that must be over the master: weights may cancel. */
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
        gap += weight * foot.gap * (foot.normal * normal);
        cosine += weight * (foot.normal * normal);
      }
    };

    std::vector<std::pair<unsigned int, double>>
    weights_of(const std::map<unsigned int, double> &parts, const double sum)
    {
      std::vector<std::pair<unsigned int, double>> result;
      for (const auto &[node, part] : parts)
        if (std::abs(part) > part_rounding * sum)
          result.emplace_back(node, part / sum);
      return result;
    }

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
                found.nodes.push_back(apart(s, *row->second));
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
          {
            MortarRow &row = rows.at(f, j);
            const auto i   = static_cast<Eigen::Index>(j);
            row.area += parts.areas[i];
            for (std::size_t k = 0; k < face.nodes.size(); ++k)
              row.slaves[face.nodes[k]] +=
                parts.slaves(i, static_cast<Eigen::Index>(k));
          }
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

      ContactNode
      apart(const bodies::SurfaceNode &s, const MortarRow &row) const
      {
        ContactNode node = one_by_one.apart(s);
        node.n           = -row.normal / row.normal.norm();
        return node;
      }

      /** Of a node, on the side of an edge that a row is on. */
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

      std::optional<ContactNode>
      mean(const bodies::SurfaceNode &s, const MortarRow &row)
      {
        const std::optional<MasterSurface::Foot> own = foot(row.node, row);
        if (!own)
          return {};
        MeanOfFeet mean;
        for (const auto &[slave, integral] : row.slaves)
          if (std::abs(integral) > part_rounding * row.area)
            if (const auto &met = foot(slave, row))
              mean.add(slave, *met, integral / row.area, own->normal);
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
        constexpr double least = .5; // at rims that are hardly covered
        ContactNode      node  = one_by_one.free_node(s);
        node.master            = contact.master;
        node.masters           = weights_of(mean.masters, mean.sum);
        node.slaves            = weights_of(mean.slaves, mean.sum);
        node.n                 = own.normal;
        node.mean_cosine = std::clamp(mean.cosine / mean.sum, least, 1 / least);
        // a uniform pressure does the work of the whole area
        node.area = area * mean.sum / node.mean_cosine;
        node.gap  = contact.gap ? node.mean_cosine * prescribed_gap(node) :
                                  mean.gap / mean.sum;
        if (!contact.gap)
          one_by_one.judge(node, std::max(node.spacing, mean.size));
        return node;
      }

      double
      prescribed_gap(const ContactNode &node) const
      {
        double sum = 0;
        for_each_slave(node, [&](const unsigned int i, const double weight) {
          sum += weight * (*contact.gap)(body.position(i));
        });
        return sum;
      }

      const Contact                                      &contact;
      const bodies::Structure                            &body;
      NodeToFace                                          one_by_one;
      FaceNet                                             net;
      MortarRows                                          rows;
      double                                              thickness;
      std::map<unsigned int, const bodies::SurfaceNode *> nodes_of_surface;
      /** By the node and the side of its edge. */
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
