// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Of the sets of nodes: which hold a body.

#include "conetact/solvers/column_groups.h"
#include "conetact/solvers/node_sets.h"
#include "conetact/solvers/null_space.h"

#include <algorithm>
#include <limits>

namespace conetact::solvers
{
  using Eigen::Index;

  NodeSets
  without_slip(const LinearRelation &relation, NodeSets sets)
  {
    eigen_assert(static_cast<Index>(sets.size()) ==
                 relation.system().n_nodes());
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (sets[i].state == NodeState::slip &&
          !is_frictionless(relation, static_cast<Index>(i)))
        sets[i].state = NodeState::stick;
    return sets;
  }



  /* The strongest of the nodes that slip has the largest limit of friction
     under r, with its bond and at no slip, as it is to stick. */
  NodeSets
  with_strongest_stuck(const LinearRelation  &relation,
                       NodeSets               sets,
                       const Eigen::VectorXd &r)
  {
    eigen_assert(static_cast<Index>(sets.size()) ==
                 relation.system().n_nodes());
    eigen_assert(r.size() >= relation.system().n_contact_unknowns());
    const ContactSystem &system    = relation.system();
    NodeSet             *strongest = nullptr;
    double               most      = 0;
    for (std::size_t i = 0; i < sets.size(); ++i)
      {
        const auto   k = static_cast<Index>(i);
        const double hold =
          relation
            .limit(k, r(system.normal(k)) + relation.bond(k, 0, 0).value, 0, 0)
            .value;
        if (sets[i].state == NodeState::slip && hold > most)
          {
            most      = hold;
            strongest = &sets[i];
          }
      }
    if (strongest != nullptr)
      strongest->state = NodeState::stick;
    return sets;
  }



  /* The reaction of a node that slips is along its direction, the slip against
     it. */
  NodeSets
  with_first_turned_stuck(const LinearRelation  &relation,
                          NodeSets               sets,
                          const Eigen::VectorXd &before,
                          const Eigen::VectorXd &after)
  {
    eigen_assert(static_cast<Index>(sets.size()) ==
                 relation.system().n_nodes());
    const ContactSystem &system = relation.system();
    NodeSet             *first  = nullptr;
    double               least  = 1; // part of the way
    for (std::size_t i = 0; i < sets.size(); ++i)
      {
        const auto  k = static_cast<Index>(i);
        const Index n = system.n_tangents(k);
        if (sets[i].state != NodeState::slip || is_frictionless(relation, k))
          continue;
        const auto along = [&](const Eigen::VectorXd &v) {
          return sets[i].direction.dot(v.segment(system.first[k], n));
        };
        const double start = along(before), end = along(after);
        if (!(end > 0 && end > start))
          continue;
        const double part = std::max(0., start / (start - end));
        if (part < least)
          {
            least = part;
            first = &sets[i];
          }
      }
    if (first != nullptr)
      first->state = NodeState::stick;
    return sets;
  }



  namespace
  {
    /** Adds |P_i N_i a|^2 of a node to a form of a, where `rows` are the N_i of
     * some of the motions. */
    void
    add_resistance(const NodeSet         &set,
                   const Eigen::MatrixXd &rows,
                   Eigen::MatrixXd       &resistance)
    {
      const Index nt  = rows.rows() - 1;
      const auto  add = [&](const Eigen::MatrixXd &resisted) {
        resistance.noalias() += resisted.transpose() * resisted;
      };
      if (set.state == NodeState::open)
        return;
      if (!set.is_lifted)
        add(rows.row(nt));
      const Eigen::MatrixXd slip = rows.topRows(nt);
      if (set.state == NodeState::stick)
        add(slip);
      else if (set.ratio > 0) // along e nothing does
        add(set.ratio *
            (slip - set.direction * (set.direction.transpose() * slip)));
    }
  } // namespace

  /* A motion N a is resisted by the directions that the sets take from it:
     sum_i |P_i N_i a|^2 with P_i = 1 for closed gaps and stuck slips and
     P_i = ratio (1 - e e^T) for slips along e, which turn but do not stop. The
     matrix has the size of the motions of bodies that meet; an eigenvalue of
     1e-10 of the largest is rounding. */
  bool
  resist_motions(const ContactSystem &system, const NodeSets &sets)
  {
    eigen_assert(static_cast<Index>(sets.size()) == system.n_nodes());
    eigen_assert(system.null_space.cols() == 0 ||
                 system.null_space.rows() == system.n_contact_unknowns());
    constexpr double      rounding = 1e-10;
    const Eigen::MatrixXd N        = orthonormal_basis(system.null_space);
    if (N.cols() == 0)
      return true;
    double least = std::numeric_limits<double>::max(), most = 0;
    for (const ColumnGroup &group : column_groups(N, nodes_of(system)))
      {
        const auto      n          = static_cast<Index>(group.columns.size());
        Eigen::MatrixXd resistance = Eigen::MatrixXd::Zero(n, n);
        for (const Index i : group.blocks)
          add_resistance(sets[static_cast<std::size_t>(i)],
                         N(Eigen::seq(system.first[i], system.first[i + 1] - 1),
                           group.columns),
                         resistance);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(
          resistance, Eigen::EigenvaluesOnly);
        least = std::min(least, modes.eigenvalues().minCoeff());
        most  = std::max(most, modes.eigenvalues().maxCoeff());
      }
    return least > rounding * most;
  }



  std::string
  signature(const NodeSets &sets)
  {
    std::string result;
    result.reserve(sets.size());
    for (const NodeSet &set : sets)
      {
        const bool backwards = set.state == NodeState::slip &&
                               set.direction.size() == 1 &&
                               set.direction(0) < 0;
        result += backwards ?
                    '-' :
                    static_cast<char>('0' + static_cast<int>(set.state));
        if (set.is_lifted)
          result += '+';
      }
    return result;
  }
} // namespace conetact::solvers
