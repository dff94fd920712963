// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/sliding.h"

#include "conetact/bodies/displaced.h"
#include "conetact/bodies/rigid_body.h"
#include "conetact/pairing/face_net.h"
#include "conetact/pairing/found_nodes.h"
#include "conetact/pairing/mortar.h"
#include "conetact/pairing/shared_areas.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>

namespace conetact::pairing
{
  namespace
  {
    /** Gaps above so many spacings of nodes are as good as any other. */
    constexpr double far_away = 1e4;
    /** How exactly gaps of open nodes are to be known beside those of closed
     * ones. */
    constexpr double open_gaps = 1e-6;

    /** v turned by the least turn of the unit vector a into b (Rodrigues). */
    Tensor<1, 3>
    turned(const Tensor<1, 3> &v, const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      const Tensor<1, 3> axis = cross_product_3d(a, b);
      const Tensor<1, 3> once = cross_product_3d(axis, v);
      return v + once + cross_product_3d(axis, once) / (1 + a * b);
    }

    /**
     * Gives the node another normal. Its tangents turn with it from where they
     * were at the start, so that neither friction nor components of reactions
     * jump.
     */
    void
    turn(const ContactNode  &start,
         const Tensor<1, 3> &normal,
         const unsigned int  dim,
         ContactNode        &node)
    {
      constexpr double opposite = 1e-6;
      if ((normal - start.n).norm_square() == 0)
        {
          node.n      = start.n;
          node.t1     = start.t1;
          node.t2     = start.t2;
          node.axis_1 = start.axis_1;
          node.axis_2 = start.axis_2;
          return;
        }
      if (dim == 2 || 1 + normal * start.n < opposite)
        {
          set_frame(node, normal, dim);
          return;
        }
      node.n      = normal;
      node.t1     = turned(start.t1, start.n, normal);
      node.t2     = cross_product_3d(normal, node.t1);
      node.axis_1 = turned(start.axis_1, start.n, normal);
      node.axis_2 = cross_product_3d(normal, node.axis_1);
    }

    using Displacement = SlidingContacts::Displacement;
    using Met          = FacesOnObstacle::Met;

    std::optional<Met>
    met_by_node(const ContactNode &node, const Tensor<1, 3> &own)
    {
      const auto closest =
        node.obstacle->shape->closest_after(node.position, own, node.spacing);
      if (!closest)
        return {};
      return Met{closest->gap,
                 closest->normal,
                 node.position + own - closest->gap * closest->normal};
    }

    /** The faces that a node is a mean over, if it is one, displaced. */
    struct FacesAt
    {
      const FacesOnObstacle        *all;
      FacesOnObstacle::Displacement displacement;
    };

    /**
     * Takes the gap and the normal where it is now, moved by u in space and by
     * `last` relative to the point that it met last. Returns the point that it
     * meets now, where that stood at the start.
     */
    Point<3>
    meet_obstacle(const RigidMotion  &motion,
                  const Tensor<1, 3> &u,
                  const Tensor<1, 3> &last,
                  const FacesAt      &faces,
                  ContactNode        &node)
    {
      const Tensor<1, 3> own = motion.relative(node.position, u);
      const double       gap = node.gap + node.n * last;
      const Tensor<1, 3> n   = motion.direction_to_own(node.n);
      // The last one stays where there is no normal, as deep inside.
      const Met last_one{gap, n, node.position + own - gap * n};
      const Met met = (faces.all == nullptr ?
                         met_by_node(node, own) :
                         faces.all->meet(node, motion, faces.displacement))
                        .value_or(last_one);
      node.n   = motion.direction_to_space(met.normal);
      node.gap = std::min(met.gap, far_away * node.spacing);
      return met.foot;
    }

    /** The motion of the rigid body behind a free obstacle, from those of the
     * nodes that span it. */
    RigidMotion
    motion_of(const bodies::RigidBody             &body,
              const unsigned int                   number,
              const unsigned int                   dim,
              const SlidingContacts::Displacement &at)
    {
      const Tensor<1, 3> d = at(number, 0);
      // The slope is du_row / dx_column, along an axis to a spanning node.
      const auto slope = [&](const unsigned int row,
                             const unsigned int column) {
        const unsigned int node = body.spanning_node(column);
        return (at(number, node) - d)[row] /
               (body.position(node) - body.position(0))[column];
      };
      Tensor<1, 3> turn;
      turn[2] = slope(1, 0);
      if (dim == 3)
        {
          turn[0] = slope(2, 1);
          turn[1] = slope(0, 2);
        }
      return RigidMotion::turned(d, turn, body.position(0));
    }

    /** An obstacle that is prescribed, or one that is free. */
    void
    find_on_obstacle(const std::vector<const bodies::Structure *> &structures,
                     const SlidingContacts::Displacement          &at,
                     const double                                  t,
                     const unsigned int                            dim,
                     const FacesOnObstacle                        *of_node,
                     ContactNode                                  &node)
    {
      const FacesAt      faces{of_node, [&](const unsigned int i) {
                            return at(node.body, i);
                          }};
      const Tensor<1, 3> u = own_displacement(node, faces.displacement);
      if (node.masters.empty())
        {
          const RigidMotion motion = node.obstacle->motion_at(t);
          const Point<3>    met    = meet_obstacle(
            motion, u, u - obstacle_displacement(node, t), faces, node);
          node.moved = u - motion.displacement(met);
          return;
        }
      const auto &body =
        dynamic_cast<const bodies::RigidBody &>(*structures[node.master]);
      const auto moved = [&]() {
        Tensor<1, 3> sum = u;
        for (const auto &[master, weight] : node.masters)
          sum -= weight * at(node.master, master);
        return sum;
      };
      const RigidMotion motion = motion_of(body, node.master, dim, at);
      const Point<3>    met    = meet_obstacle(motion, u, moved(), faces, node);
      // The lever of forces has turned with it: so have the ways that the next
      // bit of a turn leads.
      node.masters = body.weights_of(motion.to_space(met) - motion.translation);
      node.moved   = moved();
    }

    bool
    is_pair_that_slides(const Contact &contact)
    {
      return contact.slides && contact.obstacle == nullptr;
    }

    /** Gives a node of a pair of bodies what it meets now. */
    void
    take(const ContactNode                   &now,
         const SlidingContacts::Displacement &at,
         ContactNode                         &node)
    {
      node.n       = now.n;
      node.gap     = now.gap;
      node.area    = now.area;
      node.masters = now.masters;
      node.slaves  = now.slaves;
      node.moved   = Tensor<1, 3>();
      for_each_side(node,
                    [&](const unsigned int body,
                        const unsigned int i,
                        const double       weight) {
                      node.moved += weight * at(body, i);
                    });
    }

    std::vector<Tensor<1, 3>>
    displacements(const bodies::Structure             &body,
                  const unsigned int                   number,
                  const SlidingContacts::Displacement &at)
    {
      std::vector<Tensor<1, 3>> u;
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        u.push_back(at(number, i));
      return u;
    }

    /** Sum of the differences of the weights that two nodes give to others. */
    double
    difference(const ContactNode &one, const ContactNode &other)
    {
      std::map<std::pair<unsigned int, unsigned int>, double> sum;
      const auto add = [&](const ContactNode &node, const double sign) {
        for_each_side(node,
                      [&](const unsigned int body,
                          const unsigned int i,
                          const double       weight) {
                        sum[{body, i}] += sign * weight;
                      });
      };
      add(one, 1);
      add(other, -1);
      double total = 0;
      for (const auto &[node, weight] : sum)
        total += std::abs(weight);
      return total;
    }
  } // namespace

  SlidingContacts::SlidingContacts(const std::vector<Contact>     &c,
                                   const Structures               &s,
                                   const std::vector<ContactNode> &at_start,
                                   const unsigned int              d)
    : contacts(c)
    , structures(s)
    , start(at_start)
    , shared(contacts, structures, start)
    , dim(d)
  {
    for (unsigned int i = 0; i < contacts.size(); ++i)
      {
        const Contact           &contact = contacts[i];
        const bodies::Structure &body    = *structures[contact.body];
        if (!contact.slides || contact.obstacle == nullptr ||
            !body.meets_at_corners())
          continue;
        const bodies::Surface surface = body.surface(contact.ids);
        if (FacesOnObstacle::suits(surface))
          on_obstacles.emplace(std::piecewise_construct,
                               std::forward_as_tuple(i),
                               std::forward_as_tuple(contact, body, surface));
      }
  }

  bool
  SlidingContacts::empty() const
  {
    return std::none_of(contacts.begin(),
                        contacts.end(),
                        [](const Contact &contact) { return contact.slides; });
  }

  SlidingContacts::Found
  SlidingContacts::find(const std::vector<ContactNode> &last,
                        const Displacement             &at,
                        const double                    t,
                        const bool                      keep_faced) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Found found{last};
    for (ContactNode &node : found.nodes)
      if (node.slides && node.obstacle != nullptr)
        node = find_on_obstacle(std::move(node), at, t);
    if (std::any_of(contacts.begin(), contacts.end(), is_pair_that_slides))
      found.why_not = find_pairs(at, keep_faced, found.nodes);
    return found;
  }

  ContactNode
  SlidingContacts::find_on_obstacle(ContactNode         node,
                                    const Displacement &at,
                                    const double        t) const
  {
    const auto faces = on_obstacles.find(node.contact);
    pairing::find_on_obstacle(structures,
                              at,
                              t,
                              dim,
                              faces == on_obstacles.end() ||
                                  node.slaves.empty() ?
                                nullptr :
                                &faces->second,
                              node);
    return node;
  }

  std::string
  SlidingContacts::find_pairs(const Displacement       &at,
                              const bool                keep_faced,
                              std::vector<ContactNode> &nodes) const
  {
    std::vector<bodies::Displaced> displaced;
    Structures                     there;
    for (unsigned int b = 0; b < structures.size(); ++b)
      displaced.emplace_back(*structures[b],
                             displacements(*structures[b], b, at));
    for (const bodies::Displaced &body : displaced)
      there.push_back(&body);
    std::vector<std::optional<ContactNode>> found(nodes.size());
    for (unsigned int c = 0; c < contacts.size(); ++c)
      if (is_pair_that_slides(contacts[c]))
        if (std::string why = find_pair(c, there, keep_faced, nodes, found);
            !why.empty())
          return why;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (found[i])
        take(*found[i], at, nodes[i]);
    share_areas(contacts, there, /*only_sliding=*/true, nodes);
    return {};
  }

  std::string
  SlidingContacts::find_pair(
    const unsigned int                       c,
    const Structures                        &displaced,
    const bool                               keep_faced,
    const std::vector<ContactNode>          &nodes,
    std::vector<std::optional<ContactNode>> &found) const
  {
    const Contact         &contact = contacts[c];
    const PairingRow      &row     = pairing_of(contact, displaced);
    std::set<unsigned int> faced;
    for (const std::size_t i : shared.of(c))
      if (keep_faced && !nodes[i].meets_nothing())
        faced.insert(nodes[i].node);
    PairedNodes paired = row.takes_means ?
                           pair_by_mortar(contact, displaced, faced) :
                           row.pair(contact, displaced);
    auto        now    = paired.nodes.begin();
    for (const std::size_t i : shared.of(c))
      {
        if (now == paired.nodes.end() || now->node != nodes[i].node)
          return why_not_found(contact, structures, displaced);
        if (found[i])
          unite_places(*found[i], *now, dim);
        else
          found[i] = std::move(*now);
        ++now;
      }
    return {};
  }

  std::vector<SlidingContacts::PairPassage>
  SlidingContacts::passages(const std::vector<BodyWay> &ways,
                            Entries                    &inside) const
  {
    std::vector<PairPassage> found;
    const auto               look = [&](const unsigned int         c,
                          const unsigned int         body,
                          const bodies::BoundaryIds &ids,
                          const unsigned int         other,
                          const bodies::BoundaryIds &entries) {
      const MovingBoundary boundary(*structures[other], ways[other], entries);
      const bool           is_slave = body == contacts[c].body;
      for (const bodies::SurfaceNode &node :
           structures[body]->surface(ids).nodes)
        {
          const std::array<unsigned int, 3> key = {{c, body, node.node}};
          const auto                        then = inside.find(key);
          std::optional<unsigned int>       by;
          if (then != inside.end())
            by = then->second;
          for (const Passage &passage :
               boundary.passages(ways[body], node.node, by))
            found.push_back({passage,
                             is_slave ? shared.owner(c, node.node) : c,
                             body,
                             node.node,
                             other,
                             is_slave});
          inside.erase(key);
          if (by)
            inside[key] = *by;
        }
    };
    for (unsigned int c = 0; c < contacts.size(); ++c)
      if (const Contact &pair = contacts[c]; is_pair_that_slides(pair))
        {
          look(c, pair.body, pair.ids, pair.master, pair.master_ids);
          look(c, pair.master, pair.master_ids, pair.body, pair.ids);
        }
    return found;
  }

  SlidingContacts::DepthOfMasters
  SlidingContacts::master_in_slave(const Displacement &at,
                                   const double        depth) const
  {
    DepthOfMasters all{{}, std::numeric_limits<double>::max()};
    for (unsigned int c = 0; c < contacts.size() && !all.deep; ++c)
      if (const Contact &contact = contacts[c];
          contact.obstacle == nullptr && !contact.gap &&
          contact.kind == ContactKind::contact &&
          contact.body != contact.master)
        {
          const DepthOfMasters found = master_in_slave(c, at, depth);
          all = {found.deep, std::min(all.clearance, found.clearance)};
        }
    return all;
  }

  SlidingContacts::DepthOfMasters
  SlidingContacts::master_in_slave(const unsigned int  c,
                                   const Displacement &at,
                                   const double        depth) const
  {
    const Contact          &contact = contacts[c];
    DepthOfMasters          found{{}, std::numeric_limits<double>::max()};
    const bodies::Displaced slave(*structures[contact.body],
                                  displacements(*structures[contact.body],
                                                contact.body,
                                                at));
    const bodies::Surface   met = slave.surface(contact.ids);
    if (met.two_sided || met.faces.empty())
      return found;
    const FaceNet            faces(slave, met);
    std::unique_ptr<FaceNet> boundary; // made if it is needed
    double                   smallest = faces.all()[0].size;
    for (const FaceNet::Face &face : faces.all())
      smallest = std::min(smallest, face.size);
    for (const bodies::SurfaceNode &node :
         structures[contact.master]->surface(contact.master_ids).nodes)
      {
        const Point<3>   p = node.position + at(contact.master, node.node);
        FaceNet::Closest closest = faces.nearest(p);
        const double     height  = (p - closest.point) * closest.normal;
        double           side    = height < 0 ? -1 : 1;
        if (height < -depth * faces.all()[closest.face].size)
          {
            if (!boundary)
              boundary =
                std::make_unique<FaceNet>(slave,
                                          slave.surface(slave.boundary_ids()));
            const double inside = boundary->depth(p);
            if (inside > depth)
              return {DeepNode{c, node.node, inside}, 0};
            side    = inside > 0 ? -1 : 1;
            closest = boundary->nearest(p);
          }
        found.clearance =
          std::min(found.clearance, depth * smallest + side * closest.distance);
      }
    return found;
  }

  void
  SlidingContacts::linearise(std::vector<ContactNode> &nodes) const
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (ContactNode &node = nodes[i]; node.slides)
        {
          turn(start[i], Tensor<1, 3>(node.n), dim, node);
          node.gap -= node.n * node.moved;
        }
  }

  FoundChange
  change_of(const ContactNode  &solved,
            const ContactNode  &found,
            const Tensor<1, 3> &u,
            const double        gap,
            const double        share)
  {
    const double spacing = found.spacing, actual = found.gap + found.n * u;
    const double missed =
      std::abs(actual - gap) / std::max(spacing, std::abs(actual));
    const double touching = solved.layer || solved.active ? gap : 0;
    if (const double depth = std::min(touching, 0.) - actual; share == 0)
      return {std::max(depth / spacing, open_gaps * missed), 0}; // open
    return {std::abs(actual - touching) / spacing,
            share *
              std::max((found.n - solved.n).norm(), difference(solved, found))};
  }
} // namespace conetact::pairing
