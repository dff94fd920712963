// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_contact_change_h
#define conetact_iterative_contact_change_h

#include "conetact/base/index.h"
#include "conetact/iterative/shared_rows.h"

#include <algorithm>
#include <vector>

namespace conetact::iterative
{
  /** What a state makes of the row of a contact node. */
  template <int block>
  struct NodeState
  {
    Eigen::Matrix<float, block, 1>     held; ///< 1: the unknown is known
    Eigen::Matrix<float, block, block> added;

    bool
    operator==(const NodeState &other) const
    {
      return held == other.held && added == other.added;
    }
    /** Other unknowns are held, or what is added differs by more than the mean
     * of both. */
    bool
    differs_much_from(const NodeState &other) const
    {
      return held != other.held || (added - other.added).norm() >
                                     .5f * (added.norm() + other.added.norm());
    }
  };

  /** Whether what was made for states `shown` serves those that are asked for:
   * none of their nodes differs much. */
  template <int block>
  bool
  serve(const std::vector<NodeState<block>> &shown,
        const std::vector<NodeState<block>> &asked)
  {
    return std::equal(asked.begin(),
                      asked.end(),
                      shown.begin(),
                      shown.end(),
                      [](const auto &a, const auto &b) {
                        return !a.differs_much_from(b);
                      });
  }

  /**
   * What a state of contacts changes of the coarse levels of a matrix A in
   * which all contact nodes are free: P^T (A' - A) P, where A' has but the
   * diagonal in rows and columns that are held. Near contact only it is not
   * zero; all processes have all of it.
   */
  template <int fine, int coarse>
  class ContactChange
  {
  public:
    using Rows = SomeRows<coarse, coarse>;

    ContactChange() = default;
    /**
     * `nodes`: contact nodes of this process, by their own rows; rows of the
     * processes begin at `first`. P leads to the first coarse level.
     */
    ContactChange(const DistributedMatrix<fine, fine, float>   &A,
                  const std::vector<int>                       &nodes,
                  const std::vector<int>                       &first,
                  const DistributedMatrix<fine, coarse, float> &P,
                  const Communicator                           &processes);
    /** The next coarse level, to which P leads from rows that begin at `begin`
     * in this process. */
    void
    add_level(const DistributedMatrix<coarse, coarse, float> &P,
              const int                                       begin,
              const Communicator                             &processes);

    int
    n_levels() const
    {
      return static_cast<int>(levels.size()) + 1;
    }
    /** Of a level below the finest one, from 0: blocks that may be other than
     * zero. */
    const Rows &
    pattern(const int level) const
    {
      return level == 0 ? first_change : levels[at(level - 1)].change;
    }
    /** Of all levels, for the contact nodes of this process. */
    std::vector<Rows>
    change(const std::vector<NodeState<fine>> &states) const;

  private:
    using FineBlock   = Eigen::Matrix<float, fine, fine>;
    using Map         = Eigen::Matrix<float, fine, coarse>;
    using CoarseBlock = Eigen::Matrix<float, coarse, coarse>;

    struct Level
    {
      Rows P;      ///< of rows that change
      Rows change; ///< zero
    };
    /** A contact node of this process. */
    struct Node
    {
      std::size_t place; ///< among those of all
      std::vector<std::pair<std::size_t, FineBlock>> neighbours; ///< places
      FineBlock                                      diagonal;
    };

    void
    find_rows(const DistributedMatrix<fine, fine, float> &A,
              const std::vector<int>                     &nodes,
              const int                                   begin,
              const SomeRows<fine, coarse>               &P);
    Rows
    first_level(const std::vector<NodeState<fine>> &states) const;
    /** P^T C P of the change C of the level above. */
    Rows
    projected(const Rows &above, const Level &level) const;

    Communicator           processes;
    std::vector<int>       contact; ///< nodes of all processes
    std::vector<Node>      own;
    SomeRows<fine, coarse> P;            ///< of contact nodes of all processes
    SomeRows<fine, coarse> AP;           ///< of own ones
    Rows                   first_change; ///< zero
    std::vector<Level>     levels;       ///< below the first coarse one
  };

  extern template class ContactChange<2, 3>;
  extern template class ContactChange<3, 6>;
} // namespace conetact::iterative

#endif
