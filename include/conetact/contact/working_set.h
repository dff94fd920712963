// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_working_set_h
#define conetact_contact_working_set_h

#include "conetact/solvers/contact_problem.h"

#include <vector>

namespace conetact::contact
{
  /**
   * The contact nodes that are condensed, some or all of those that may touch
   * (the candidates). The others carry no reaction; as long as none of them
   * penetrates, they need not be known to the contact solver.
   */
  class WorkingSet
  {
  public:
    /** `candidates`: their layout; `nodes`: indices there, in any order. */
    WorkingSet(const solvers::ContactSystem &candidates,
               std::vector<Eigen::Index>     nodes);
    /** All candidates, in their order. */
    explicit WorkingSet(const solvers::ContactSystem &candidates);

    bool
    is_all() const
    {
      return whole;
    }
    bool
    contains(const Eigen::Index candidate) const
    {
      return member[static_cast<std::size_t>(candidate)];
    }
    const std::vector<Eigen::Index> &
    nodes() const
    {
      return chosen;
    }
    Eigen::Index
    n_candidates() const
    {
      return static_cast<Eigen::Index>(member.size());
    }
    /** Offsets and friction coefficients of the set; no matrix. */
    const solvers::ContactSystem &
    layout() const
    {
      return own_layout;
    }
    /** Index among the candidates' unknowns of each unknown of the set. */
    const std::vector<Eigen::Index> &
    unknowns() const
    {
      return own_unknowns;
    }

    /** Rows of the set, from those of all candidates' unknowns. */
    Eigen::MatrixXd
    gather(const Eigen::MatrixXd &of_candidates) const;
    /** The other way round; the rest of the candidates stays as it is. */
    void
    scatter(const Eigen::VectorXd &own, Eigen::VectorXd &of_candidates) const;
    /** States: none where there are none; the rest is open. */
    std::vector<solvers::NodeState>
    gather(const std::vector<solvers::NodeState> &of_candidates) const;
    std::vector<solvers::NodeState>
    scatter(const std::vector<solvers::NodeState> &own) const;

  private:
    bool                      whole;
    std::vector<bool>         member;
    std::vector<Eigen::Index> chosen, own_unknowns;
    solvers::ContactSystem    own_layout;
  };
} // namespace conetact::contact

#endif
