// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_dof_share_h
#define conetact_contact_dof_share_h

#include "conetact/base/communicator.h"
#include "conetact/contact/coordinates.h"
#include "conetact/contact/elastic_system.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace conetact::contact
{
  /**
   * The dofs that this process looks after where something is done with all of
   * them: those of its share of the nodes, one behind the other. Where nodes
   * follow others (what hangs, what is rigid) or bodies have frames, what
   * belongs together would be parted: each process of the team has all dofs
   * then, and nothing is sent.
   */
  class DofShare
  {
  public:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    /** Of the team as it is; `plain` must outlive the object. */
    DofShare(const model::Bodies &bodies, const Coordinates &plain);

    /** Whether others look after other dofs. */
    bool
    is_shared() const
    {
      return processes.size() > 1;
    }
    /** Of several that do the same, the one whose work counts. */
    bool
    is_first() const
    {
      return processes.rank() == 0;
    }
    Index
    begin() const
    {
      return first;
    }
    Index
    size() const
    {
      return last - first;
    }
    bool
    has(const Index dof) const
    {
      return dof >= first && dof < last;
    }
    /** Dofs of it that are from `from` to before `to`. */
    std::pair<Index, Index>
    within(const Index from, const Index to) const
    {
      const Index begin = std::clamp(from, first, last);
      return {begin, std::clamp(to, begin, std::max(begin, last))};
    }
    /** Of numbers of all dofs. */
    auto
    of(const Array &all) const
    {
      AssertDimension(all.size(), coordinates.n_dofs());
      return all.segment(first, last - first);
    }
    /** All of them; all processes call this. */
    Array
    gather(const Array &own) const
    {
      AssertDimension(own.size(), size());
      return processes.gather_all(own);
    }
    /** Calls visit(body, node, its first dof). */
    template <typename Visit>
    void
    for_each_node(const Visit &visit) const
    {
      for (unsigned int body = 0, n = 0; body < bodies.structures.size();
           ++body)
        {
          const unsigned int n_c  = bodies.structures[body]->n_components();
          const unsigned int end  = n + bodies.structures[body]->n_nodes();
          const unsigned int from = std::clamp(first_node, n, end);
          Index              dof  = coordinates.offset(body) +
                      Index(from - n) * static_cast<Index>(n_c);
          for (unsigned int i = from; i < std::min(end, last_node);
               ++i, dof += n_c)
            visit(body, i - n, dof);
          n = end;
        }
    }
    /** The nodes, as ElasticSystem takes them. */
    SomeNodesOfBodies
    nodes() const;

    /** Over all processes, in their order. */
    double
    sum(const double own) const
    {
      return processes.sum(own);
    }
    Array
    sum(const Array &own) const;
    /** Largest ones, number by number. */
    Array
    largest(const Array &own) const;

    /** Lists of numbers, as many on each process: a column for each. */
    Eigen::MatrixXd
    columns(const Array &own) const;

  private:
    const model::Bodies &bodies;
    const Coordinates   &coordinates;
    Communicator         processes; ///< with other dofs
    unsigned int         first_node, last_node;
    Index                first, last;
  };
} // namespace conetact::contact

#endif
