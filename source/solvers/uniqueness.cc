// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/uniqueness.h"

#include "conetact/solvers/active_set.h"
#include "conetact/solvers/all_solutions.h"
#include "conetact/solvers/stiffness_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    constexpr double infinite = std::numeric_limits<double>::infinity();

    /** K, or the inverse of W, which foundations that resist all motions of a
     * body add to; empty where there is none. */
    MatrixXd
    definite_stiffness(const std::shared_ptr<const ContactSystem> &given)
    {
      constexpr double least = 1e-10; // of the largest pivot
      if (given->large || given->n_contact_unknowns() == 0 ||
          given->n_unknowns() > UniquenessCheck::most)
        return {};
      auto kept = given;
      if (given->n_motions > 0)
        kept = StiffnessForm(given).system();
      if (!kept)
        return {};
      const ContactSystem        &system = *kept;
      const Eigen::LDLT<MatrixXd> factor(system.matrix);
      const VectorXd              pivots = factor.vectorD();
      if (factor.info() != Eigen::Success ||
          !(pivots.minCoeff() > least * pivots.maxCoeff()))
        return {};
      if (system.form == Form::stiffness)
        return system.matrix;
      return factor.solve(MatrixXd::Identity(pivots.size(), pivots.size()));
    }

    /** Solutions differ if their reactions do: these determine displacements,
     * up to motions of bodies that float. */
    bool
    differ(const ContactProblem &problem,
           const ContactState   &a,
           const ContactState   &b)
    {
      constexpr double much = 1e-6;
      const Index      n    = problem.system->n_contact_unknowns();
      return largest(a.r.head(n) - b.r.head(n)) >
             much * std::max(largest(a.r.head(n)), largest(b.r.head(n)));
    }

    /** A start in which nodes have these states; in the plane those that slip
     * do so along `sign`. Reactions and slips are of the size of the
     * solution's, as directions of slip are read off r - v. */
    ContactState
    start_with(const ContactProblem         &problem,
               const ContactState           &solution,
               const std::vector<NodeState> &nodes,
               const std::vector<double>    &sign)
    {
      const ContactSystem &system = *problem.system;
      ContactState         start  = solution;
      start.node                  = nodes;
      const double r              = std::max(largest(solution.r), 1e-300);
      const double v              = std::max(largest(solution.v), 1e-300);
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const auto  k     = static_cast<std::size_t>(i);
          const Index first = system.first[i], nt = system.n_tangents(i);
          start.r.segment(first, nt + 1).setZero();
          start.v.segment(first, nt + 1).setZero();
          if (nodes[k] == NodeState::open)
            continue;
          start.r(first + nt) = r;
          if (nt > 0 && nodes[k] == NodeState::slip)
            {
              start.v(first) = sign[k] * v;
              start.r(first) = -sign[k] * system.mu(i) * r;
            }
        }
      start.u = VectorXd();
      return start;
    }

    /** Calls visit(states, signs) until it returns true: for states that are
     * all alike, and for some by chance, which are the same in each run. */
    template <typename Visit>
    void
    visit_some(const std::size_t n, const Visit &visit)
    {
      constexpr unsigned int by_chance = 40;
      std::mt19937           random(1);
      for (const NodeState all :
           {NodeState::stick, NodeState::open, NodeState::slip})
        for (const double sign : {1., -1.})
          if (visit(std::vector<NodeState>(n, all),
                    std::vector<double>(n, sign)))
            return;
      for (unsigned int k = 0; k < by_chance; ++k)
        {
          std::vector<NodeState> states(n);
          std::vector<double>    signs(n);
          for (std::size_t i = 0; i < n; ++i)
            {
              states[i] = static_cast<NodeState>(random() % 3);
              signs[i]  = random() % 2 == 0 ? 1. : -1.;
            }
          if (visit(states, signs))
            return;
        }
    }
  } // namespace

  UniquenessCheck::UniquenessCheck(std::shared_ptr<const ContactSystem> s)
    : system(std::move(s))
    , K(definite_stiffness(system))
  {
    eigen_assert(system->mu.size() == system->n_nodes());
    if (system->mu.size() == 0 || system->mu.maxCoeff() <= 0)
      factor = infinite;
    else if (K.size() > 0)
      factor = find_factor();
  }

  /* M = (1/2) sum_i mu_i (s_i (K e_n,i) (K e_n,i)^T + E_t,i / s_i): by the
     inequality of the means it bounds mu_i |(K x)_n,i| |x_t,i| for every s. */
  MatrixXd
  UniquenessCheck::perturbation(const VectorXd &s) const
  {
    eigen_assert(s.size() == system->n_nodes());
    eigen_assert((s.array() > 0).all());
    const Index n = system->n_nodes();
    MatrixXd    normals(K.rows(), n);
    VectorXd    diagonal = VectorXd::Zero(K.rows());
    for (Index i = 0; i < n; ++i)
      {
        const double mu = system->mu(i);
        normals.col(i)  = std::sqrt(mu * s(i)) * K.col(system->normal(i));
        diagonal.segment(system->first[i], system->n_tangents(i))
          .setConstant(mu / s(i));
      }
    MatrixXd sum = MatrixXd::Zero(K.rows(), K.rows());
    sum.selfadjointView<Eigen::Lower>().rankUpdate(normals);
    sum.diagonal() += diagonal;
    return .5 * sum;
  }

  /* A factor exists in spite of rounding if the matrix is definite by much more
     than rounding: a part of K's diagonal is taken off first. */
  bool
  UniquenessCheck::holds(const double c, const MatrixXd &M) const
  {
    eigen_assert(M.rows() == K.rows());
    constexpr double least = 1e-12; // of the stiffness: rounding
    MatrixXd         rest  = K - c * M;
    rest.diagonal() -= least * K.diagonal();
    return Eigen::LLT<MatrixXd, Eigen::Lower>(rest).info() == Eigen::Success;
  }

  /* M x at the cost of two products, where M itself takes n^3. */
  VectorXd
  UniquenessCheck::perturb(const VectorXd &s, const VectorXd &x) const
  {
    eigen_assert(s.size() == system->n_nodes());
    eigen_assert(x.size() == K.rows());
    VectorXd forces = VectorXd::Zero(x.size()), sum = forces;
    for (Index i = 0; i < system->n_nodes(); ++i)
      {
        const double mu = system->mu(i);
        const Index  n = system->normal(i), first = system->first[i];
        forces(n)                     = mu * s(i) * K.col(n).dot(x);
        sum.segment(first, n - first) = mu / s(i) * x.segment(first, n - first);
      }
    return .5 * (K * forces + sum);
  }

  /* Weights s that make the largest eigenvalue of M x = lambda K x small, as
     the proof holds up to c = 1 / lambda. Powers of K^-1 M lead to the x of the
     largest one; there s |(K x)_n|^2 + |x_t|^2 / s is least for
     s = |x_t| / |(K x)_n|, towards which each s goes by 1.3 at most a round. No
     proof hangs on this: whatever s it finds is checked by a factor. */
  VectorXd
  UniquenessCheck::balanced(VectorXd s) const
  {
    constexpr unsigned int     rounds = 80, steps = 3;
    constexpr double           most_change = 1.3;
    const Eigen::LLT<MatrixXd> stiff(K);
    VectorXd x = VectorXd::LinSpaced(K.rows(), 1, 2), best = s;
    double   least = infinite;
    for (unsigned int round = 0; round < rounds; ++round)
      {
        double size = 0;
        for (unsigned int k = 0; k < steps; ++k)
          {
            x /= std::sqrt(x.dot(K * x));
            const VectorXd y = stiff.solve(perturb(s, x));
            size             = x.dot(K * y);
            x                = y;
          }
        if (size < least)
          best = s;
        least            = std::min(least, size);
        const VectorXd f = K * x;
        for (Index i = 0; i < system->n_nodes(); ++i)
          {
            const double a = s(i) * std::abs(f(system->normal(i)));
            const double b =
              x.segment(system->first[i], system->n_tangents(i)).norm();
            const double ratio = a > 0 ? b / a : most_change;
            s(i) *= std::clamp(ratio, 1 / most_change, most_change);
          }
      }
    return best;
  }

  /* The largest c for which K - c M is definite, found by halving: each trial
     takes a Cholesky factor, n^3 / 3. Of two sets of weights the better one. */
  double
  UniquenessCheck::find_factor() const
  {
    constexpr double exact = 1e-4;
    const MatrixXd   W = K.llt().solve(MatrixXd::Identity(K.rows(), K.rows()));
    VectorXd         alone(system->n_nodes()); // Best where nodes are alone.
    for (Index i = 0; i < alone.size(); ++i)
      {
        const Index first = system->first[i], n = system->normal(i);
        alone(i) = n > first ? std::sqrt(W(first, first) / K(n, n)) : 1.;
      }
    double best = 0;
    for (const VectorXd &s : {alone, balanced(alone)})
      {
        const MatrixXd M   = perturbation(s);
        double         low = 0, high = 1;
        while (holds(high, M) && high < 1e6)
          {
            low = high;
            high *= 2;
          }
        while (high - low > exact * high && high > 1e-9)
          {
            const double middle             = .5 * (low + high);
            (holds(middle, M) ? low : high) = middle;
          }
        best = std::max(best, low);
      }
    return best;
  }

  AnotherSearch
  find_another(const ContactProblem &problem,
               const ContactState   &state,
               const double          tolerance)
  {
    eigen_assert(state.r.size() == problem.system->n_unknowns());
    eigen_assert(tolerance > 0);
    AnotherSearch search;
    if (has_finite_solutions(problem))
      {
        AllSolutions all = find_all_solutions(problem, tolerance);
        for (ContactState &one : all.found)
          if (!search.other && differ(problem, state, one))
            search.other = std::move(one);
        search.n_tried = all.n_tried;
        // A search that has not even found the one that is known proves
        // nothing.
        search.is_complete =
          !search.other && all.open.empty() && !all.found.empty();
      }
    if (search.other || search.is_complete)
      return search;
    SolverOptions options;
    options.tolerance = tolerance;
    visit_some(static_cast<std::size_t>(problem.system->n_nodes()),
               [&](const std::vector<NodeState> &states,
                   const std::vector<double>    &signs) {
                 ContactState trial = start_with(problem, state, states, signs);
                 const SolverReport report =
                   ActiveSet(options).solve_from(problem, trial);
                 if (report.converged && differ(problem, state, trial))
                   search.other = trial;
                 return search.other.has_value();
               });
    return search;
  }
} // namespace conetact::solvers
