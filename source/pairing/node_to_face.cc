// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/node_to_face.h"

#include "conetact/pairing/face_net.h"
#include "conetact/pairing/mortar_rows.h"
#include "conetact/pairing/spacings.h"

#include <algorithm>
#include <cmath>

namespace conetact::pairing
{
  namespace
  {} // namespace

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

  /* The diagonal of the box around both bodies, in undeformed places.
     [length] */
  double
  size_of(const bodies::Structure &one, const bodies::Structure &other)
  {
    Point<3> low = one.position(0), high = low;
    for (const bodies::Structure *body : {&one, &other})
      for (unsigned int node = 0; node < body->n_nodes(); ++node)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], body->position(node)[d]);
            high[d] = std::max(high[d], body->position(node)[d]);
          }
    return low.distance(high);
  }

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
    else if (!contact.couples && FacesOnObstacle::suits(surface))
      on_obstacle.emplace(contact, body, surface);
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
    node.couples  = contact.couples;
    if (!surface.two_sided)
      node.outward = s.normals;
    return node;
  }

  /* A node that meets nothing keeps its row where contacts slide, for it may
     meet something later: with a gap that is as far as the contact reaches. */
  ContactNode
  NodeToFace::apart(const bodies::SurfaceNode &s,
                    const Tensor<1, 3>        &outward) const
  {
    ContactNode node = free_node(s);
    node.master      = contact.master;
    node.gap         = contact.reach;
    node.n           = -outward;
    return node;
  }

  /* A mean over nodes has the mean of the gaps that are written down there. */
  double
  NodeToFace::prescribed_gap(const ContactNode &node) const
  {
    double sum = 0;
    for_each_slave(node, [&](const unsigned int i, const double weight) {
      sum += weight * (*contact.gap)(body.position(i));
    });
    return sum;
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
    if (on_obstacle)
      on_obstacle->place(node);
    else
      {
        const auto closest =
          contact.obstacle->shape->closest(node.position, node.spacing);
        node.gap = closest.gap;
        node.n   = closest.normal;
      }
    if (!contact.obstacle->shape->states_gaps())
      judge(node, node.spacing);
    return true;
  }

  bool
  NodeToFace::face_master(ContactNode &node, const bodies::SurfaceNode &s)
  {
    auto normals = s.normals;
    if (surface.two_sided)
      // Members of frames have no outside: both sides of them look at the
      // master.
      normals.push_back(-s.normal);
    auto found = foot(s, normals);
    if (!found)
      return false;
    // A gap that is written down replaces the distance, not the direction.
    node.gap     = contact.gap ? prescribed_gap(node) : found->gap;
    node.n       = found->normal;
    node.master  = contact.master;
    node.masters = std::move(found->masters);
    if (!contact.gap)
      // Facets of either side may stand inside the other by a part of their
      // size.
      judge(node, std::max(node.spacing, found->size));
    return true;
  }

  std::optional<MasterSurface::Foot>
  NodeToFace::foot(const bodies::SurfaceNode       &s,
                   const std::vector<Tensor<1, 3>> &normals) const
  {
    return master->foot(s.position, normals, limits(spacing.at(s.node)));
  }

  MasterSurface::Limits
  NodeToFace::limits(const double face_size) const
  {
    return {contact.reach,
            std::cos(contact.largest_angle),
            interference_allowed(contact, face_size),
            contact.body != contact.master};
  }

  /* A node may start inside by what facets explain, or by what the scene
     allows; deeper ones are in a wrong place, most likely. */
  void
  NodeToFace::judge(const ContactNode &node, const double face_size)
  {
    const double bound = interference_allowed(contact, face_size);
    // One message, for the worst node.
    if (node.gap < -bound && (!deepest || node.gap < deepest->gap))
      deepest = {node.position, node.gap, bound};
  }

  /**
   * Finds the sides of sharp edges, which are the rows that a mortar surface
   * would have at a node. Where no node has normals of several patches there is
   * none: that is asked first, for it is cheap.
   */
  void
  NodeToFace::find_edges()
  {
    edges.emplace();
    // Patches tell edges of more than their angle without a net of faces.
    const bool no_edges =
      contact.sharp_edge >= bodies::angle_of_patches - 1e-12 &&
      std::none_of(surface.nodes.begin(),
                   surface.nodes.end(),
                   [](const bodies::SurfaceNode &s) {
                     return s.normals.size() > 1;
                   });
    if (!master || surface.two_sided || no_edges)
      return;
    const FaceNet                  net(body, surface);
    const MortarRows               rows(net.all(),
                          contact.sharp_edge,
                          body.is_axisymmetric());
    std::map<unsigned int, double> whole;
    for (const MortarRow &row : rows.all())
      whole[row.node] += row.whole;
    for (const MortarRow &row : rows.all())
      if (row.whole > 0 && row.whole < whole[row.node])
        edges->emplace(row.node,
                       Side{row.normal / row.normal.norm(),
                            row.whole / whole[row.node]});
  }

  std::vector<NodeToFace::Side>
  NodeToFace::sides_of(const unsigned int node)
  {
    if (!edges)
      find_edges();
    std::vector<Side> found;
    const auto [begin, end] = edges->equal_range(node);
    for (auto side = begin; side != end; ++side)
      found.push_back(side->second);
    return found;
  }

  /** Tells whether faces on a side oppose what a row meets, within the Largest
   * angle. */
  bool
  NodeToFace::sees(const Side &side, const ContactNode &row) const
  {
    constexpr double rounding = 1e-12;
    return -(side.outward * row.n) >=
           std::cos(contact.largest_angle) - rounding;
  }

  /**
   * The row of faces on another side of an edge, along another normal than the
   * first row of the node has. Where normals differ by less than a sharp edge
   * there is none, for the first row holds that direction.
   */
  std::optional<ContactNode>
  NodeToFace::find_other(const bodies::SurfaceNode &s,
                         const Side                &side,
                         const ContactNode         &first) const
  {
    // A depth below `rounding` is none; `off` is how far the node is taken
    // beyond its way out of the first face, to be clear of it.
    constexpr double rounding = 1e-6, off = .02; // of a cell
    const auto       foot =
      master->foot(s.position, {side.outward}, limits(first.spacing));
    if (!foot || foot->normal * first.n > std::cos(contact.sharp_edge))
      return {};
    if (foot->gap < -rounding * first.spacing)
      {
        // Behind both faces of a master's own edge it is enough to come out of
        // one, in a corner of the master it is not: there the node is still
        // behind this face when it has come out along the first normal.
        const Point<3> beyond =
          s.position +
          (off * first.spacing - std::min(first.gap, 0.)) * first.n;
        const auto still =
          master->foot(beyond, {side.outward}, limits(first.spacing));
        if (foot->gap < -interference_allowed(contact, first.spacing) ||
            !still || still->gap > -.5 * rounding * first.spacing)
          return {};
      }
    ContactNode node = free_node(s);
    node.outward     = {side.outward};
    node.area        = side.part * s.area;
    node.gap         = contact.gap ? first.gap : foot->gap;
    node.n           = foot->normal;
    node.master      = contact.master;
    node.masters     = foot->masters;
    return node;
  }

  /** A node at a sharp edge has one row for each direction in which its sides
   * are stopped, and the area of its faces is shared among these rows. */
  std::vector<ContactNode>
  NodeToFace::find_sides(const bodies::SurfaceNode &s)
  {
    std::vector<ContactNode> rows;
    auto                     first = find(s);
    const auto               sides = sides_of(s.node);
    if (sides.empty() || contact.kind == ContactKind::tie)
      {
        if (first || contact.slides)
          rows.push_back(
            first ? *first :
                    apart(s, s.normals.empty() ? s.normal : s.normals.front()));
        return rows;
      }
    // The first row is that of the side which looks most against its normal.
    const auto of_first = std::min_element(
      sides.begin(), sides.end(), [&](const Side &a, const Side &b) {
        return first && a.outward * first->n < b.outward * first->n;
      });
    // The first row bears the areas of all sides that it serves: its own side,
    // and those that have no row of their own but look at what it meets.
    double      covered   = 0; // of the area, by the first row
    std::size_t first_row = 0;
    for (auto side = sides.begin(); side != sides.end(); ++side)
      {
        std::optional<ContactNode> row;
        if (first && side == of_first)
          {
            row       = *first;
            first_row = rows.size();
          }
        else if (first)
          row = find_other(s, *side, *first);
        if (first && (side == of_first || !row) && sees(*side, *first))
          covered += side->part;
        if (!row && contact.slides)
          {
            row       = apart(s, side->outward);
            row->area = side->part * s.area;
          }
        if (row)
          rows.push_back(std::move(*row));
      }
    if (covered > 0)
      rows[first_row].area = covered * s.area;
    return rows;
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
        if (pairing.is_joined(s.node) || !pairing.stands(s.node))
          continue;
        ++found.n_nodes;
        bool meets = false;
        for (ContactNode &node : pairing.find_sides(s))
          {
            meets = meets || !node.meets_nothing();
            found.nodes.push_back(std::move(node));
          }
        found.n_paired += meets;
      }
    found.deepest = pairing.deepest_node();
    return found;
  }
} // namespace conetact::pairing
