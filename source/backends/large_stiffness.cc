// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/large_stiffness.h"

#include "conetact/backends/block_system.h"
#include "conetact/backends/partition.h"
#include "conetact/base/index.h"
#include "conetact/base/process.h"

#include <algorithm>
#include <numeric>

namespace conetact::backends
{
  /* Each has more than needs no levels. */
  int
  useful_processes(const Eigen::Index n_unknowns)
  {
    return processes_for(n_unknowns, small_enough);
  }



  namespace
  {
    using Eigen::Index;
    using solvers::NodeLaw;

    /** Places of unknowns among those of nodes, each with as many. */
    struct Places
    {
      std::vector<int> of;    ///< each unknown
      std::vector<int> first; ///< of each process, and behind the last one
    };

    /** Nodes of each process: what elements bring to their rows is its work. */
    std::vector<int>
    parts_of_nodes(const LargeStiffness            &given,
                   const std::vector<unsigned int> &nodes,
                   const std::vector<int>          &node,
                   const int                        n_parts)
    {
      if (n_parts == 1)
        return std::vector<int>(nodes.size(), 0);
      std::vector<WeighedNode> weighed;
      for (const unsigned int i : nodes)
        weighed.push_back({given.position(i), 0});
      given.elements.for_each_connection(
        [&](const std::vector<Index> &unknowns) {
          for (const Index q : unknowns)
            weighed[at(node[at(q)])].weight +=
              static_cast<double>(unknowns.size());
        });
      return partition(weighed, n_parts);
    }

    /** Nodes of each part in an order that serves products. */
    std::vector<std::vector<int>>
    sort_nodes(const LargeStiffness            &given,
               const std::vector<unsigned int> &nodes,
               const std::vector<int>          &part,
               const int                        n_parts)
    {
      std::vector<std::vector<int>> sorted(at(n_parts));
      for (std::size_t i = 0; i < nodes.size(); ++i)
        sorted[at(part[i])].push_back(static_cast<int>(i));
      for (std::vector<int> &own : sorted)
        {
          std::vector<std::array<double, 3>> positions;
          for (const int i : own)
            positions.push_back(given.position(nodes[at(i)]));
          std::vector<int> order = order_of_lines(positions);
          for (int &k : order)
            k = own[at(k)];
          own = std::move(order);
        }
      return sorted;
    }

    /** Nodes from 0 on. */
    struct NumberedNodes
    {
      std::vector<unsigned int> given;      ///< their numbers, ascending
      std::vector<int>          of_unknown; ///< of each unknown
    };

    /* Numbers are dense enough for a table. */
    NumberedNodes
    number_nodes(const std::vector<unsigned int> &node_of)
    {
      NumberedNodes    nodes;
      std::vector<int> number;
      for (const unsigned int i : node_of)
        {
          if (i >= number.size())
            number.resize(i + std::size_t(1), -1);
          number[i] = 0;
        }
      for (std::size_t i = 0; i < number.size(); ++i)
        if (number[i] == 0)
          {
            number[i] = static_cast<int>(nodes.given.size());
            nodes.given.push_back(static_cast<unsigned int>(i));
          }
      for (const unsigned int i : node_of)
        nodes.of_unknown.push_back(number[i]);
      return nodes;
    }

    Places
    find_places(const LargeStiffness &given, const int block, const int n_parts)
    {
      const auto [nodes, node] = number_nodes(given.node_of);
      const auto       part    = parts_of_nodes(given, nodes, node, n_parts);
      Places           places;
      std::vector<int> next(nodes.size()); // place of each node
      int              n = 0;
      for (const auto &own : sort_nodes(given, nodes, part, n_parts))
        {
          places.first.push_back(n);
          for (const int i : own)
            {
              next[at(i)] = n;
              n += block;
            }
        }
      places.first.push_back(n);
      for (const int i : node)
        places.of.push_back(next[at(i)]++);
      return places;
    }

    /** As the first process sees it. */
    class FirstPart : public solvers::LargeSystem
    {
    public:
      FirstPart(LargeStiffness &given, const unsigned int dim)
        : n_parts(useful_processes(static_cast<Index>(given.node_of.size())))
        , number(n_parts > 1 ? ++n_made : 0)
        , places(find_places(given, static_cast<int>(dim), n_parts))
      {
        WholeSystem whole = to_whole(given);
        const auto  together =
          call(dim == 2 ? Command::make_plane : Command::make_space);
        system = share_system(std::move(whole),
                              dim,
                              n_parts > 1 ? Communicator::of_first(n_parts) :
                                            Communicator());
      }
      ~FirstPart() override
      {
        if (Together::is_possible())
          call(Command::forget);
      }

      Index
      n_unknowns() const override
      {
        return static_cast<Index>(places.of.size());
      }
      Array
      multiply(const Array &u) const override
      {
        const auto together = call(Command::multiply);
        return gather(system->multiply(scatter(u)));
      }
      Array
      diagonal() const override
      {
        const auto together = call(Command::diagonal);
        return gather(system->diagonal());
      }
      std::optional<Step>
      solve(const std::vector<NodeLaw> &laws,
            const Array                &f,
            const Precision            &precision) const override
      {
        const auto together = call(Command::solve);
        Step       step     = system->solve(laws, scatter(f), precision);
        if (!step.du.allFinite())
          return {};
        step.du = gather(step.du);
        return step;
      }

    private:
      /** Asks the other processes, if they have parts of it. */
      std::unique_ptr<Together>
      call(const Command command) const
      {
        return number == 0 ?
                 nullptr :
                 std::make_unique<Together>(Order{command, number, n_parts});
      }
      WholeSystem
      to_whole(LargeStiffness &given) const
      {
        WholeSystem whole;
        whole.elements = std::move(given.elements);
        whole.places   = places.of;
        whole.first    = places.first;
        whole.modes.resize(places.first.back(), given.modes.cols());
        for (Index j = 0; j < given.modes.cols(); ++j)
          whole.modes.col(j) = scatter(given.modes.col(j));
        const Index begin = n_unknowns() - given.contact.n_unknowns();
        for (Index i = 0; i < given.contact.n_nodes(); ++i)
          {
            std::vector<int> &node = whole.contact.emplace_back();
            for (Index k = given.contact.first[at(i)];
                 k < given.contact.first[at(i) + 1];
                 ++k)
              node.push_back(places.of[at(begin + k)]);
          }
        for (std::size_t q = 0; q < given.node_of.size(); ++q)
          if (given.surface.count(given.node_of[q]) > 0)
            whole.surface.push_back(places.of[q]);
        given = {};
        return whole;
      }
      Array
      scatter(const Array &u) const
      {
        Array x = Array::Zero(places.first.back());
        for (std::size_t q = 0; q < places.of.size(); ++q)
          x[places.of[q]] = u[static_cast<Index>(q)];
        return x;
      }
      Array
      gather(const Array &x) const
      {
        Array u(n_unknowns());
        for (std::size_t q = 0; q < places.of.size(); ++q)
          u[static_cast<Index>(q)] = x[places.of[q]];
        return u;
      }

      static inline int             n_made = 0; ///< with others
      const int                     n_parts;
      const int                     number; ///< among those; 0: alone
      const Places                  places;
      std::unique_ptr<SharedSystem> system;
    };
  } // namespace



  void
  SystemParts::make(const Order &order, const unsigned int dim)
  {
    const Communicator processes = Communicator::of_first(order.value);
    if (processes.is_member())
      systems[order.number] = share_system({}, dim, processes);
  }

  const SharedSystem *
  SystemParts::find(const Order &order) const
  {
    const auto it = systems.find(order.number);
    return it == systems.end() ? nullptr : it->second.get();
  }

  void
  SystemParts::multiply(const Order &order) const
  {
    if (const SharedSystem *const system = find(order))
      system->multiply({});
  }

  void
  SystemParts::diagonal(const Order &order) const
  {
    if (const SharedSystem *const system = find(order))
      system->diagonal();
  }

  void
  SystemParts::solve(const Order &order) const
  {
    if (const SharedSystem *const system = find(order))
      system->solve({}, {}, {});
  }

  void
  SystemParts::forget(const Order &order)
  {
    systems.erase(order.number);
  }



  std::shared_ptr<const solvers::LargeSystem>
  make_large_system(LargeStiffness &&given, const unsigned int dim)
  {
    return std::make_shared<FirstPart>(given, dim);
  }
} // namespace conetact::backends
