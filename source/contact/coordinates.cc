// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/coordinates.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Of each body, whether its motion opens a tie. */
    std::vector<bool>
    open_cuts(const model::Bodies &bodies)
    {
      std::vector<bool> open(bodies.structures.size(), false);
      for (const model::Cut &cut : bodies.cuts)
        open[cut.body] = !cut.opening;
      return open;
    }
  } // namespace

  Coordinates::Coordinates(const model::Bodies &b,
                           const NodeRules     &r,
                           const ContactPoints *p,
                           const double         a)
    : NodalVectors(b)
    , node_rules(r)
    , points(p)
    , axes(p != nullptr ? ContactAxes(*p) : ContactAxes())
    , arm(a)
    , opens(p != nullptr ? open_cuts(b) :
                           std::vector<bool>(b.structures.size(), false))
    , specials(n_nodes())
  {
    for (const NodeRule &rule : node_rules.rules())
      specials.make(number(rule.body, rule.node)).rule = &rule;
    if (points != nullptr)
      {
        if (std::any_of(points->all().begin(),
                        points->all().end(),
                        [](const ContactPoint &point) {
                          return !point.node->slaves.empty();
                        }))
          means.emplace(bodies, node_rules, *points);
        for (const auto &[point, first] : axes.own())
          take(*point);
        for (std::size_t i = points->size(); i < points->all().size(); ++i)
          bind(points->all()[i]);
      }
    number_unknowns();
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        for (unsigned int c = 0; c < bodies.structures[body]->n_components();
             ++c)
          {
            append_row(body, i, c, 1.);
            end_row();
          }
  }

  void
  Coordinates::take(const ContactPoint &point)
  {
    const ContactPoint *&own =
      specials.make(number(point.node->body, point.node->node)).point;
    own = &point;
    if (bodies.frames.empty())
      return;
    ContactPoint &turned = own_points.emplace_back(point);
    for (auto *const list : {&turned.directions, &turned.frictionless})
      for (Tensor<1, 3> &direction : *list)
        direction = bodies.in_frame(point.node->body, direction);
    own = &turned;
  }

  /* Supports hold its node along directions of the point, or across them. These
     are directions in space, taken for those in frames: that holds as long as
     frames have not turned. */
  void
  Coordinates::bind(const ContactPoint &point)
  {
    const std::size_t n    = number(point.node->body, point.node->node);
    const auto        held = [&](const Tensor<1, 3> &direction) {
      if (specials[n].rule == nullptr)
        return false;
      const auto &all = specials[n].rule->held;
      return std::any_of(all.begin(), all.end(), [&](const HeldDirection &h) {
        return std::abs(h.direction * direction) > .5;
      });
    };
    ContactPoint &bound = own_points.emplace_back();
    bound.node          = point.node;
    for (const Tensor<1, 3> &tangent : point.frictionless)
      if (!held(tangent))
        bound.frictionless.push_back(tangent);
    for (std::size_t k = 0; k < point.dual.size(); ++k)
      if (!held(point.directions[k]))
        {
          bound.directions.push_back(point.directions[k]);
          bound.dual.push_back(point.dual[k]);
          all_bound_directions.push_back(
            {dof(point.node->body, point.node->node),
             point.first + static_cast<Eigen::Index>(k) - points->n_unknowns(),
             point.directions[k]});
          if (means)
            bind_middles(point, all_bound_directions.back());
        }
    specials.make(n).point = &bound;
  }

  /* Nodes in the middle move with their corners, along what is free there. */
  void
  Coordinates::bind_middles(const ContactPoint   &point,
                            const BoundDirection &own)
  {
    const unsigned int   body   = point.node->body;
    const BoundDirection corner = own; // the list grows
    for (const auto &[middle, part] : means->middles(body, point.node->node))
      {
        Tensor<1, 3>    along = part * corner.direction;
        const NodeRule *rule  = specials[number(body, middle)].rule;
        if (rule != nullptr)
          for (const HeldDirection &held : rule->held)
            along -= (along * held.direction) * held.direction;
        all_bound_directions.push_back(
          {dof(body, middle), corner.unknown, along});
      }
  }

  /* Contact unknowns behind all others: direct solvers condense to the last
     ones. */
  void
  Coordinates::number_unknowns()
  {
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        number_node(body, i);
    first_unknown.push_back(static_cast<int>(n_free));

    for (const auto &[point, first] : axes.own())
      {
        const unsigned int n = number(point->node->body, point->node->node);
        specials.make(n).first_contact = n_free + first;
      }
    set_n_unknowns(n_free + axes.n_unknowns());
  }

  void
  Coordinates::number_node(const unsigned int body, const unsigned int node)
  {
    const bodies::Structure &structure = *bodies.structures[body];
    const std::size_t        n         = number(body, node);
    const NodeRule          *rule      = specials[n].rule;
    first_unknown.push_back(static_cast<int>(n_free));
    // Bodies that nothing reaches are not solved.
    const bool has_unknowns =
      moves(body) && !(bodies.is_rigid(body) && node > 0);
    // Where nothing else is said each dof is an unknown, in the axes of the
    // scene.
    const Directions *free = free_directions(n);
    if (free != nullptr && has_unknowns)
      n_free += static_cast<Eigen::Index>(free->size());

    // Rotations have no frame of the node: an unknown each, about the axes of
    // the scene.
    for (unsigned int c = 0; c < structure.n_components(); ++c)
      own_unknown.push_back(has_unknowns &&
                                (free == nullptr || c >= bodies.dim) &&
                                structure.has_dof(node, c) &&
                                !(rule != nullptr && rule->holds_rotation(c)) ?
                              static_cast<int>(n_free++) :
                              -1);
  }

  std::vector<Coordinates::Origin>
  Coordinates::origins() const
  {
    std::vector<Origin> all(static_cast<std::size_t>(n_unknowns()));
    auto                next = all.begin();
    for (unsigned int n = 0; n < n_nodes(); ++n)
      next =
        std::fill_n(next, first_unknown[n + 1] - first_unknown[n], Origin{n});
    for (const auto &[point, first] : axes.own())
      next = std::fill_n(next,
                         point->dual.size(),
                         Origin{number(point->node->body, point->node->node)});
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        for (unsigned int c = bodies.dim;
             c < bodies.structures[body]->n_components();
             ++c)
          if (const Eigen::Index unknown =
                own_unknown[static_cast<std::size_t>(dof(body, i)) + c];
              unknown >= 0)
            all[static_cast<std::size_t>(unknown)].is_rotation = true;
    return all;
  }

  /* Null where a node has the scene's axes; hanging nodes have none. */
  const Coordinates::Directions *
  Coordinates::free_directions(const std::size_t n) const
  {
    if (specials[n].point != nullptr)
      return &specials[n].point->frictionless;
    return specials[n].rule != nullptr ? &specials[n].rule->free : nullptr;
  }

  /* u = sum of q_k e_k over the free directions, and of v_k d_k over those with
     a cone. */
  void
  Coordinates::append_own(const std::size_t  n,
                          const unsigned int c,
                          const double       factor)
  {
    const auto add = [&](const Directions  &directions,
                         const Eigen::Index first,
                         const double       times) {
      for (std::size_t k = 0; k < directions.size(); ++k)
        if (directions[k][c] != 0)
          append(first + static_cast<Eigen::Index>(k),
                 times * directions[k][c]);
    };
    add(*free_directions(n), first_unknown[n], factor);
    if (const ContactPoint *const point = specials[n].point; point != nullptr)
      {
        const double part =
          factor / (means ? means->own_weight(*point->node) :
                            pairing::own_weight(*point->node));
        if (specials[n].first_contact >= 0) // else it is bound
          add(point->directions, specials[n].first_contact, part);
        append_others(*point, c, part);
      }
  }

  /* What a node faces carries it along its contact directions d_k, and where it
     meets that with other nodes of its body, these as well, the other way. */
  void
  Coordinates::append_others(const ContactPoint &point,
                             const unsigned int  c,
                             const double        factor)
  {
    Tensor<1, 3> along;
    for (std::size_t k = 0; k < point.dual.size(); ++k)
      along += point.directions[k][c] * point.dual[k];
    const pairing::ContactNode &own = *point.node;
    // The dual directions are in space, and the master has its own frame.
    const Tensor<1, 3> in_master = bodies.in_frame(own.master, along);
    for (const auto &[node, weight] : own.masters)
      for (unsigned int d = 0; d < bodies.dim; ++d)
        if (in_master[d] != 0 && !(own.master == own.body && node == own.node))
          append_row(own.master, node, d, factor * weight * in_master[d]);
    if (own.opening)
      for (unsigned int d = 0; d < bodies.dim; ++d)
        if (along[d] != 0)
          append_row(*own.opening, 0, d, factor * along[d]);
    if (!own.slaves.empty())
      append_slaves(own, -factor * bodies.in_frame(own.body, along));
  }

  /* Of nodes in the middle only what they have of their own. */
  void
  Coordinates::append_slaves(const pairing::ContactNode &own,
                             const Tensor<1, 3>         &along)
  {
    for (const auto &[node, weight] : means->weights(own))
      for (unsigned int d = 0; d < bodies.dim; ++d)
        if (node == own.node || along[d] == 0)
          continue;
        else if (corners(own.body, node) != nullptr)
          append_free(own.body, node, d, weight * along[d]);
        else
          append_row(own.body, node, d, weight * along[d]);
  }

  /** What a node moves of its own: by its unknowns. */
  void
  Coordinates::append_free(const unsigned int body,
                           const unsigned int node,
                           const unsigned int c,
                           const double       factor)
  {
    const std::size_t n = number(body, node);
    if (c < bodies.dim && free_directions(n) != nullptr)
      append_own(n, c, factor);
    else if (const Eigen::Index unknown =
               own_unknown[static_cast<std::size_t>(dof(body, node)) + c];
             unknown >= 0)
      append(unknown, c < bodies.dim ? factor : factor / arm);
  }

  /* Along what no support holds. */
  void
  Coordinates::append_corners(const unsigned int body,
                              const unsigned int node,
                              const unsigned int c,
                              const double       factor)
  {
    const Directions *const free = free_directions(number(body, node));
    Tensor<1, 3>            along;
    along[c] = free == nullptr ? factor : 0;
    if (free != nullptr)
      for (const Tensor<1, 3> &direction : *free)
        along += factor * direction[c] * direction;
    for (const auto &[corner, part] : *corners(body, node))
      for (unsigned int d = 0; d < bodies.dim; ++d)
        if (along[d] != 0)
          append_row(body, corner, d, part * along[d]);
  }

  /* A hanging node has the rows of its masters in place of its own. Rotations
     of frames do not hang. */
  void
  Coordinates::append_row(const unsigned int body,
                          const unsigned int node,
                          const unsigned int c,
                          const double       factor)
  {
    AssertIndexRange(body, bodies.structures.size());
    AssertIndexRange(c, bodies.structures[body]->n_components());
    if (!moves(body))
      return;
    if (bodies.is_rigid(body) && node > 0)
      {
        for (unsigned int k = 0; k < bodies.structures[body]->n_components();
             ++k)
          if (const double way = way_by_first(body, node, c, k); way != 0)
            append_row(body, 0, k, factor * way);
        return;
      }
    const NodeRule *const rule      = specials[number(body, node)].rule;
    const bool            is_middle = c < bodies.dim && corners(body, node);
    // Masters may be held themselves, or have a frame: their own rows know.
    if (rule != nullptr && c < bodies.dim && !is_middle &&
        !rule->masters.empty())
      for (const auto &[master, weight] : rule->masters)
        append_row(body, master, c, factor * weight);
    else
      append_free(body, node, c, factor);
    if (is_middle)
      append_corners(body, node, c, factor);
  }

  Eigen::VectorXd
  Coordinates::values(const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), n_dofs());
    Eigen::VectorXd q = Eigen::VectorXd::Zero(n_unknowns());
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      for (unsigned int i = 0; i < bodies.structures[body]->n_nodes(); ++i)
        if (const Directions *free = free_directions(number(body, i));
            free != nullptr && moves(body))
          for (std::size_t k = 0; k < free->size(); ++k)
            q[first_unknown[number(body, i)] + static_cast<Eigen::Index>(k)] =
              own_displacement(u, body, i) * (*free)[k];
    for (Eigen::Index dof = 0; dof < n_dofs(); ++dof)
      if (const Eigen::Index k = own_unknown[static_cast<std::size_t>(dof)];
          k >= 0)
        q[k] = u[dof];
    if (means)
      for (const auto &[middle, its_corners] : means->all_middles())
        for (unsigned int c = 0; c < bodies.dim; ++c)
          if (const Eigen::Index k =
                own_unknown[static_cast<std::size_t>(
                              dof(middle.first, middle.second)) +
                            c];
              k >= 0)
            q[k] = own_displacement(u, middle.first, middle.second)[c];
    if (arm != 1)
      {
        const std::vector<Origin> all = origins();
        for (Eigen::Index k = 0; k < n_free; ++k)
          if (all[static_cast<std::size_t>(k)].is_rotation)
            q[k] *= arm;
      }
    for (const auto &[point, first] : axes.own())
      {
        const Tensor<1, 3> v = difference_of_sides(
          *point->node, [&](const unsigned int body, const unsigned int node) {
            return bodies.in_space(body, at_node(u, body, node));
          });
        for (std::size_t k = 0; k < point->dual.size(); ++k)
          q[n_free + first + static_cast<Eigen::Index>(k)] = v * point->dual[k];
      }
    return q;
  }

  Tensor<1, 3>
  Coordinates::own_displacement(const Eigen::VectorXd &u,
                                const unsigned int     body,
                                const unsigned int     node) const
  {
    AssertDimension(u.size(), n_dofs());
    Tensor<1, 3> result = at_node(u, body, node);
    if (const auto *const around = corners(body, node); around != nullptr)
      for (const auto &[corner, part] : *around)
        result -= part * at_node(u, body, corner);
    return result;
  }

  /* Forces do the same work on the masters as on the hanging node. */
  void
  Coordinates::unhang(Eigen::VectorXd &f) const
  {
    AssertDimension(f.size(), n_dofs());
    for (const NodeRule &rule : node_rules.rules())
      if (!rule.masters.empty())
        for (unsigned int c = 0; c < bodies.dim; ++c)
          {
            double &force = f[dof(rule.body, rule.node) + c];
            for (const auto &[master, weight] : rule.masters)
              f[dof(rule.body, master) + c] += weight * force;
            force = 0;
          }
    for (auto body = static_cast<unsigned int>(bodies.n_elastic());
         body < bodies.structures.size();
         ++body)
      gather_rigid(body, f);
  }
} // namespace conetact::contact
