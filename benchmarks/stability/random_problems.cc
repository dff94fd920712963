// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

/*
 * Random condensed problems whose existence of a solution is known by
 * construction, for stability.py.
 *
 *   random-problems existence FIRST LAST   problems FIRST <= i < LAST,
 * automatic random-problems methods FIRST LAST     definite ones, each method
 * by name
 *
 * prints a line for each problem (and method):
 *   number,description,method,good,outcome,residual,iterations,difference
 *
 * Existence: a definite matrix always has a solution (v.r <= 0 bounds v), a
 * singular one has one if its load was made from a solution. It has none if
 * - K v = 0, v_n > mu |v_t| at all nodes and f.v > 0 (r.v >= 0 for all r in the
 *   cones contradicts r.v = -f.v), or
 * - W y = 0, y = (0, y_n) with y_n > 0 and q.y < 0 (gaps >= 0 contradict
 *   v.y = q.y).
 * Uniqueness, for the methods: mu < lambda_min / lambda_max of the matrix.
 */
#include "conetact/solvers/existence.h"
#include "conetact/solvers/solver_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "random_problem.h"

namespace
{
  using namespace conetact;
  using namespace conetact::solvers;
  using Eigen::Index;
  using Eigen::VectorXd;

  struct Problem
  {
    std::string    description;
    ContactProblem problem;
    bool           solvable = true;
    bool           unique   = false;
    ContactState   solution; ///< where known
  };

  struct Outcome
  {
    bool        good = false;
    std::string text;
    double      residual   = 0;
    unsigned    iterations = 0;
    double      difference = 0; ///< to the only solution
  };

  constexpr double frictions[] = {0, .1, .3, 1, 3, 10, 100};

  const char *
  form_name(const Form form)
  {
    return form == Form::stiffness ? "K" : "W";
  }

  std::string
  describe(const RandomOptions &o, const std::string &kind)
  {
    std::ostringstream text;
    text << form_name(o.form) << ' ' << kind << " n_c=" << o.n_nodes
         << (o.tangents == 1 ? " 2D" :
             o.tangents == 2 ? " 3D" :
                               " mixed")
         << " mu<=" << o.mu_max << " nullity=" << o.nullity
         << " coupling=" << o.coupling << " seed=" << o.seed;
    return text.str();
  }

  /** Sizes spread evenly over the orders of magnitude, 1 to `largest`. */
  RandomOptions
  draw_options(internal::Random &random, const unsigned i, const double largest)
  {
    RandomOptions o;
    o.form     = i % 2 == 0 ? Form::stiffness : Form::compliance;
    o.n_nodes  = static_cast<Index>(std::lround(
      std::exp(internal::uniform(random, 0, std::log(largest + .499)))));
    o.tangents = static_cast<int>(random() % 2) + 1;
    o.mu_max   = frictions[random() % std::size(frictions)];
    o.zero_mu  = random() % 4 == 0 ? .2 : 0;
    o.coupling = internal::uniform(random, .1, .9);
    o.open     = internal::uniform(random, 0, .6);
    o.slip     = internal::uniform(random, 0, 1 - o.open);
    o.seed     = i + 1;
    return o;
  }

  VectorXd
  random_vector(internal::Random &random, const Index n)
  {
    return internal::random_matrix(random, n, 1);
  }

  /** Strictly inside the dual cones: nodes open faster than they slip. */
  VectorXd
  opening_motion(internal::Random &random, const ContactSystem &system)
  {
    VectorXd v = random_vector(random, system.n_unknowns());
    for (Index i = 0; i < system.n_nodes(); ++i)
      v(system.normal(i)) =
        1.05 * system.mu(i) *
          v.segment(system.first[static_cast<std::size_t>(i)],
                    system.n_tangents(i))
            .norm() +
        internal::uniform(random, .1, 1);
    return v / v.norm();
  }

  /** Reactions y >= 0 along the normals only. */
  VectorXd
  squeeze(internal::Random &random, const ContactSystem &system)
  {
    VectorXd y = VectorXd::Zero(system.n_unknowns());
    for (Index i = 0; i < system.n_nodes(); ++i)
      y(system.normal(i)) = internal::uniform(random, .1, 1);
    return y / y.norm();
  }

  /** A load that the null vector `proof` refuses, more or less clearly. */
  Problem
  without_solution(internal::Random &random, RandomOptions o)
  {
    const Index    extra  = o.nullity - 1;
    const double   share  = std::pow(10., -static_cast<int>(random() % 4));
    ContactProblem p      = random_problem(o).problem;
    auto           system = std::make_shared<ContactSystem>(*p.system);
    const Index    n      = system->n_unknowns();
    const bool     K      = o.form == Form::stiffness;
    const VectorXd proof =
      K ? opening_motion(random, *system) : squeeze(random, *system);
    Eigen::MatrixXd null(n, 1 + extra);
    null << proof, internal::random_matrix(random, n, extra);
    const Eigen::MatrixXd N = null.householderQr().householderQ() *
                              Eigen::MatrixXd::Identity(n, 1 + extra);
    const Eigen::MatrixXd P =
      Eigen::MatrixXd::Identity(n, n) - N * N.transpose();
    system->matrix = P * system->matrix * P;
    system->matrix =
      (.5 * (system->matrix + system->matrix.transpose())).eval();
    system->null_space = K ? N : Eigen::MatrixXd();
    p.load             = random_vector(random, n);
    p.load -= proof.dot(p.load) * proof;
    p.load += (K ? 1 : -1) * share * p.load.norm() * proof;
    p.system = system;
    std::ostringstream kind;
    kind << "no solution, share " << share;
    return {describe(o, kind.str()), p, false, false, {}};
  }

  Problem
  draw(const unsigned i)
  {
    internal::Random random(7919 * i + 1);
    RandomOptions    o    = draw_options(random, i, 300);
    const unsigned   kind = i / 2 % 4;
    if (kind >= 2)
      o.nullity = 1 + static_cast<Index>(random()) %
                        std::min<Index>(6, o.n_nodes * o.tangents);
    if (kind == 3)
      return without_solution(random, o);
    const RandomProblem known = random_problem(o);
    Problem             p;
    p.problem     = known.problem;
    p.description = describe(o, kind == 1 ? "any load" : "known solution");
    if (kind == 1)
      p.problem.load = random_vector(random, p.problem.load.size()) *
                       p.problem.load.lpNorm<Eigen::Infinity>();
    return p;
  }

  /** Definite; the friction of every third is small enough for uniqueness. */
  Problem
  draw_definite(const unsigned i)
  {
    internal::Random random(104729 * i + 3);
    RandomOptions    o  = draw_options(random, i, 100);
    o.mu_max            = i % 3 == 1 ? .3 : 1;
    RandomProblem known = random_problem(o);
    Problem       p;
    p.unique = i % 3 == 0;
    if (p.unique)
      {
        const VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
            known.problem.system->matrix, Eigen::EigenvaluesOnly)
            .eigenvalues();
        o.mu_max = .9 * values.minCoeff() / values.maxCoeff();
        known    = random_problem(o);
      }
    p.problem     = known.problem;
    p.solution    = known.solution;
    p.description = describe(o, p.unique ? "unique" : "definite");
    return p;
  }

  /** K v = 0, v in the dual cones, f.v > 0, with nothing but the numbers. */
  bool
  is_proof(const ContactProblem &problem, const VectorXd &v)
  {
    const ContactSystem &s = *problem.system;
    if ((s.matrix * v).norm() > 1e-9 * s.matrix.norm() * v.norm() ||
        !(problem.load.dot(v) > 0))
      return false;
    for (Index i = 0; i < s.n_nodes(); ++i)
      if (v(s.normal(i)) <
          s.mu(i) *
              v.segment(s.first[static_cast<std::size_t>(i)], s.n_tangents(i))
                .norm() -
            1e-8 * v.norm())
        return false;
    return true;
  }

  bool
  refuses(const Problem &p, Outcome &outcome)
  {
    const ExistenceCheck check(p.problem.system);
    const Existence      e =
      check.check(p.problem.load, VectorXd::Zero(p.problem.load.size()));
    if (e.admissible)
      return false;
    outcome.text =
      is_proof(p.problem, e.v) ? "refused" : "refused without proof";
    outcome.good = !p.solvable && outcome.text == "refused";
    return true;
  }

  Outcome
  solve(const Problem &p, const std::string &method)
  {
    SolverOptions options;
    options.method      = method;
    ContactState state  = unloaded(p.problem);
    const auto   report = make_solver(options)->solve(p.problem, state);
    Outcome      outcome;
    outcome.iterations = report.iterations;
    outcome.residual =
      report.converged ? contact_residual(p.problem, state) : 0;
    const bool accepted =
      report.converged && outcome.residual <= options.tolerance;
    outcome.good = accepted == p.solvable;
    outcome.text = accepted         ? "solved" :
                   report.converged ? "claims a bad result" :
                                      "not converged: " + report.reason;
    if (report.converged && !accepted)
      outcome.good = false;
    if (p.unique && accepted)
      outcome.difference =
        std::max((state.r - p.solution.r).norm() / p.solution.r.norm(),
                 (state.v - p.solution.v).norm() / p.solution.v.norm());
    std::replace(outcome.text.begin(), outcome.text.end(), ',', ';');
    return outcome;
  }

  void
  print(const unsigned     i,
        const Problem     &p,
        const std::string &method,
        const Outcome     &o)
  {
    std::string description = p.description;
    std::replace(description.begin(), description.end(), ',', ';');
    std::cout << i << ',' << description << ',' << method << ',' << o.good
              << ',' << o.text << ',' << o.residual << ',' << o.iterations
              << ',' << o.difference << std::endl;
  }

  void
  existence(const unsigned i)
  {
    const Problem p = draw(i);
    Outcome       outcome;
    if (!refuses(p, outcome))
      outcome = solve(p, "automatic");
    print(i, p, "automatic", outcome);
  }

  void
  methods(const unsigned i)
  {
    const Problem p = draw_definite(i);
    for (const SolverRow &row : solver_table())
      print(i, p, row.name, solve(p, row.name));
  }
} // namespace

int
main(int argc, char *argv[])
{
  const std::string what = argc == 4 ? argv[1] : "";
  if (what != "existence" && what != "methods")
    {
      std::cerr << "usage: random-problems existence|methods FIRST LAST\n";
      return 1;
    }
  const unsigned last = static_cast<unsigned>(std::atoi(argv[3]));
  for (unsigned i = static_cast<unsigned>(std::atoi(argv[2])); i < last; ++i)
    what == "existence" ? existence(i) : methods(i);
}
