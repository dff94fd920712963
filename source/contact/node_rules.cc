// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/node_rules.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/solvers/contact_problem.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace conetact::contact
{
  namespace
  {
    /** Directions closer than this, as a sine, are the same. As a cosine
     * (is_across) that is 4e-5 from a right angle. */
    constexpr double same_direction = 1e-9;

    /** v - sum_k (v . e_k) e_k: its length is |v| times the sine of its angle
     * with what the e_k span. */
    Tensor<1, 3>
    remainder(Tensor<1, 3> v, const std::vector<Tensor<1, 3>> &orthonormal)
    {
      for (const Tensor<1, 3> &e : orthonormal)
        v -= (v * e) * e;
      return v;
    }
  } // namespace

  std::vector<Tensor<1, 3>>
  directions(const std::vector<HeldDirection> &held)
  {
    std::vector<Tensor<1, 3>> result;
    for (const HeldDirection &h : held)
      result.push_back(h.direction);
    return result;
  }

  bool
  is_spanned(const Tensor<1, 3>              &v,
             const std::vector<Tensor<1, 3>> &orthonormal)
  {
    return remainder(v, orthonormal).norm() < same_direction * v.norm();
  }

  bool
  is_across(const Tensor<1, 3> &v, const std::vector<Tensor<1, 3>> &orthonormal)
  {
    return remainder(v, orthonormal).norm() >= (1 - same_direction) * v.norm();
  }

  void
  add_direction(const Tensor<1, 3> &v, std::vector<Tensor<1, 3>> &orthonormal)
  {
    if (is_spanned(v, orthonormal))
      return;
    const Tensor<1, 3> rest = remainder(v, orthonormal);
    orthonormal.push_back(rest / rest.norm());
  }

  /* All directions that supports hold each node along, as they are: several
     supports may name the same one. Foundations hold nothing, they resist. */
  SupportedNodes
  supported_nodes(const model::Bodies &bodies)
  {
    SupportedNodes held;
    for (const bodies::Support &support : bodies.supports)
      if (!support.stiffness)
        for (const bodies::SurfaceNode &node : support.surface.nodes)
          for (const bodies::Support::Held &along : support.directions_at(node))
            held[{support.body, node.node}].push_back(along.direction);
    return held;
  }

  /* Gram and Schmidt over the axes, of which each time the one is taken that is
     furthest from the span: what is left of it is at least 1/sqrt(dim) long,
     and its direction is known to all digits. */
  std::vector<Tensor<1, 3>>
  complement(std::vector<Tensor<1, 3>> basis, const unsigned int dim)
  {
    Assert(basis.size() <= dim,
           dealii::ExcMessage("A basis has no more directions than space."));
    const std::size_t n_given = basis.size();
    while (basis.size() < dim)
      {
        Tensor<1, 3> best;
        for (unsigned int d = 0; d < dim; ++d)
          {
            Tensor<1, 3> axis;
            axis[d]                   = 1;
            const Tensor<1, 3> beyond = remainder(axis, basis);
            // The axis that is least spanned; of equal ones the first, so that
            // the basis does not depend on rounding.
            if (beyond.norm() > best.norm() + same_direction)
              best = beyond;
          }
        basis.push_back(best / best.norm());
      }
    basis.erase(basis.begin(),
                basis.begin() + static_cast<std::ptrdiff_t>(n_given));
    return basis;
  }

  /* In a plane of symmetry a normal must lie in the plane, or the support would
     hold a part of the gap. Normals of facets miss it by their angle; those
     that miss by more are not meant, and are refused as oblique. */
  void
  align_with_supports(const model::Bodies               &bodies,
                      std::vector<pairing::ContactNode> &nodes)
  {
    constexpr double largest_facet_angle = .1; // as a sine

    // A node that meets nothing yet may face a body later.
    const auto faces_body = [](const pairing::ContactNode &node) {
      return !node.masters.empty() || node.obstacle == nullptr;
    };
    if (std::none_of(nodes.begin(), nodes.end(), faces_body))
      return;

    const SupportedNodes held = supported_nodes(bodies);
    for (pairing::ContactNode &node : nodes)
      {
        const auto found = held.find({node.body, node.node});
        if (!faces_body(node) || found == held.end())
          continue;
        std::vector<Tensor<1, 3>> basis;
        for (const Tensor<1, 3> &e : found->second)
          add_direction(e, basis);
        const bool any_will_do =
          node.meets_nothing() && !is_spanned(node.n, basis);
        for (const Tensor<1, 3> &e : basis)
          // Nearly in the plane of symmetry: the part across it is an error of
          // the facets. What meets nothing has no normal of its own yet.
          if (any_will_do || std::abs(node.n * e) < largest_facet_angle)
            node.n -= (node.n * e) * e;
        pairing::set_frame(node, node.n / node.n.norm(), bodies.dim);
      }
  }

  bool
  NodeRule::holds_rotation(const unsigned int component) const
  {
    return std::any_of(rotations.begin(),
                       rotations.end(),
                       [component](const HeldRotation &rotation) {
                         return rotation.component == component;
                       });
  }



  NodeRules::NodeRules(const model::Bodies &b, const std::vector<double> &times)
    : bodies(b)
  {
    // A map, as supports come in any order and several may hold a node.
    std::map<std::pair<unsigned int, unsigned int>, NodeRule> rules;
    const auto rule_of = [&](const unsigned int body,
                             const unsigned int node) -> NodeRule & {
      NodeRule &rule = rules[{body, node}];
      rule.body      = body;
      rule.node      = node;
      return rule;
    };

    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      // Surfaces do not list hanging nodes: no support holds one.
      for (const bodies::HangingNode &h :
           bodies.structures[body]->hanging_nodes())
        rule_of(body, h.node).masters = h.masters;

    for (std::size_t s = 0; s < bodies.supports.size(); ++s)
      {
        const bodies::Support &support = bodies.supports[s];
        // Springs are elements, not rules.
        if (support.stiffness)
          continue;
        for (const bodies::SurfaceNode &node : support.surface.nodes)
          {
            for (const auto &[direction, e] : support.directions_at(node))
              hold(rule_of(support.body, node.node), {direction, {{s, e, 1.}}});
            for (std::size_t r = 0; r < support.rotations.size(); ++r)
              if (const unsigned int c = support.rotations[r].component;
                  bodies.structures[support.body]->has_dof(node.node, c))
                hold_rotation(rule_of(support.body, node.node),
                              {c, s, r},
                              times);
          }
      }

    for (auto &[key, rule] : rules)
      {
        if (rule.masters.empty())
          rule.free = complement(directions(rule.held), bodies.dim);
        if (bodies.is_free_obstacle(rule.body))
          rule.axes = directions(rule.held);
        sorted.push_back(std::move(rule));
      }
    check_redundant(times);
  }

  bool
  NodeRules::turn_with_frames()
  {
    bool has_turned = false;
    for (NodeRule &rule : sorted)
      for (std::size_t k = 0; k < rule.axes.size(); ++k)
        if (const Tensor<1, 3> now = bodies.in_frame(rule.body, rule.axes[k]);
            now != rule.held[k].direction)
          {
            rule.held[k].direction = now;
            rule.free  = complement(directions(rule.held), bodies.dim);
            has_turned = true;
          }
    return has_turned;
  }

  /* Rules are sorted by body and node: a bisection, as elements and contacts
     ask often. */
  const NodeRule *
  NodeRules::find(const unsigned int body, const unsigned int node) const
  {
    const auto rule =
      std::lower_bound(sorted.begin(),
                       sorted.end(),
                       std::make_pair(body, node),
                       [](const NodeRule                              &a,
                          const std::pair<unsigned int, unsigned int> &b) {
                         return std::make_pair(a.body, a.node) < b;
                       });
    return rule != sorted.end() && rule->body == body && rule->node == node ?
             &*rule :
             nullptr;
  }

  /* Gram and Schmidt with the displacements: along the remainder e - sum
     (e.e_k) e_k the node moves by u_e - sum (e.e_k) u_k, over its length. Each
     term remembers its support, so that a support that moves is asked at any
     time. */
  void
  NodeRules::hold(NodeRule &rule, const HeldDirection &direction)
  {
    Assert(std::abs(direction.direction.norm() - 1) < 1e-6,
           dealii::ExcMessage("Held directions have unit length."));
    HeldDirection rest = direction;
    for (const HeldDirection &held : rule.held)
      {
        const double overlap = direction.direction * held.direction;
        rest.direction -= overlap * held.direction;
        for (const HeldDirection::Term &term : held.terms)
          rest.terms.push_back(
            {term.support, term.expression, -overlap * term.factor});
      }
    const double length = rest.direction.norm();
    if (length < same_direction)
      {
        // Held already; whether both agree is checked when all are known.
        redundant.push_back({rule.body, rule.node, direction});
        return;
      }
    rest.direction /= length;
    for (HeldDirection::Term &term : rest.terms)
      term.factor /= length;
    rule.held.push_back(rest);
  }

  /* Rotations are held about the axes of the scene, one by one: they are the
     same or independent. */
  void
  NodeRules::hold_rotation(NodeRule                     &rule,
                           const NodeRule::HeldRotation &held,
                           const std::vector<double>    &times) const
  {
    const Point<3> p = bodies.structures[rule.body]->position(rule.node);
    for (const NodeRule::HeldRotation &other : rule.rotations)
      if (other.component == held.component)
        {
          for (const double t : times)
            if (std::abs(angle(other, p, t) - angle(held, p, t)) > 1e-12)
              throw InputError(
                "Support '" + bodies.supports[held.support].name +
                "' and another one turn the node at " + to_text(p) +
                " of body '" + bodies.names[rule.body] +
                "' by different angles. Let the supports agree "
                "where they meet.");
          return;
        }
    rule.rotations.push_back(held);
  }

  double
  NodeRules::angle(const NodeRule::HeldRotation &held,
                   const Point<3>               &p,
                   const double                  t) const
  {
    return bodies.supports[held.support].rotations[held.rotation].angle(p, t);
  }

  /* What supports prescribe along an orthonormal direction, a sum over the
     supports that it is made of. */
  double
  NodeRules::displacement(const HeldDirection &held,
                          const Point<3>      &p,
                          const double         t) const
  {
    double sum = 0;
    for (const HeldDirection::Term &term : held.terms)
      sum += term.factor *
             bodies.supports[term.support].displaced(term.expression, p, t);
    return sum;
  }

  double
  NodeRules::displacement(const NodeRule      &rule,
                          const HeldDirection &held,
                          const double         t) const
  {
    const Point<3> p = bodies.structures[rule.body]->position(rule.node);
    // Bodies that turn far are held in all directions, or not at all: frames
    // take displacements as a whole, not a component of them. Of obstacles they
    // take the axes that are held, and see nothing of the others.
    if (bodies.frames.empty() ||
        (rule.held.size() < bodies.dim && rule.axes.empty()))
      return displacement(held, p, t);
    Tensor<1, 3> u;
    for (std::size_t k = 0; k < rule.held.size(); ++k)
      u += displacement(rule.held[k], p, t) *
           (rule.axes.empty() ? rule.held[k].direction : rule.axes[k]);
    return held.direction * bodies.in_frame(rule.body, rule.node, u);
  }

  /* Displacements of supports are functions of time: they agree if they do at
     all times of the run, up to rounding. */
  void
  NodeRules::check_redundant(const std::vector<double> &times) const
  {
    for (const Redundant &r : redundant)
      {
        const NodeRule *rule = find(r.body, r.node);
        const Point<3>  p    = bodies.structures[r.body]->position(r.node);
        // Expressions that should be zero are so to the rounding of positions.
        const double rounding = solvers::position_rounding *
                                bodies::reach(*bodies.structures[r.body]);
        for (const double t : times)
          {
            const double wanted = displacement(r.held, p, t);
            double       given = 0, size = std::abs(wanted);
            for (const HeldDirection &held : rule->held)
              {
                const double u = displacement(held, p, t);
                // The node's displacement along the redundant direction, by
                // what holds it.
                given += u * (held.direction * r.held.direction);
                size = std::max(size, std::abs(u));
              }
            if (std::abs(given - wanted) > 1e-9 * size + rounding)
              throw InputError(
                "Support '" +
                bodies.supports[r.held.terms.front().support].name +
                "', Displacement: the node at " + to_text(p) + " of body '" +
                bodies.names[r.body] + "' should move by " + to_text(wanted) +
                " along " + to_text(r.held.direction) +
                " at t = " + to_text(t) + ", but another support moves it by " +
                to_text(given) +
                (to_text(given) == to_text(wanted) ?
                   " (they differ by " + to_text(given - wanted) + ")" :
                   "") +
                ". Let the supports agree where they meet.");
          }
      }
  }
} // namespace conetact::contact
