// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/iterative_elasticity.h"

#include "conetact/contact/large_motions.h"
#include "conetact/contact/large_nodes.h"
#include "conetact/iterative/separate_systems.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace conetact::contact
{
  namespace
  {
    using Eigen::VectorXd;

    /** Of linear systems without contact: as exact as rounding lets them be. */
    constexpr double to_the_end = 1e-13;

    /** Of the force that it takes to hold back what moves: to a tolerance of
     * 1e-10 of this, what is left of it is rounding. */
    constexpr double rounding_of_motion = 1e-3;

    using SharedNodes = std::shared_ptr<const SomeNodesOfBodies>;
  } // namespace

  IterativeElasticity::IterativeElasticity(const ElasticSystem &e,
                                           const NodeRules     &supports,
                                           const ContactPoints &contact_points,
                                           const RigidMotions  &m,
                                           const iterative::Preconditioner by)
    : elastic(e)
    , points(contact_points)
    , motions(m)
    , coordinates(elastic.bodies, supports, &points, arm_of_rotations(e))
    , nowhere(unresisted_fields(motions, coordinates))
    , n_bound(points.n_bound_unknowns())
    , further(further_contacts(e.bodies, coordinates, points))
    , rows_of_dofs(rows_of_further(e.bodies, coordinates, points))
    , contacts(describe_contacts())
  {
    auto system = std::make_shared<solvers::ContactSystem>(points.layout());
    iterative::LargeStiffness given;
    const auto                pins = find_pins(nowhere, coordinates);
    VectorXd                  diagonal_of_dofs;
    if (!pins.empty() || n_bound > 0)
      diagonal_of_dofs = diagonal_of(elastic, coordinates.n_dofs());
    const double pinned  = pins.empty() ? 0. : diagonal_of_dofs.mean();
    const auto   some_of = [&](const SharedNodes &nodes) {
      iterative::Elements some;
      some.for_each = [&, nodes](const UnknownsVisitor &visit) {
        for_each_element(elastic, coordinates, visit, nodes.get());
        for (const Eigen::Index pin : pins)
          visit({pin}, &pinned);
      };
      some.for_each_connection = [&, nodes](const auto &visit) {
        for_each_connection(elastic, coordinates, visit, nodes.get());
        for (const Eigen::Index pin : pins)
          visit({pin});
      };
      return some;
    };
    given.elements           = some_of(nullptr);
    given.elements.that_have = [&](const std::vector<bool> &unknowns) {
      return some_of(std::make_shared<const SomeNodesOfBodies>(
        nodes_of(elastic.bodies, coordinates, unknowns)));
    };
    given.node_of        = nodes_of_unknowns(coordinates);
    given.modes          = common_motions(elastic.bodies, coordinates);
    given.contact        = coordinates.contact_axes().layout();
    SpecialNodes special = special_nodes(elastic, coordinates, points);
    given.preconditioner = by;
    given.surface        = std::move(special.together);
    given.side           = sides_of_ties(elastic.bodies, coordinates);
    given.position       = [&](const unsigned int block) {
      const auto [body, node] = coordinates.locate(number_of_node(block));
      const Point<3> p        = elastic.bodies.structures[body]->position(node);
      return std::array<double, 3>{{p[0], p[1], p[2]}};
    };
    system->large = iterative::make_separate_systems(std::move(given),
                                                     special.direct,
                                                     elastic.bodies.dim);
    if (further)
      system->large =
        iterative::make_with_further_contacts(system->large, *further);
    const VectorXd diagonal = system->large->diagonal();
    system->large_diagonal  = diagonal.tail(system->n_unknowns());
    system->null_space      = motions.null_space();
    if (diagonal.size() > 0 && diagonal.mean() > 0)
      stiffness_scale = std::exp2(std::round(std::log2(diagonal.mean())));
    contact_system = system;
    if (n_bound > 0)
      find_stiffness_of_bound(diagonal_of_dofs);
  }

  std::vector<double>
  IterativeElasticity::describe_contacts() const
  {
    std::vector<double> numbers;
    const auto add = [&](const ContactPoint &point, const unsigned int body) {
      for (const auto *const list :
           {&point.directions, &point.dual, &point.frictionless})
        for (const Tensor<1, 3> &direction : *list)
          {
            const Tensor<1, 3> v = elastic.bodies.in_frame(body, direction);
            numbers.insert(numbers.end(), {v[0], v[1], v[2]});
          }
    };
    for (const ContactPoint &point : points)
      {
        const pairing::ContactNode &node = *point.node;
        add(point, node.body);
        if (!node.masters.empty())
          add(point, node.master);
        for (const auto *const side : {&node.masters, &node.slaves})
          for (const auto &[i, weight] : *side)
            numbers.insert(numbers.end(), {static_cast<double>(i), weight});
      }
    return numbers;
  }

  /* Of what supports hold, any of the size of the others. */
  void
  IterativeElasticity::find_stiffness_of_bound(const VectorXd &diagonal)
  {
    AssertDimension(diagonal.size(), coordinates.n_dofs());
    stiffness_of_bound.setConstant(n_bound, diagonal.mean());
    for (const Coordinates::BoundDirection &bound :
         coordinates.bound_directions())
      {
        double sum = 0;
        for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
          sum +=
            diagonal[bound.dof + c] * bound.direction[c] * bound.direction[c];
        stiffness_of_bound[bound.unknown] = sum;
      }
  }

  VectorXd
  IterativeElasticity::own(VectorXd x) const
  {
    return contact_system->large->own(std::move(x));
  }

  VectorXd
  IterativeElasticity::elastic_part(const VectorXd &x) const
  {
    VectorXd all = contact_system->large->all(x);
    return further ? further->without(all) : all;
  }

  VectorXd
  IterativeElasticity::with_further(const VectorXd &u) const
  {
    return further ? further->with_displacements(u) : u;
  }

  VectorXd
  IterativeElasticity::expand_bound(const VectorXd &v) const
  {
    AssertDimension(v.size(), n_bound);
    VectorXd u = VectorXd::Zero(coordinates.n_dofs());
    for (const Coordinates::BoundDirection &bound :
         coordinates.bound_directions())
      for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
        u[bound.dof + c] += v[bound.unknown] * bound.direction[c];
    return u;
  }

  /* The transpose of expand_bound(): forces along what is bound are the
     reactions that hold it. */
  VectorXd
  IterativeElasticity::restrict_bound(const VectorXd &forces) const
  {
    AssertDimension(forces.size(), coordinates.n_dofs());
    VectorXd r = VectorXd::Zero(n_bound);
    for (const Coordinates::BoundDirection &bound :
         coordinates.bound_directions())
      for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
        r[bound.unknown] += forces[bound.dof + c] * bound.direction[c];
    return r;
  }

  VectorXd
  IterativeElasticity::contact_load(
    const solvers::ContactProblem &problem) const
  {
    constexpr double       rounding = 1e-13; // of a sum
    const Eigen::MatrixXd &free     = motions.unresisted();
    VectorXd               resultants(free.cols());
    const VectorXd         load = contact_system->large->all(problem.load);
    for (Eigen::Index j = 0; j < free.cols(); ++j)
      {
        const VectorXd terms =
          values_of_motions(free.col(j)).cwiseProduct(load);
        const double sum = terms.sum();
        resultants[j] = std::abs(sum) > rounding * terms.lpNorm<1>() ? sum : 0.;
      }
    return shortest_load(problem.system->null_space, resultants);
  }

  void
  IterativeElasticity::reduce_one(const VectorXd &forces,
                                  const VectorXd &prescribed,
                                  LoadCase       &load)
  {
    AssertDimension(forces.size(), coordinates.n_dofs());
    AssertDimension(prescribed.size(), coordinates.n_dofs());
    const VectorXd all       = forces - elastic.internal_forces(prescribed);
    load.f                   = own(coordinates.restrict(all));
    load.bound               = VectorXd::Zero(2 * n_bound);
    load.bound.head(n_bound) = restrict_bound(all);
  }

  /* What is bound stays where it is: it moves the other way against its
     body. */
  void
  IterativeElasticity::move_bound(const VectorXd &offset, LoadCase &load) const
  {
    AssertDimension(load.bound.size(), 2 * n_bound);
    if (offset.isZero(0))
      return;
    const VectorXd forces = elastic.internal_forces(expand_bound(offset));
    load.f += own(coordinates.restrict(forces));
    load.bound.head(n_bound) += restrict_bound(forces);
    load.bound.tail(n_bound) -= offset;
    if (!further)
      return;
    // where a bound node meets something else, too
    const VectorXd seen     = rows_of_dofs * expand_bound(offset);
    const auto     unknowns = further->unknowns_of(further->further);
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      load.offset[unknowns[k]] -= seen[static_cast<Eigen::Index>(k)];
  }

  BoundState
  IterativeElasticity::bound_state(const LoadCase &load,
                                   const VectorXd &primal) const
  {
    if (n_bound == 0)
      return {};
    const VectorXd u = coordinates.expand(unknowns(load, primal));
    VectorXd       f = elastic.internal_forces(u);
    if (further)
      f -= rows_of_dofs.transpose() * further->reactions(primal);
    return {restrict_bound(f) - load.bound.head(n_bound), {}};
  }

  LoadCase
  IterativeElasticity::nothing() const
  {
    LoadCase load;
    load.f     = own(VectorXd::Zero(coordinates.n_unknowns()));
    load.bound = VectorXd::Zero(2 * n_bound);
    return load;
  }

  VectorXd
  IterativeElasticity::unknowns(const LoadCase &load,
                                const VectorXd &primal) const
  {
    if (points.layout().n_unknowns() > 0)
      return elastic_part(primal);
    // Where nothing may touch no solver has been asked.
    const solvers::LargeSystem &large = *contact_system->large;
    const auto                  f     = large.keep(load.f);
    auto                        u = large.keep(VectorXd::Zero(load.f.size()));
    for (unsigned int i = 0; i < 2; ++i) // and the rounding of that
      if (const auto step =
            large.solve({}, large.add(large.multiply(u), -1, f), {to_the_end}))
        u = large.add(u, 1, step->du);
    return large.all(large.numbers(u));
  }

  std::vector<VectorXd>
  IterativeElasticity::expand(const std::vector<const LoadCase *> &loads,
                              const std::vector<VectorXd>         &primal) const
  {
    AssertDimension(loads.size(), primal.size());
    std::vector<VectorXd> w;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        VectorXd column = coordinates.expand(unknowns(*loads[k], primal[k]));
        if (loads[k]->deforms())
          column += loads[k]->prescribed;
        if (n_bound > 0)
          column += expand_bound(loads[k]->bound.tail(n_bound));
        w.push_back(without_motion(std::move(column)));
      }
    return w;
  }

  LoadCase
  IterativeElasticity::reduce_unbalanced(const VectorXd &unbalanced) const
  {
    AssertDimension(unbalanced.size(), coordinates.n_dofs());
    LoadCase change;
    change.f                   = own(-coordinates.restrict(unbalanced));
    change.bound               = VectorXd::Zero(2 * n_bound);
    change.bound.head(n_bound) = -restrict_bound(unbalanced);
    return change;
  }

  VectorXd
  IterativeElasticity::correction(const LoadCase &,
                                  const VectorXd &primal) const
  {
    return without_motion(coordinates.expand(elastic_part(primal)));
  }

  /* What nothing resists is held at one unknown for each motion (find_pins()),
     by an arbitrary amount: it is no deformation. */
  VectorXd
  IterativeElasticity::without_motion(VectorXd w) const
  {
    if (nowhere.cols() > 0)
      w -= nowhere * (nowhere.transpose() * w).eval();
    return w;
  }

  VectorXd
  IterativeElasticity::motions_in(const VectorXd &values) const
  {
    return motions.free_in(
      without_motion(coordinates.expand(elastic_part(values))));
  }

  VectorXd
  IterativeElasticity::values_of_motions(const VectorXd &a) const
  {
    return with_further(coordinates.values(motions.field(motions.of_free(a))));
  }

  VectorXd
  IterativeElasticity::resistance(const VectorXd &a) const
  {
    return coordinates.restrict(
      elastic.spring_forces(motions.field(motions.of_free(a))));
  }

  void
  IterativeElasticity::write(const LoadCase          &load,
                             const VectorXd          &offset,
                             const ElasticState      &state,
                             solvers::ContactProblem &problem) const
  {
    AssertDimension(offset.size(), points.layout().n_unknowns());
    problem.load   = load.f;
    problem.offset = offset;
    if (!state.base.isZero(0))
      problem.load -= own(resistance(state.base));
    if (further)
      problem.load = further->with_forces(problem.load);
  }

  VectorXd
  IterativeElasticity::moved_by(const VectorXd &base) const
  {
    return base.size() > 0 ? VectorXd(motions.seen() * base) : VectorXd();
  }

  double
  IterativeElasticity::largest_force(const LoadCase &load) const
  {
    return contact_system->large->largest(load.f);
  }

  /* Open contacts carry nothing, and not all unknowns are theirs. */
  double
  IterativeElasticity::reference_force(const LoadCase &load) const
  {
    if (contact_system->n_nodes() == 0)
      return 0;
    return rounding_of_motion * contact_system->diagonal().mean() *
           (solvers::largest(load.offset) + solvers::largest(load.placement) +
            solvers::largest(load.prescribed));
  }

  void
  IterativeElasticity::begin(const ElasticState    &state,
                             solvers::ContactState &start) const
  {
    start.u = primal(state, start.r);
    if (state.motions != state.base)
      start.u += own(values_of_motions(state.motions - state.base));
  }

  /* What moves bodies as a whole would cost the digits of what strains them:
     amounts of their own have it. */
  void
  IterativeElasticity::end(const solvers::ContactState &end,
                           ElasticState                &state) const
  {
    if (state.motions.size() == 0)
      {
        state.start = shared(end.u);
        return;
      }
    const VectorXd more = motions_in(end.u);
    state.start         = shared(end.u - own(values_of_motions(more)));
    state.motions = state.base = state.base + more;
  }

  VectorXd
  IterativeElasticity::primal(const ElasticState &state, const VectorXd &) const
  {
    return state.start ? *state.start :
                         VectorXd::Zero(contact_system->large->n_own());
  }

  void
  IterativeElasticity::move(const VectorXd &amounts,
                            const VectorXd &,
                            solvers::ContactState &end) const
  {
    end.u += own(values_of_motions(amounts));
  }

  VectorXd
  IterativeElasticity::whole_start(const ElasticState &state) const
  {
    return contact_system->large->all(primal(state, {}));
  }

  /* Unknowns of other supports are others. */
  void
  IterativeElasticity::restore(const std::vector<double> &start,
                               const VectorXd &,
                               ElasticState &state) const
  {
    state.start.reset();
    const Eigen::Index n = contact_system->large->n_unknowns();
    if (start.size() == static_cast<std::size_t>(n))
      state.start = shared(own(Eigen::Map<const VectorXd>(start.data(), n)));
  }

  bool
  IterativeElasticity::linearise_about(const solvers::ContactProblem &problem,
                                       const solvers::ContactState   &state,
                                       ElasticState &elastic_state) const
  {
    if (elastic_state.motions.size() == 0 || state.nearby.size() == 0)
      return false;
    std::vector<Eigen::Index> closed;
    for (Eigen::Index i = 0; i < problem.system->n_nodes(); ++i)
      if (state.node[static_cast<std::size_t>(i)] != solvers::NodeState::open)
        closed.push_back(problem.system->normal(i));
    if (closed.empty())
      return false;
    const Eigen::MatrixXd normals = motions.seen()(closed, Eigen::all);
    const VectorXd        way =
      normals.completeOrthogonalDecomposition().solve(-problem.offset(closed));
    const VectorXd rest = state.nearby - own(values_of_motions(way));
    if (!(solvers::largest(way) > solvers::largest(elastic_part(rest))))
      return false;
    elastic_state.base += way;
    return true;
  }

  VectorXd
  IterativeElasticity::deformation(const VectorXd &primal) const
  {
    return coordinates.expand(elastic_part(primal));
  }

  VectorXd
  IterativeElasticity::nearby(const VectorXd &w, const VectorXd &amounts) const
  {
    VectorXd u = with_further(coordinates.values(w));
    if (!amounts.isZero(0))
      u += values_of_motions(amounts);
    return own(std::move(u));
  }

  /* About the end of a way there is no rounding of it. */
  bool
  IterativeElasticity::is_rounded_by(const VectorXd &way,
                                     const VectorXd &w) const
  {
    return solvers::largest(way) > solvers::largest(w);
  }
} // namespace conetact::contact
