// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/wear.h"

#include <deal.II/base/exceptions.h>

#include <utility>

namespace conetact::contact
{
  using Eigen::Index;
  using Eigen::VectorXd;

  Wear::Wear(const Index n)
    : all(VectorXd::Zero(n))
    , volumes(all)
    , opening(all)
  {}

  void
  Wear::set_sides(std::shared_ptr<const WornSides> of_masters)
  {
    if (of_masters->n_nodes() == 0)
      return;
    masters         = std::move(of_masters);
    depths_of_sides = VectorXd::Zero(masters->n_nodes());
  }

  double
  Wear::own_part(const pairing::ContactNode &node) const
  {
    return masters && masters->keeps(node.contact) ?
             node.layer->share_of_slave() :
             1.;
  }

  void
  Wear::stand(const ContactPoints &points)
  {
    if (!masters)
      {
        opening = all;
        return;
      }
    AssertDimension(all.size(), static_cast<Index>(points.size()));
    for (Index i = 0; i < all.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        opening[i] =
          own_part(node) * all[i] + masters->faced(node, depths_of_sides);
      }
  }

  /* Candidates one after the other, in the same order in all processes. */
  void
  Wear::add(const ContactPoints &points,
            const VectorXd      &depths,
            const VectorXd      &areas)
  {
    AssertDimension(depths.size(), all.size());
    AssertDimension(areas.size(), all.size());
    all += depths;
    volumes += depths.cwiseProduct(areas);
    for (Index i = 0; masters && i < all.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        if (const double other = 1 - own_part(node); other > 0 && depths[i] > 0)
          masters->take(node, other * depths[i] * areas[i], depths_of_sides);
      }
    stand(points);
  }

  void
  Wear::take(const Wear &other, const ContactPoints &points)
  {
    *this = other;
    stand(points);
  }

  void
  Wear::add_difference(const VectorXd      &more,
                       const VectorXd      &more_of_sides,
                       const ContactPoints &points)
  {
    all += more;
    if (more_of_sides.size() == depths_of_sides.size())
      depths_of_sides += more_of_sides;
    stand(points);
  }

  void
  Wear::save(Archive &archive) const
  {
    archive.put("contact/worn", all);
    archive.put("contact/removed", volumes);
    archive.put("contact/receded", opening);
    archive.put("contact/sides", depths_of_sides);
  }

  void
  Wear::restore(const Archive &archive, const ContactPoints &points)
  {
    archive.fill("contact/worn", all);
    archive.fill("contact/removed", volumes);
    archive.fill("contact/sides", depths_of_sides);
    stand(points);
  }
} // namespace conetact::contact
