// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/iterative_elasticity.h"

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <memory>

namespace conetact::contact
{
  namespace
  {
    using Eigen::VectorXd;

    /** Of the force that it takes to hold back what moves: to a tolerance of
     * 1e-10 of this, what is left of it is rounding. */
    constexpr double rounding_of_motion = 1e-3;

    /** Own numbers of unknowns, and motions of bodies beside them. */
    class StatesOfLarge : public ElasticStates
    {
    public:
      StatesOfLarge(const LargeUnknowns &u, const RigidMotions &m)
        : unknowns(u)
        , motions(m)
      {}

      void
      begin(const ElasticState    &state,
            solvers::ContactState &start) const override
      {
        start.u = primal(state, start.r);
        if (state.motions != state.base)
          start.u +=
            unknowns.own(unknowns.of_motions(state.motions - state.base));
      }
      /** What moves bodies as a whole would cost the digits of what strains
       * them: amounts of their own have it. */
      void
      end(const solvers::ContactState &end, ElasticState &state) const override
      {
        if (state.motions.size() == 0)
          {
            state.start = shared(end.u);
            return;
          }
        const VectorXd more = unknowns.motions_in(end.u);
        state.start   = shared(end.u - unknowns.own(unknowns.of_motions(more)));
        state.motions = state.base = state.base + more;
      }
      VectorXd
      primal(const ElasticState &state, const VectorXd &) const override
      {
        return state.start ? *state.start :
                             VectorXd::Zero(unknowns.system->n_own());
      }
      void
      move(const VectorXd &amounts,
           const VectorXd &,
           solvers::ContactState &end) const override
      {
        end.u += unknowns.own(unknowns.of_motions(amounts));
      }
      VectorXd
      whole_start(const ElasticState &state) const override
      {
        return unknowns.system->all(primal(state, {}));
      }
      /** Unknowns of other supports are others. */
      void
      restore(const std::vector<double> &start,
              const VectorXd &,
              ElasticState &state) const override
      {
        state.start.reset();
        const Eigen::Index n = unknowns.system->n_unknowns();
        if (start.size() == static_cast<std::size_t>(n))
          state.start =
            shared(unknowns.own(Eigen::Map<const VectorXd>(start.data(), n)));
      }

      VectorXd
      moved_by(const VectorXd &base) const override
      {
        return base.size() > 0 ? VectorXd(motions.seen() * base) : VectorXd();
      }
      bool
      linearise_about(const solvers::ContactProblem &problem,
                      const solvers::ContactState   &state,
                      ElasticState                  &elastic) const override
      {
        if (elastic.motions.size() == 0 || state.nearby.size() == 0)
          return false;
        std::vector<Eigen::Index> closed;
        for (Eigen::Index i = 0; i < problem.system->n_nodes(); ++i)
          if (state.node[static_cast<std::size_t>(i)] !=
              solvers::NodeState::open)
            closed.push_back(problem.system->normal(i));
        if (closed.empty())
          return false;
        const Eigen::MatrixXd normals = motions.seen()(closed, Eigen::all);
        const VectorXd way = normals.completeOrthogonalDecomposition().solve(
          -problem.offset(closed));
        const VectorXd rest =
          state.nearby - unknowns.own(unknowns.of_motions(way));
        if (!(solvers::largest(way) >
              solvers::largest(unknowns.elastic_part(rest))))
          return false;
        elastic.base += way;
        return true;
      }
      /** Also by unknowns of contacts that were there before. */
      VectorXd
      deformation(const VectorXd &primal) const override
      {
        return unknowns.displacements(primal);
      }
      VectorXd
      nearby(const VectorXd &w, const VectorXd &amounts) const override
      {
        VectorXd u = unknowns.values(w);
        if (!amounts.isZero(0))
          u += unknowns.of_motions(amounts);
        return unknowns.own(std::move(u));
      }

    private:
      const LargeUnknowns &unknowns;
      const RigidMotions  &motions;
    };
  } // namespace

  IterativeElasticity::IterativeElasticity(const ElasticSystem &e,
                                           const NodeRules     &supports,
                                           const ContactPoints &contact_points,
                                           const RigidMotions  &m,
                                           const iterative::Preconditioner by)
    : elastic(e)
    , points(contact_points)
    , motions(m)
    , unknowns(elastic, supports, points, motions, by)
    , following(elastic, points, unknowns)
    , contacts(describe_contacts())
  {
    auto system   = std::make_shared<solvers::ContactSystem>(points.layout());
    system->large = unknowns.system;
    const VectorXd diagonal = system->large->diagonal();
    system->large_diagonal  = diagonal.tail(system->n_unknowns());
    system->null_space      = motions.null_space();
    if (diagonal.size() > 0 && diagonal.mean() > 0)
      stiffness_scale = std::exp2(std::round(std::log2(diagonal.mean())));
    contact_system = system;
    own_states     = std::make_unique<StatesOfLarge>(unknowns, motions);
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

  VectorXd
  IterativeElasticity::contact_load(
    const solvers::ContactProblem &problem) const
  {
    constexpr double       rounding = 1e-13; // of a sum
    const Eigen::MatrixXd &free     = motions.unresisted();
    VectorXd               resultants(free.cols());
    const VectorXd         load = unknowns.system->all(problem.load);
    for (Eigen::Index j = 0; j < free.cols(); ++j)
      {
        const VectorXd terms =
          unknowns.of_motions(free.col(j)).cwiseProduct(load);
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
    AssertDimension(forces.size(), prescribed.size());
    load = following.load_of(forces - elastic.internal_forces(prescribed));
  }

  LoadCase
  IterativeElasticity::nothing() const
  {
    LoadCase load;
    load.f = unknowns.own(VectorXd::Zero(unknowns.coordinates.n_unknowns()));
    load.bound = VectorXd::Zero(2 * points.n_bound_unknowns());
    return load;
  }

  std::vector<VectorXd>
  IterativeElasticity::expand(const std::vector<const LoadCase *> &loads,
                              const std::vector<VectorXd>         &primal) const
  {
    AssertDimension(loads.size(), primal.size());
    std::vector<VectorXd> w;
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        VectorXd column = unknowns.displacements(loads[k]->f, primal[k]);
        if (loads[k]->deforms())
          column += loads[k]->prescribed;
        following.add_displacements(*loads[k], column);
        w.push_back(unknowns.without_motion(std::move(column)));
      }
    return w;
  }

  /* Where a body has moved further than it deforms, the rounding of this way is
     what is left; about its end there is none. */
  LoadCase
  IterativeElasticity::reduce_unbalanced(const Unbalanced &left) const
  {
    return solvers::largest(left.motions) > solvers::largest(left.w) ?
             nothing() :
             following.load_of(-left.forces);
  }

  void
  IterativeElasticity::write(const LoadCase          &load,
                             const VectorXd          &offset,
                             const ElasticState      &state,
                             solvers::ContactProblem &problem) const
  {
    AssertDimension(offset.size(), points.n_unknowns());
    problem.load   = load.f;
    problem.offset = offset;
    if (!state.base.isZero(0))
      problem.load -= unknowns.resistance(state.base);
    if (unknowns.further)
      problem.load = unknowns.further->with_forces(problem.load);
  }

  /* Open contacts carry nothing, and not all unknowns are theirs. */
  ForceScale
  IterativeElasticity::force_scale(const LoadCase &load) const
  {
    ForceScale scale{unknowns.system->largest(load.f)};
    if (contact_system->n_nodes() > 0)
      scale.reference =
        rounding_of_motion * contact_system->diagonal().mean() *
        (solvers::largest(load.offset) + solvers::largest(load.placement) +
         solvers::largest(load.prescribed));
    return scale;
  }
} // namespace conetact::contact
