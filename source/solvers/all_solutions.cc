// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/all_solutions.h"

#include "conetact/solvers/lcp.h"
#include "conetact/solvers/stiffness_form.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** A node is taken for one of these; slips go by the sign of du_t. */
    enum class Choice
    {
      any,
      open,
      stick,
      forwards,
      backwards
    };
    using Choices = std::vector<Choice>;

    std::size_t
    at(const Index i)
    {
      return static_cast<std::size_t>(i);
    }

    /** v = W r + q, over units that make both of the size of one, so that
     * absolute tolerances may be used below. K is inverted, which costs n^3:
     * has_finite_solutions() lets a hundred unknowns pass. */
    struct Relation
    {
      const ContactSystem &system;
      MatrixXd             W;
      VectorXd             q;
      double               force = 1, length = 1;

      explicit Relation(const ContactProblem &problem)
        : system(*problem.system)
        , W(system.matrix)
        , q(problem.load)
      {
        if (system.form == Form::stiffness)
          {
            const Eigen::LDLT<MatrixXd> K(system.matrix);
            W = K.solve(MatrixXd::Identity(q.size(), q.size()));
            q = (W * q).eval();
            if (problem.offset.size() > 0)
              q += problem.offset;
          }
        W              = (.5 * (W + W.transpose())).eval();
        const auto n   = static_cast<double>(std::max<Index>(q.size(), 1));
        length         = std::max(largest(q), 1e-300);
        const double C = W.trace() / n;
        force          = C > 0 ? length / C : 1.;
        W *= force / length;
        q /= length;
      }
    };

    /** r = T x + t with x >= 0, and B r + b >= 0 for what is said of states. */
    struct Reduced
    {
      MatrixXd T, B;
      VectorXd t, b;
    };

    /** Rows a r + c >= 0, a over the unknowns. */
    class Rows
    {
    public:
      explicit Rows(const Index n)
        : size(n)
      {}
      void
      add(const Eigen::RowVectorXd &a, const double c)
      {
        rows.push_back(a);
        constants.push_back(c);
      }
      void
      write(MatrixXd &B, VectorXd &b) const
      {
        B.resize(static_cast<Index>(rows.size()), size);
        b.resize(B.rows());
        for (Index i = 0; i < B.rows(); ++i)
          {
            B.row(i) = rows[at(i)];
            b(i)     = constants[at(i)];
          }
      }

    private:
      Index                           size;
      std::vector<Eigen::RowVectorXd> rows;
      std::vector<double>             constants;
    };

    /** Columns of the reactions that a node may have, in its own unknowns: the
     * cone of the plane is spanned by its two edges, (mu, 1) and (-mu, 1), so
     * that r = T x with x >= 0 says no more and no less than |r_t| <= mu r_n.
     */
    MatrixXd
    generators(const double mu, const Index n_tangents)
    {
      if (n_tangents == 0)
        return MatrixXd::Ones(1, 1);
      if (mu == 0)
        return Eigen::Vector2d(0, 1);
      MatrixXd both(2, 2);
      both << mu, -mu, 1, 1;
      return both;
    }

    class Search
    {
    public:
      Search(const ContactProblem &p, const double tol, const std::size_t n)
        : problem(p)
        , relation(p)
        , system(relation.system)
        , tolerance(tol)
        , most(n)
      {}

      AllSolutions
      run()
      {
        visit(Choices(at(system.n_nodes()), Choice::any));
        return std::move(result);
      }

    private:
      /**
       * Nodes that stick have v = 0, those that slip v_n = 0 and
       * r_t = -+mu r_n: as many equations as these have reactions y, so that
       * (W own y + W free x + q) = 0 in rows `equal` makes y a function of the
       * reactions x of nodes whose state is not chosen. None where the
       * equations are singular: a family of reactions may be left then.
       */
      std::optional<Reduced>
      reduce(const Choices &choices) const
      {
        const Index        n = relation.q.size();
        std::vector<Index> equal; // rows of v that are zero
        MatrixXd           own   = MatrixXd::Zero(n, 2 * n);
        MatrixXd           free  = own;
        Index              n_own = 0, n_free = 0;
        for (Index i = 0; i < system.n_nodes(); ++i)
          {
            const Index  first = system.first[at(i)], nt = system.n_tangents(i);
            const Index  normal = first + nt;
            const Choice choice = choices[at(i)];
            if (choice == Choice::any)
              {
                const MatrixXd columns = generators(system.mu(i), nt);
                free.block(first, n_free, nt + 1, columns.cols()) = columns;
                n_free += columns.cols();
              }
            else if (choice == Choice::stick)
              for (Index k = first; k <= normal; ++k)
                {
                  own(k, n_own++) = 1;
                  equal.push_back(k);
                }
            else if (choice != Choice::open)
              {
                own(normal, n_own) = 1;
                if (nt > 0)
                  own(first, n_own) =
                    choice == Choice::forwards ? -system.mu(i) : system.mu(i);
                ++n_own;
                equal.push_back(normal);
              }
          }
        own.conservativeResize(n, n_own);
        free.conservativeResize(n, n_free);
        Reduced reduced{free, {}, VectorXd::Zero(n), {}};
        if (n_own > 0)
          {
            const MatrixXd A = (relation.W * own)(equal, Eigen::all);
            const Eigen::FullPivLU<MatrixXd> lu(A);
            if (!(lu.rcond() > 1e-11))
              return {};
            reduced.T -= own * lu.solve((relation.W * free)(equal, Eigen::all));
            reduced.t = -own * lu.solve(relation.q(equal));
          }
        add_conditions(choices, reduced);
        return reduced;
      }

      /** Inequalities: no gap below zero; r in its cone where a node sticks;
       * r_n not below zero and v_t of the sign that was chosen where it slips.
       */
      void
      add_conditions(const Choices &choices, Reduced &reduced) const
      {
        Rows       rows(relation.q.size());
        const auto of_v = [&](const Index k, const double sign) {
          rows.add(sign * relation.W.row(k), sign * relation.q(k));
        };
        const auto presses = [&](const Index normal) {
          rows.add(Eigen::RowVectorXd::Unit(relation.q.size(), normal), 0);
        };
        for (Index i = 0; i < system.n_nodes(); ++i)
          {
            const Index first = system.first[at(i)], nt = system.n_tangents(i);
            const Index normal = first + nt;
            switch (choices[at(i)])
              {
                case Choice::any:
                case Choice::open:
                  of_v(normal, 1);
                  break;
                case Choice::stick:
                  presses(normal);
                  for (const double sign : {1., -1.})
                    if (nt > 0)
                      {
                        Eigen::RowVectorXd a =
                          Eigen::RowVectorXd::Zero(relation.q.size());
                        a(normal) = system.mu(i);
                        a(first)  = sign;
                        rows.add(a, 0);
                      }
                  break;
                case Choice::forwards:
                case Choice::backwards:
                  presses(normal);
                  of_v(first, choices[at(i)] == Choice::forwards ? 1 : -1);
                  break;
              }
          }
        rows.write(reduced.B, reduced.b);
      }

      /**
       * Where r^T v is least; none: nowhere, or above 0. As W is semidefinite
       * the problem min r^T (W r + q) over x >= 0, B r + b >= 0 is convex, and
       * its conditions of optimality are a linear complementarity problem,
       * which Lemke's method solves or shows to have no feasible point.
       */
      std::optional<VectorXd>
      least(const Reduced &reduced) const
      {
        constexpr double much = 1e-9;
        const MatrixXd   H = 2 * reduced.T.transpose() * relation.W * reduced.T;
        const VectorXd   c =
          reduced.T.transpose() * (2 * relation.W * reduced.t + relation.q);
        const MatrixXd A = reduced.B * reduced.T;
        const VectorXd b = reduced.B * reduced.t + reduced.b;
        const Index    n = H.rows(), m = A.rows();
        MatrixXd       M         = MatrixXd::Zero(n + m, n + m);
        M.topLeftCorner(n, n)    = H;
        M.topRightCorner(n, m)   = -A.transpose();
        M.bottomLeftCorner(m, n) = A;
        VectorXd q(n + m), z;
        q << c, b.array() + much; // Edges belong to both sides.
        if (!solve_lcp(
              M, q, VectorXd::Ones(n + m), Eigen::VectorXi::Zero(n + m), z))
          return {};
        const VectorXd r   = reduced.T * z.head(n) + reduced.t;
        const double   sum = r.dot(relation.W * r + relation.q);
        if (sum > much * std::max(1., r.norm()))
          return {};
        return r;
      }

      /** How far from any state a node is at r: r_n g, r_t v_t + mu r_n |v_t|,
       * of which none is negative where r is in the cone and g >= 0, and both
       * vanish where the law holds. */
      double
      violation(const Index i, const VectorXd &r, const VectorXd &v) const
      {
        const Index  first = system.first[at(i)], nt = system.n_tangents(i);
        const double pressed = r(first + nt) * v(first + nt);
        return nt == 0 ? pressed :
                         pressed + r(first) * v(first) +
                           system.mu(i) * r(first + nt) * std::abs(v(first));
      }

      /** The node that is to be one of its states next: the worst, or the
       * first of those that are fine, since each of these may have other states
       * at other reactions. None is left once all are chosen. */
      Index
      next(const Choices &choices, const VectorXd &r) const
      {
        const VectorXd v     = relation.W * r + relation.q;
        Index          best  = -1;
        double         worst = -1;
        for (Index i = 0; i < system.n_nodes(); ++i)
          if (choices[at(i)] == Choice::any)
            if (const double now = std::max(violation(i, r, v), 0.);
                now > worst)
              {
                worst = now;
                best  = i;
              }
        return best;
      }

      /** Depth first. With n nodes 4^n sets at most, but all that complete a
       * set without a point are left out at once, and the worst node is decided
       * first: with little friction few are left. */
      void
      visit(const Choices &choices)
      {
        if (++result.n_tried > most)
          {
            result.open = "more than " + std::to_string(most) +
                          " sets of states would have to be tried";
            return;
          }
        const auto reduced = reduce(choices);
        if (!reduced)
          {
            result.open = "some set of states determines no reactions, so that "
                          "it may have a family of them";
            return;
          }
        const auto r = least(*reduced);
        if (!r)
          return;
        const Index node = next(choices, *r);
        if (node < 0)
          return keep(choices, *r);
        std::vector<Choice> possible = {Choice::stick, Choice::open};
        const Index         nt       = system.n_tangents(node);
        if (nt > 0 && system.mu(node) == 0)
          possible = {Choice::forwards, Choice::backwards, Choice::open};
        else if (nt > 0)
          possible = {Choice::stick,
                      Choice::open,
                      Choice::forwards,
                      Choice::backwards};
        for (const Choice choice : possible)
          {
            Choices more   = choices;
            more[at(node)] = choice;
            visit(more);
          }
      }

      /** States at an edge of two are found twice: the same numbers, up to the
       * rounding of two linear systems. */
      void
      keep(const Choices &choices, const VectorXd &r)
      {
        constexpr double same = 1e-7;
        ContactState     state;
        state.r = relation.force * r;
        state.v = relation.length * (relation.W * r + relation.q);
        for (Index i = 0; i < system.n_nodes(); ++i)
          set_zeros(i, choices[at(i)], state);
        if (problem.system->form == Form::stiffness)
          state.u = problem.offset.size() > 0 ?
                      VectorXd(state.v - problem.offset) :
                      state.v;
        state.node = classify(problem, state, 0);
        if (!(contact_residual(problem, state) <= tolerance))
          return;
        const auto near =
          [&](const VectorXd &a, const VectorXd &b, double size) {
            return largest(a - b) <= same * std::max(size, largest(a));
          };
        for (const ContactState &other : result.found)
          if (near(other.r, state.r, relation.force) &&
              near(other.v, state.v, relation.length))
            return;
        result.found.push_back(std::move(state));
      }

      void
      set_zeros(const Index i, const Choice choice, ContactState &state) const
      {
        const Index first = system.first[at(i)], nt = system.n_tangents(i);
        if (choice == Choice::open)
          state.r.segment(first, nt + 1).setZero();
        else
          state.v(first + nt) = 0;
        if (choice == Choice::stick)
          state.v.segment(first, nt).setZero();
      }

      const ContactProblem &problem;
      const Relation        relation;
      const ContactSystem  &system;
      const double          tolerance;
      const std::size_t     most;
      AllSolutions          result;
    };

    /** Whether foundations resist all motions, if there are any. */
    bool
    are_motions_resisted(const ContactSystem &system)
    {
      constexpr double least = 1e-12; // of the largest stiffness
      const Index      k     = system.n_motions;
      if (k == 0)
        return true;
      const VectorXd stiffness =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(
          system.matrix.bottomRightCorner(k, k), Eigen::EigenvaluesOnly)
          .eigenvalues();
      return stiffness[0] > least * stiffness[k - 1];
    }
  } // namespace

  bool
  has_finite_solutions(const ContactProblem &problem)
  {
    constexpr Index      most   = 100; // unknowns
    const ContactSystem &system = *problem.system;
    if (system.large || problem.laws || system.n_unknowns() > most ||
        system.null_space.cols() > 0 || !are_motions_resisted(system))
      return false;
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (system.n_tangents(i) > 1)
        return false;
    return true;
  }

  AllSolutions
  find_all_solutions(const ContactProblem &problem,
                     const double          tolerance,
                     const std::size_t     most)
  {
    eigen_assert(tolerance > 0);
    if (problem.system->n_motions == 0)
      return Search(problem, tolerance, most).run();
    // Foundations resist the motions, which follow from the reactions.
    eigen_assert(are_motions_resisted(*problem.system));
    const StiffnessForm without_motions(problem.system);
    if (!without_motions.exists())
      return {{}, 0, "contacts are redundant"};
    const ContactProblem held = without_motions.eliminate(problem);
    AllSolutions         all  = Search(held, tolerance, most).run();
    for (ContactState &one : all.found)
      one = without_motions.expand(problem, std::move(one));
    return all;
  }
} // namespace conetact::solvers
