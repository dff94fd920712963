// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/worn_sides.h"

#include "conetact/bodies/face_nodes.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;

    /** With wear, be it 0: what has no layer at all has no depths. */
    bool
    wears_on_master(const pairing::Contact &contact)
    {
      return contact.kind == pairing::ContactKind::contact &&
             contact.obstacle == nullptr && contact.layer &&
             contact.layer->wears();
    }

    bool
    wears_master(const pairing::Contact &contact)
    {
      return wears_on_master(contact) && contact.layer->share_of_slave() < 1;
    }

    /** Integrals of the functions that contacts have on a surface: where these
     * are the linear ones of corners, corners have what is between them. */
    std::map<unsigned int, double>
    areas_of(const bodies::Structure &body, const bodies::Surface &surface)
    {
      std::map<unsigned int, double> areas;
      for (const bodies::SurfaceNode &node : surface.nodes)
        areas[node.node] = node.area;
      for (const bodies::SurfaceFace &face : surface.faces)
        if (face.meets_at_corners)
          for (const bodies::HangingNode &middle :
               bodies::middle_nodes(body, face))
            {
              for (const auto &[corner, weight] : middle.masters)
                areas[corner] += weight * areas[middle.node];
              areas[middle.node] = 0;
            }
      return areas;
    }

    /** Boundary ids of a body that wear as one surface. */
    struct WornSurface
    {
      unsigned int        body;
      bodies::BoundaryIds ids;

      bool
      meets(const pairing::Contact &contact) const
      {
        return contact.master == body &&
               std::any_of(contact.master_ids.begin(),
                           contact.master_ids.end(),
                           [&](const unsigned int id) {
                             return ids.count(id) > 0;
                           });
      }
    };

    /** What wears, in one for all contacts that have ids in common. */
    std::vector<WornSurface>
    worn_surfaces(const std::vector<pairing::Contact> &contacts)
    {
      std::vector<WornSurface> surfaces;
      for (const pairing::Contact &contact : contacts)
        if (wears_master(contact))
          {
            WornSurface united{contact.master, contact.master_ids};
            const auto  apart = std::partition(surfaces.begin(),
                                              surfaces.end(),
                                              [&](const WornSurface &of) {
                                                return !of.meets(contact);
                                              });
            for (auto other = apart; other != surfaces.end(); ++other)
              united.ids.insert(other->ids.begin(), other->ids.end());
            surfaces.erase(apart, surfaces.end());
            surfaces.push_back(std::move(united));
          }
      return surfaces;
    }
  } // namespace

  WornSides::WornSides(const std::vector<pairing::Contact>          &contacts,
                       const std::vector<const bodies::Structure *> &structures)
    : sides(contacts.size())
    , wearing(contacts.size(), false)
  {
    for (const WornSurface &surface : worn_surfaces(contacts))
      {
        const auto numbers =
          add_surface(surface.body, *structures[surface.body], surface.ids);
        for (std::size_t c = 0; c < contacts.size() && numbers; ++c)
          if (wears_on_master(contacts[c]) && surface.meets(contacts[c]))
            {
              sides[c]   = numbers;
              wearing[c] = wears_master(contacts[c]);
            }
      }
  }

  /* Nodes of frames have no surface that a volume could be taken from. */
  std::shared_ptr<const WornSides::Numbers>
  WornSides::add_surface(const unsigned int         body,
                         const bodies::Structure   &structure,
                         const bodies::BoundaryIds &ids)
  {
    const bodies::Surface surface = structure.surface(ids);
    if (surface.faces.empty() || surface.two_sided)
      return {};
    const auto numbers = std::make_shared<Numbers>();
    for (const auto &[node, area] : areas_of(structure, surface))
      if (area > 0)
        {
          numbers->emplace(node, n_nodes());
          nodes.push_back({body, node, area});
        }
    return numbers;
  }

  double
  WornSides::depth(const unsigned int     contact,
                   const unsigned int     master,
                   const Eigen::VectorXd &depths) const
  {
    const Numbers *const numbers = numbers_of(contact);
    if (numbers == nullptr)
      return 0;
    const auto found = numbers->find(master);
    return found == numbers->end() ? 0. : depths[found->second];
  }

  /* Opponents that a common turn has moved have weights in the cells behind the
     face as well: what is on the surface counts for all. */
  std::vector<std::pair<Eigen::Index, double>>
  WornSides::on_surface(const pairing::ContactNode &node) const
  {
    std::vector<std::pair<Eigen::Index, double>> weights;
    const Numbers *const numbers = numbers_of(node.contact);
    if (numbers == nullptr)
      return weights;
    double sum = 0;
    for (const auto &[master, weight] : node.masters)
      if (const auto found = numbers->find(master); found != numbers->end())
        {
          weights.emplace_back(found->second, weight);
          sum += weight;
        }
    for (auto &[number, weight] : weights)
      weight /= sum;
    return weights;
  }

  double
  WornSides::faced(const pairing::ContactNode &node,
                   const Eigen::VectorXd      &depths) const
  {
    AssertDimension(depths.size(), n_nodes());
    double sum = 0;
    for (const auto &[number, weight] : on_surface(node))
      sum += weight * depths[number];
    return sum;
  }

  void
  WornSides::take(const pairing::ContactNode &node,
                  const double                volume,
                  Eigen::VectorXd            &depths) const
  {
    AssertDimension(depths.size(), n_nodes());
    for (const auto &[number, weight] : on_surface(node))
      depths[number] += weight * volume / (*this)[number].area;
  }
} // namespace conetact::contact
