// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/working_set.h"

#include <deal.II/base/exceptions.h>

#include <numeric>

namespace conetact::contact
{
  namespace
  {
    std::vector<Eigen::Index>
    all_nodes(const solvers::ContactSystem &candidates)
    {
      std::vector<Eigen::Index> nodes(
        static_cast<std::size_t>(candidates.n_nodes()));
      std::iota(nodes.begin(), nodes.end(), 0);
      return nodes;
    }
  } // namespace



  WorkingSet::WorkingSet(const solvers::ContactSystem &candidates,
                         std::vector<Eigen::Index>     nodes)
    : whole(nodes == all_nodes(candidates))
    , member(static_cast<std::size_t>(candidates.n_nodes()), false)
    , chosen(std::move(nodes))
  {
    // The layout of a smaller problem, and where its unknowns stand in the
    // whole.
    own_layout.mu.resize(static_cast<Eigen::Index>(chosen.size()));
    Eigen::Index k = 0;
    for (const Eigen::Index i : chosen)
      {
        member[static_cast<std::size_t>(i)] = true;
        own_layout.mu[k++]                  = candidates.mu[i];
        for (Eigen::Index c = candidates.first[static_cast<std::size_t>(i)];
             c <= candidates.normal(i);
             ++c)
          own_unknowns.push_back(c);
        own_layout.first.push_back(
          static_cast<Eigen::Index>(own_unknowns.size()));
      }
  }



  WorkingSet::WorkingSet(const solvers::ContactSystem &candidates)
    : WorkingSet(candidates, all_nodes(candidates))
  {}



  Eigen::MatrixXd
  WorkingSet::gather(const Eigen::MatrixXd &of_candidates) const
  {
    // the usual set: no copy entry by entry
    return whole ? of_candidates :
                   Eigen::MatrixXd(of_candidates(own_unknowns, Eigen::all));
  }



  void
  WorkingSet::scatter(const Eigen::VectorXd &own,
                      Eigen::VectorXd       &of_candidates) const
  {
    AssertDimension(own.size(), own_unknowns.size());
    of_candidates(own_unknowns) = own;
  }



  std::vector<solvers::NodeState>
  WorkingSet::gather(const std::vector<solvers::NodeState> &of_candidates) const
  {
    std::vector<solvers::NodeState> own;
    if (!of_candidates.empty())
      for (const Eigen::Index i : chosen)
        own.push_back(of_candidates[static_cast<std::size_t>(i)]);
    return own;
  }



  std::vector<solvers::NodeState>
  WorkingSet::scatter(const std::vector<solvers::NodeState> &own) const
  {
    AssertIndexRange(own.size(), chosen.size() + 1);
    // Nodes outside the set carry nothing.
    std::vector<solvers::NodeState> of_candidates(member.size(),
                                                  solvers::NodeState::open);
    for (std::size_t k = 0; k < own.size(); ++k)
      of_candidates[static_cast<std::size_t>(chosen[k])] = own[k];
    return of_candidates;
  }
} // namespace conetact::contact
