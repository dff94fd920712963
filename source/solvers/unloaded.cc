// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/unloaded.h"

#include "conetact/solvers/lcp.h"

#include <vector>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** An interference of less than this part of the largest gap is rounding.
     */
    constexpr double rounding = 1e-14;
  } // namespace

  /* An active set that only grows: rows join that the motion pushes in, until
     there are none, as rows that need not push get the multiplier zero. So the
     problem of complementarity has the size of few of all rows. G G^T is
     semidefinite, singular if rows depend on each other: Lemke's method ends in
     a solution all the same, or shows that there is none. */
  std::optional<VectorXd>
  shortest_way_out(const MatrixXd &rows, const VectorXd &gap)
  {
    eigen_assert(rows.rows() == gap.size());
    VectorXd           a = VectorXd::Zero(rows.cols()), now = gap;
    std::vector<Index> pushing;
    std::vector<bool>  joined(static_cast<std::size_t>(gap.size()), false);
    if (gap.size() == 0)
      return a;
    const double zero = rounding * gap.cwiseAbs().maxCoeff();
    while (true)
      {
        const std::size_t before = pushing.size();
        for (Index i = 0; i < gap.size(); ++i)
          if (now(i) < -zero && !joined[static_cast<std::size_t>(i)])
            {
              joined[static_cast<std::size_t>(i)] = true;
              pushing.push_back(i);
            }
        if (pushing.size() == before)
          break;
        const MatrixXd G = rows(pushing, Eigen::all);
        VectorXd       z; // multipliers of those that push
        if (!solve_lcp(G * G.transpose(),
                       gap(pushing),
                       VectorXd::Ones(G.rows()),
                       Eigen::VectorXi::Zero(G.rows()),
                       z))
          return {};
        a   = G.transpose() * z;
        now = gap + rows * a;
      }
    if (now.minCoeff() < -1e3 * zero) // more than rounding
      return {};
    return a;
  }

  /* v = q or v = o: nothing moves but what is prescribed. */
  std::optional<ContactState>
  stay_without_load(const ContactProblem &problem, const ContactState &start)
  {
    eigen_assert(start.r.size() == problem.system->n_unknowns());
    const ContactSystem &system = *problem.system;
    const Index          k      = system.n_motions;
    const bool           stiff  = system.form == Form::stiffness;
    const bool           held   = k == 0; // in stiffness form, too
    const VectorXd      &v      = stiff ? problem.offset : problem.load;
    const bool loaded = !(stiff ? problem.load : VectorXd(v.tail(k))).isZero(0);
    // what bonds hold, or fluids press, does not just stay where it is
    if (v.size() == 0 || loaded || problem.has_bonds() ||
        (held && !start.r.isZero(0)))
      return {};
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (v(system.normal(i)) < 0 && !problem.is_apart(i))
        return {};
    ContactState state;
    state.v = v;
    state.r = VectorXd::Zero(system.n_unknowns());
    if (stiff)
      state.u = state.r;
    return state;
  }



  /* v = q + G a with the shortest a that leaves no interference: a choice among
     many, since nothing determines where such a body goes. */
  std::optional<ContactState>
  move_without_load(const ContactProblem &problem, const ContactState &start)
  {
    eigen_assert(start.r.size() == problem.system->n_unknowns());
    eigen_assert(problem.load.size() == problem.system->n_unknowns());
    const ContactSystem &system = *problem.system;
    const Index          k = system.n_motions, n = system.n_contact_unknowns();
    if (k == 0 || problem.has_bonds() || !problem.load.tail(k).isZero(0) ||
        !system.matrix.bottomRightCorner(k, k).isZero(0) ||
        !start.r.head(n).isZero(0)) // what is pressed already may be jammed
      return {};
    std::vector<Index> normals;
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (!problem.is_apart(i))
        normals.push_back(system.normal(i));
    const auto a = shortest_way_out(system.matrix(normals, Eigen::seqN(n, k)),
                                    problem.load(normals));
    if (!a)
      return {};
    ContactState state;
    state.r         = VectorXd::Zero(n + k);
    state.r.tail(k) = *a;
    state.v         = problem.load;
    state.v.head(n) += system.matrix.topRightCorner(n, k) * *a;
    for (const Index normal : normals)
      state.v(normal) = std::max(0., state.v(normal));
    return state;
  }
} // namespace conetact::solvers
