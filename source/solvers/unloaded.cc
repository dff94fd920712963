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

    /** Of the largest interference: what is less is rounding. */
    constexpr double rounding = 1e-14;

    /** G of the normals of some nodes. */
    MatrixXd
    motions_at(const ContactSystem &system, const std::vector<Index> &nodes)
    {
      std::vector<Index> rows;
      for (const Index i : nodes)
        rows.push_back(system.normal(i));
      return system.matrix(rows,
                           Eigen::seqN(system.n_contact_unknowns(),
                                       system.n_motions));
    }

    /** Nodes join that the motion pushes in, until there are none. */
    std::optional<VectorXd>
    way_out(const ContactSystem &system, const VectorXd &gap)
    {
      const double       zero = rounding * gap.cwiseAbs().maxCoeff();
      std::vector<Index> nodes;
      std::vector<bool>  joined(static_cast<std::size_t>(gap.size()), false);
      VectorXd           a   = VectorXd::Zero(system.n_motions);
      VectorXd           now = gap;
      while (true)
        {
          const std::size_t before = nodes.size();
          for (Index i = 0; i < gap.size(); ++i)
            if (now(i) < -zero && !joined[static_cast<std::size_t>(i)])
              {
                joined[static_cast<std::size_t>(i)] = true;
                nodes.push_back(i);
              }
          if (nodes.size() == before)
            break;
          const MatrixXd G = motions_at(system, nodes);
          VectorXd       z;
          // The shortest a under G_n a + gap >= 0: its multipliers z are those
          // of the nodes that push.
          if (!solve_lcp(G * G.transpose(),
                         gap(nodes),
                         VectorXd::Ones(G.rows()),
                         Eigen::VectorXi::Zero(G.rows()),
                         z))
            return {};
          a   = G.transpose() * z;
          now = gap;
          for (Index i = 0; i < gap.size(); ++i)
            now(i) +=
              system.matrix.row(system.normal(i)).tail(system.n_motions).dot(a);
        }
      if (now.size() > 0 && now.minCoeff() < -1e3 * zero)
        return {};
      return a;
    }
  } // namespace

  std::optional<ContactState>
  stay_without_load(const ContactProblem &problem, const ContactState &start)
  {
    const ContactSystem &system = *problem.system;
    const Index          k      = system.n_motions;
    const bool           stiff  = system.form == Form::stiffness;
    const bool           held   = k == 0; // in stiffness form, too
    const VectorXd      &v      = stiff ? problem.offset : problem.load;
    const bool loaded = !(stiff ? problem.load : VectorXd(v.tail(k))).isZero(0);
    if (v.size() == 0 || loaded || (held && !start.r.isZero(0)))
      return {};
    for (Index i = 0; i < system.n_nodes(); ++i)
      if (v(system.normal(i)) < 0)
        return {};
    ContactState state;
    state.v = v;
    state.r = VectorXd::Zero(system.n_unknowns());
    if (stiff)
      state.u = state.r;
    return state;
  }



  std::optional<ContactState>
  move_without_load(const ContactProblem &problem, const ContactState &start)
  {
    const ContactSystem &system = *problem.system;
    const Index          k = system.n_motions, n = system.n_contact_unknowns();
    if (k == 0 || !problem.load.tail(k).isZero(0) ||
        !system.matrix.bottomRightCorner(k, k).isZero(0) ||
        !start.r.head(n).isZero(0)) // what is pressed already may be jammed
      return {};
    VectorXd gap(system.n_nodes());
    for (Index i = 0; i < gap.size(); ++i)
      gap(i) = problem.load(system.normal(i));
    const auto a = way_out(system, gap);
    if (!a)
      return {};
    ContactState state;
    state.r         = VectorXd::Zero(n + k);
    state.r.tail(k) = *a;
    state.v         = problem.load;
    state.v.head(n) += system.matrix.topRightCorner(n, k) * *a;
    for (Index i = 0; i < gap.size(); ++i)
      state.v(system.normal(i)) = std::max(0., state.v(system.normal(i)));
    return state;
  }
} // namespace conetact::solvers
