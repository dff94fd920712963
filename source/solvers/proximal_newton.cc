// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/proximal_newton.h"

#include "conetact/solvers/node_sets.h"

#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;
    using Triplets = std::vector<Eigen::Triplet<double>>;

    /** Steps at most, and in a row that do not halve the residual. */
    constexpr unsigned int max_steps = 40, max_stalls = 6;

    int
    to_int(const Index i)
    {
      return static_cast<int>(i);
    }

    /* Entries of P + D (M + shift): rows of M by node, the weights of D. */
    Triplets
    assemble(const ContactSystem                                &system,
             const Eigen::SparseMatrix<double, Eigen::RowMajor> &M,
             const std::vector<NodeLaw>                         &laws,
             const double                                        shift)
    {
      Triplets entries;
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const NodeLaw    &law   = laws[static_cast<std::size_t>(i)];
          const Index       first = system.first[i], dim = law.h.size();
          const SmallMatrix own = law.p + shift * law.d;
          for (Index k = 0; k < dim; ++k)
            for (Index l = 0; l < dim; ++l)
              {
                entries.emplace_back(to_int(first + k),
                                     to_int(first + l),
                                     own(k, l));
                if (law.d(k, l) == 0)
                  continue;
                for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator
                       e(M, first + l);
                     e;
                     ++e)
                  entries.emplace_back(to_int(first + k),
                                       to_int(e.col()),
                                       law.d(k, l) * e.value());
              }
        }
      return entries;
    }
  } // namespace



  bool
  ProximalNewton::direction(const Array &p,
                            const Array &d,
                            const double shift,
                            Array       &dp)
  {
    const LinearRelation      &linear = relation.relation;
    const std::vector<NodeLaw> laws =
      linearized_laws(linear, sets_of_point(linear, p, d), p, d);
    // d = M p + l holds at every point here: only the law has a residual.
    Array h(p.size());
    for (Index i = 0; i < linear.system().n_nodes(); ++i)
      h.segment(linear.system().first[i], linear.system().n_tangents(i) + 1) =
        laws[static_cast<std::size_t>(i)].h;
    const Triplets entries = assemble(linear.system(), relation.M, laws, shift);
    SparseRelation::Matrix J(p.size(), p.size());
    J.setFromTriplets(entries.begin(), entries.end());
    // The entries of a row change with the state of its node.
    factor.forget_pattern();
    ++factorizations;
    if (!factor.factorize(J))
      return false;
    dp = factor.solve(h);
    return dp.allFinite();
  }



  /* The full step if it gains, else shorter ones; false if none does. */
  bool
  ProximalNewton::step(const double shift, Array &p, Array &d, double &residual)
  {
    Array dp;
    if (!direction(p, d, shift, dp))
      return false;
    for (double tau = 1; tau > .01; tau /= 2)
      {
        const Array  p_new = p + tau * dp;
        const Array  d_new = relation.dual(p_new);
        const double value = law_residual(relation.relation, p_new, d_new);
        if (!(value < residual))
          continue;
        p        = p_new;
        d        = d_new;
        residual = value;
        return true;
      }
    return false;
  }



  /* A shift of 1e-9 of the diagonal, which is one in scaled variables, makes
     the matrix regular and hardly slows Newton's method down; it grows a
     hundredfold where no step gains. */
  double
  ProximalNewton::polish(const double                 goal,
                         const std::function<bool()> &stop,
                         Array                       &p,
                         Array                       &d)
  {
    eigen_assert(p.size() == relation.M.cols());
    d               = relation.dual(p);
    double residual = law_residual(relation.relation, p, d);
    double shift    = 1e-9;
    for (unsigned int i = 0, stalls = 0; i < max_steps && stalls < max_stalls;
         ++i)
      {
        if (residual <= goal || (stop && stop()))
          break;
        const double before = residual;
        if (!step(shift, p, d, residual))
          // No step gains: held more, the reactions move less. The limit of the
          // iteration does not depend on the shift.
          shift *= 100;
        if (shift > 1)
          break;
        stalls = residual < .5 * before ? 0 : stalls + 1;
      }
    return residual;
  }
} // namespace conetact::solvers
