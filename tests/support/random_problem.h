// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_random_problem_h
#define conetact_tests_random_problem_h

#include "conetact/solvers/contact_problem.h"

#include <algorithm>
#include <random>

/**
 * Contact problems with a solution known by construction: v and r are chosen
 * to satisfy the law, a matrix is drawn, and the load is what is left,
 * f = K v - r or q = v - W r. Where mu is large other solutions may exist.
 */
namespace conetact
{
  using namespace solvers;

  struct RandomOptions
  {
    Form         form     = Form::stiffness;
    Eigen::Index n_nodes  = 10;
    int          tangents = 2;  ///< 0, 1, 2; -1: any of them, node by node
    double       mu_max   = 1;  ///< mu is uniform between 0 and this
    double       zero_mu  = 0;  ///< share of nodes without friction
    Eigen::Index nullity  = 0;  ///< dimension of the null space
    Eigen::Index motions  = 0;  ///< of the compliance form
    double       drift    = 0;  ///< how far motions go [length]
    double       coupling = .5; ///< 0: block diagonal; 1: mostly coupled
    double       open = .3, slip = .3; ///< shares of the states
    unsigned int seed   = 1;
    double       length = 1; ///< unit of length
    double       force  = 1; ///< unit of force
  };

  struct RandomProblem
  {
    ContactProblem problem;
    ContactState   solution;
  };

  namespace internal
  {
    using Random = std::mt19937;

    inline double
    uniform(Random &random, const double a = 0, const double b = 1)
    {
      // The same numbers with every standard library.
      return a + (b - a) * (static_cast<double>(random()) / 4294967296.);
    }

    inline Eigen::MatrixXd
    random_matrix(Random            &random,
                  const Eigen::Index rows,
                  const Eigen::Index columns)
    {
      Eigen::MatrixXd result(rows, columns);
      for (Eigen::Index j = 0; j < columns; ++j)
        for (Eigen::Index i = 0; i < rows; ++i)
          result(i, j) = uniform(random, -1, 1);
      return result;
    }

    /** Symmetric, positive (semi)definite. */
    inline Eigen::MatrixXd
    random_operator(Random            &random,
                    const Eigen::Index n,
                    const Eigen::Index nullity,
                    const double       coupling,
                    Eigen::MatrixXd   &null_space)
    {
      const Eigen::Index    rank = std::min(n, 8 + n / 4);
      const Eigen::MatrixXd B    = random_matrix(random, n, rank);
      Eigen::MatrixXd       A =
        coupling * (B * B.transpose()) * (3. / static_cast<double>(rank));
      for (Eigen::Index i = 0; i < n; ++i)
        A(i, i) += (1 - coupling) * uniform(random, .5, 1.5) + 1e-3;
      null_space.resize(n, nullity);
      if (nullity > 0)
        {
          const Eigen::MatrixXd R = random_matrix(random, n, nullity);
          null_space              = R.householderQr().householderQ() *
                       Eigen::MatrixXd::Identity(n, nullity);
          const Eigen::MatrixXd P = Eigen::MatrixXd::Identity(n, n) -
                                    null_space * null_space.transpose();
          A = P * A * P;
        }
      return .5 * (A + A.transpose());
    }

    inline void
    random_node(Random                     &random,
                const double                mu,
                const NodeState             node,
                Eigen::Ref<Eigen::VectorXd> v,
                Eigen::Ref<Eigen::VectorXd> r)
    {
      const Eigen::Index nt = v.size() - 1;
      Eigen::VectorXd    t(nt);
      for (Eigen::Index k = 0; k < nt; ++k)
        t(k) = uniform(random, -1, 1);
      v.setZero();
      r.setZero();
      if (node == NodeState::open)
        {
          v.head(nt) = t;
          v(nt)      = uniform(random, .01, 1);
          return;
        }
      r(nt) = uniform(random, .05, 1);
      if (nt == 0 || mu == 0)
        {
          v.head(nt) = t;
          return;
        }
      if (node == NodeState::stick)
        r.head(nt) = t * (.9 * mu * r(nt) / std::max(1., t.norm()));
      else
        {
          v.head(nt) = t;
          r.head(nt) = -mu * r(nt) * t.normalized();
        }
    }
  } // namespace internal

  inline RandomProblem
  random_problem(const RandomOptions &o)
  {
    using namespace internal;
    Random random(o.seed);
    auto   system = std::make_shared<ContactSystem>();
    system->form  = o.form;
    system->first = {0};
    for (Eigen::Index i = 0; i < o.n_nodes; ++i)
      system->first.push_back(system->first.back() + 1 +
                              (o.tangents >= 0 ?
                                 o.tangents :
                                 static_cast<Eigen::Index>(random() % 3)));
    const Eigen::Index n = system->n_unknowns();
    system->mu.resize(o.n_nodes);
    for (Eigen::Index i = 0; i < o.n_nodes; ++i)
      system->mu(i) =
        uniform(random) < o.zero_mu ? 0. : o.mu_max * uniform(random);
    system->matrix =
      random_operator(random, n, o.nullity, o.coupling, system->null_space);
    if (o.form == Form::compliance)
      system->null_space.resize(0, 0);

    RandomProblem result;
    ContactState &s = result.solution;
    s.v.resize(n);
    s.r.resize(n);
    for (Eigen::Index i = 0; i < o.n_nodes; ++i)
      {
        const double    x    = uniform(random);
        const NodeState node = x < o.open          ? NodeState::open :
                               x < o.open + o.slip ? NodeState::slip :
                                                     NodeState::stick;
        s.node.push_back(node);
        const Eigen::Index size = system->n_tangents(i) + 1;
        random_node(random,
                    system->mu(i),
                    node,
                    s.v.segment(system->first[i], size),
                    s.r.segment(system->first[i], size));
      }
    s.v *= o.length;
    s.r *= o.force;
    if (o.motions > 0)
      {
        const Eigen::Index k = o.motions;
        for (Eigen::Index j = 0; j < k; ++j)
          system->first.push_back(system->first.back() + 1);
        system->n_motions          = k;
        const Eigen::MatrixXd G    = random_matrix(random, n, k);
        Eigen::MatrixXd       all  = Eigen::MatrixXd::Zero(n + k, n + k);
        all.topLeftCorner(n, n)    = system->matrix;
        all.topRightCorner(n, k)   = G;
        all.bottomLeftCorner(k, n) = -G.transpose();
        system->matrix             = all;
        s.v.conservativeResize(n + k);
        s.r.conservativeResize(n + k);
        s.v.tail(k).setZero();
        s.r.tail(k) = o.drift * random_matrix(random, k, 1);
      }
    const bool stiffness = o.form == Form::stiffness;
    system->matrix *= stiffness ? o.force / o.length : o.length / o.force;
    result.problem.load   = stiffness ? (system->matrix * s.v - s.r).eval() :
                                        (s.v - system->matrix * s.r).eval();
    result.problem.gap    = Eigen::VectorXd::Zero(o.n_nodes);
    result.problem.system = system;
    return result;
  }

  /** The state before an increment: nothing has happened yet. */
  inline ContactState
  unloaded(const ContactProblem &problem)
  {
    const ContactSystem &system = *problem.system;
    ContactState         state;
    state.v = Eigen::VectorXd::Zero(system.n_unknowns());
    state.r = Eigen::VectorXd::Zero(system.n_unknowns());
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      state.v(system.normal(i)) = problem.gap(i);
    return state;
  }
} // namespace conetact

#endif
