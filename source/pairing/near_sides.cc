// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/near_sides.h"

#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/face_net.h"
#include "conetact/pairing/node_to_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::pairing
{
  namespace
  {
    /**
     * Sides are near up to this part of an edge where the scene says no gap.
     */
    constexpr double near_part = .25;
    /** Gaps are known to this part of an edge. */
    constexpr double gap_rounding = 1e-6;
    /** A side is finer than another one if its edges are shorter by this
     * factor: others are alike, and rounding must not choose between them. */
    constexpr double clearly_finer = .9;

    double
    mean_edge(const bodies::Surface &surface, const bodies::Structure &body)
    {
      double       sum     = 0;
      unsigned int n_edges = 0;
      for (const bodies::SurfaceFace &face : surface.faces)
        for_each_edge(bodies::n_corners(body, face),
                      [&](const std::size_t i, const std::size_t j) {
                        sum += body.position(face.nodes[i])
                                 .distance(body.position(face.nodes[j]));
                        ++n_edges;
                      });
      return n_edges > 0 ? sum / n_edges : 0;
    }

    std::set<unsigned int>
    sharp_nodes(const bodies::Structure &body)
    {
      std::set<unsigned int> nodes;
      const bodies::Surface  whole = body.surface(body.boundary_ids());
      for (const bodies::SurfaceNode &node : whole.nodes)
        if (!whole.two_sided && node.normals.size() > 1)
          nodes.insert(node.node);
      return nodes;
    }

    /**
     * The distance of two boxes along the axis on which they are furthest
     * apart: a bound from below of that of what is in them. It is 0 where they
     * overlap.
     */
    double
    distance(const dealii::BoundingBox<3> &one,
             const dealii::BoundingBox<3> &other)
    {
      double furthest = 0;
      for (unsigned int d = 0; d < 3; ++d)
        furthest = std::max({furthest,
                             one.lower_bound(d) - other.upper_bound(d),
                             other.lower_bound(d) - one.upper_bound(d)});
      return furthest;
    }

    /** Nothing has room between a node and what it meets. */
    bool
    touches(const ContactNode &node)
    {
      return node.gap <= gap_rounding * node.spacing;
    }

    /** Tells whether one of two contacts of a node is in the way of the other:
     * nearer, and in about the same direction. */
    bool
    is_nearer(const ContactNode &one, const ContactNode &other)
    {
      constexpr double alike = .7; // 45 degrees between normals
      return one.node == other.node && !one.meets_nothing() &&
             one.gap < (1 - 1e-6) * other.gap && one.n * other.n > alike;
    }

    /** Tells whether faces at the node look at what is met along n. */
    bool
    looks_at(const bodies::SurfaceNode &node,
             const Tensor<1, 3>        &n,
             const Contact             &law)
    {
      const auto &normals = node.normals;
      return normals.empty() ||
             std::any_of(normals.begin(), normals.end(), [&](const auto &out) {
               return -(out * n) >= std::cos(law.largest_angle);
             });
    }
  } // namespace

  NearSearch::NearSearch(const std::vector<const bodies::Structure *> &s,
                         const std::vector<Obstacle>                  &o,
                         const Contact                                &l,
                         const std::optional<double>                   gap)
    : structures(s)
    , obstacles(o)
    , law(l)
    , largest_gap(gap)
  {
    for (const bodies::Structure *body : structures)
      {
        patches.emplace_back();
        for (const unsigned int id : body->boundary_ids())
          patches.back().push_back(patch_of(*body, id));
        sharp.push_back(sharp_nodes(*body));
        std::vector<Point<3>> places;
        for (unsigned int node = 0; node < body->n_nodes(); ++node)
          places.push_back(body->position(node));
        boxes.emplace_back(places);
      }
  }

  NearSearch::Patch
  NearSearch::patch_of(const bodies::Structure &body, const unsigned int id)
  {
    Patch                 patch{id, body.surface({id}), {}, 0};
    std::vector<Point<3>> places;
    for (const bodies::SurfaceNode &node : patch.surface.nodes)
      places.push_back(node.position);
    patch.box  = Box(places);
    patch.edge = mean_edge(patch.surface, body);
    return patch;
  }

  /** Tells whether a patch is the axis of a body of revolution, where that has
   * no surface. */
  bool
  NearSearch::is_the_axis(const Patch &patch, const bodies::Structure &body)
  {
    return body.is_axisymmetric() &&
           patch.box.upper_bound(0) <= gap_rounding * patch.edge;
  }

  /* What the scene says, or a part of an edge; and the rounding of a gap, so
     that one of just this size is found. */
  double
  NearSearch::gap_allowed(const double edge) const
  {
    return largest_gap.value_or(near_part * edge) + gap_rounding * edge;
  }

  /** The faces of a body that are near the box of another one, patch by patch:
   * bodies that stand deep in each other are near as well. */
  NearSearch::Side
  NearSearch::side_near(const unsigned int body, const unsigned int other) const
  {
    Side side{body, {}};
    for (const Patch &patch : patches[body])
      if (patch.edge > 0 &&
          distance(patch.box, boxes[other]) <= gap_allowed(patch.edge))
        {
          side.ids.insert(patch.id);
          side.edge =
            side.edge > 0 ? std::min(side.edge, patch.edge) : patch.edge;
          side.two_sided = side.two_sided || patch.surface.two_sided;
        }
    return side;
  }

  /** Tells whether a node meets nothing but an edge of its master: blocks that
   * stand corner to corner have no face in common. */
  bool
  NearSearch::meets_an_edge(const ContactNode &node) const
  {
    constexpr double rounding = 1e-6;
    unsigned int     n_met = 0, n_sharp = 0;
    for (const auto &[master, weight] : node.masters)
      if (std::abs(weight) > rounding)
        {
          ++n_met;
          n_sharp += sharp[node.master].count(master) > 0;
        }
    // A point within a face of a continuum has weights of two nodes in the
    // plane, of three or more in space.
    const unsigned int inside = structures[node.master]->n_components();
    return !node.is_mean && n_met < inside && n_sharp == n_met;
  }

  /** Pairs nodes of the slave with the bodies other than the master, which may
   * stand between both. */
  std::vector<ContactNode>
  NearSearch::nodes_on_others(const Contact &trial, const double gap) const
  {
    std::vector<ContactNode> nodes;
    Contact                  other = trial;
    other.pairing                  = "node to face";
    other.reach                    = gap;
    for (other.master = 0; other.master < structures.size(); ++other.master)
      {
        if (other.master == trial.body || other.master == trial.master)
          continue;
        const Side side = side_near(other.master, trial.body);
        if (other.master_ids = side.ids; side.ids.empty())
          continue;
        const PairedNodes found =
          pairing_of(other, structures).pair(other, structures);
        nodes.insert(nodes.end(), found.nodes.begin(), found.nodes.end());
      }
    return nodes;
  }

  /** Tells whether the sides of a trial contact meet: a node touches, or is
   * near while no other body is nearer in that direction. */
  bool
  NearSearch::meet(const Contact &trial, const double gap) const
  {
    PairedNodes found = pairing_of(trial, structures).pair(trial, structures);
    auto       &nodes = found.nodes;
    nodes.erase(std::remove_if(nodes.begin(),
                               nodes.end(),
                               [&](const ContactNode &node) {
                                 return node.meets_nothing() ||
                                        node.gap > gap || meets_an_edge(node);
                               }),
                nodes.end());
    if (std::any_of(nodes.begin(), nodes.end(), &touches))
      return true;
    // Something between the sides hides one from the other.
    const std::vector<ContactNode> others =
      nodes.empty() ? nodes : nodes_on_others(trial, gap);
    return std::any_of(nodes.begin(), nodes.end(), [&](const ContactNode &n) {
      return std::none_of(others.begin(),
                          others.end(),
                          [&](const ContactNode &other) {
                            return is_nearer(other, n);
                          });
    });
  }

  /* The finer side is the slave: each of its nodes has a constraint, and nodes
     of a finer master would come into a coarse slave between its own. A frame
     meets a continuum as the master only. */
  std::optional<NearSides>
  NearSearch::between(const unsigned int one, const unsigned int other) const
  {
    Side slave = side_near(one, other), master = side_near(other, one);
    if (slave.ids.empty() || master.ids.empty())
      return {};
    const double gap = gap_allowed(std::min(slave.edge, master.edge));
    if (slave.two_sided != master.two_sided ?
          slave.two_sided :
          master.edge < clearly_finer * slave.edge)
      std::swap(slave, master);

    Contact trial = law;
    trial.kind    = ContactKind::contact;
    trial.pairing = "mortar";
    trial.body    = slave.body;
    trial.master  = master.body;
    // The second reach is as far as both bodies: it finds sides that stand deep
    // in each other, to be refused with all others, but only where nothing else
    // of the bodies meets.
    const double edge    = std::max(slave.edge, master.edge);
    const auto   meeting = [&]() -> std::optional<NearSides> {
      for (const double reach : {std::max(gap, interference_allowed(law, edge)),
                                 size_of(*structures[one], *structures[other])})
        {
          trial.reach = reach;
          if (auto sides = sides_that_meet(trial, slave.ids, master.ids, gap))
            return sides;
        }
      return {};
    };
    std::optional<NearSides> found = meeting();
    // Faces nearby that meet nothing may be finer than those that do.
    if (found && !slave.two_sided && !master.two_sided &&
        edge_of(found->master, found->master_ids) <
          clearly_finer * edge_of(found->body, found->ids))
      {
        std::swap(slave, master);
        std::swap(trial.body, trial.master);
        if (auto swapped = meeting())
          return swapped;
      }
    return found;
  }

  /** The mean edge of the finest of these patches. */
  double
  NearSearch::edge_of(const unsigned int         body,
                      const bodies::BoundaryIds &ids) const
  {
    double edge = std::numeric_limits<double>::infinity();
    for (const Patch &patch : patches[body])
      if (ids.count(patch.id) > 0)
        edge = std::min(edge, patch.edge);
    return edge;
  }


  /** Leaves of both sides the ids that meet: those of the slave against the
   * whole master, then those of the master against these. */
  std::optional<NearSides>
  NearSearch::sides_that_meet(Contact                    trial,
                              const bodies::BoundaryIds &slaves,
                              const bodies::BoundaryIds &masters,
                              const double               gap) const
  {
    NearSides sides{trial.body, {}, {}, trial.master, {}};
    trial.master_ids = masters;
    for (const unsigned int id : slaves)
      if (trial.ids = {id}; meet(trial, gap))
        sides.ids.insert(id);
    if (sides.ids.empty())
      return {};
    trial.ids = sides.ids;
    for (const unsigned int id : masters)
      if (trial.master_ids = {id}; meet(trial, gap))
        sides.master_ids.insert(id);
    return sides;
  }

  std::optional<NearSides>
  NearSearch::on_obstacle(const unsigned int body,
                          const unsigned int obstacle) const
  {
    const ObstacleShape &shape = *obstacles[obstacle].shape;
    NearSides            sides{body, {}, obstacle, 0, {}};
    if (shape.states_gaps())
      return {};
    for (const Patch &patch : patches[body])
      if (!is_the_axis(patch, *structures[body]) &&
          std::any_of(patch.surface.nodes.begin(),
                      patch.surface.nodes.end(),
                      [&](const bodies::SurfaceNode &node) {
                        const auto met =
                          shape.closest_if_any(node.position, patch.edge);
                        return met && met->gap <= gap_allowed(patch.edge) &&
                               looks_at(node, met->normal, law);
                      }))
        sides.ids.insert(patch.id);
    return sides.ids.empty() ? std::nullopt : std::optional(sides);
  }
} // namespace conetact::pairing
