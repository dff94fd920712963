// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/large_stiffness.h"

#include "conetact/base/index.h"
#include "conetact/base/partition.h"
#include "conetact/base/process.h"
#include "conetact/iterative/block_system.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace conetact::iterative
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
      int              block; ///< places of a node
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
      const auto part          = parts_of_nodes(given, nodes, node, n_parts);
      Places     places;
      places.block = block;
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

    /** The number of a vector that processes keep. */
    struct KeptVector : solvers::LargeVector
    {
      KeptVector(const int n, std::shared_ptr<std::vector<int>> list)
        : number(n)
        , forgotten(std::move(list))
      {}
      ~KeptVector() override
      {
        forgotten->push_back(number);
      }
      KeptVector(const KeptVector &) = delete;
      KeptVector &
      operator=(const KeptVector &) = delete;

      const int                               number;
      const std::shared_ptr<std::vector<int>> forgotten;
    };

    /** As the first process sees it. */
    class FirstPart : public solvers::LargeSystem
    {
    public:
      FirstPart(LargeStiffness &given, const unsigned int dim)
        : n_parts(given.preconditioner == Preconditioner::aggregation ?
                    useful_processes(static_cast<Index>(given.node_of.size())) :
                    1)
        , number(n_parts > 1 ? ++n_made : 0)
        , places(find_places(given, static_cast<int>(dim), n_parts))
      {
        WholeSystem whole = to_whole(given);
        const auto  together =
          call(on(dim == 2 ? Command::make_plane : Command::make_space));
        system = share_system(std::move(whole),
                              dim,
                              n_parts > 1 ? Communicator::of_first(n_parts) :
                                            Communicator());
      }
      ~FirstPart() override
      {
        if (Together::is_possible())
          call(on(Command::forget));
      }

      Index
      n_unknowns() const override
      {
        return static_cast<Index>(places.of.size());
      }
      Kept
      keep(const Array &x) const override
      {
        return make(on(Command::keep),
                    [&](const int to) { system->keep(scatter(x), to); });
      }
      Array
      numbers(const Kept &x) const override
      {
        const auto together = call(on(Command::numbers, of(x)));
        return gather(system->numbers(of(x)));
      }
      Array
      of_contact(const Kept &x) const override
      {
        const auto together = call(on(Command::of_contact, of(x)));
        return system->of_contact(of(x));
      }
      Kept
      add(const Kept &x, const double factor, const Kept &y) const override
      {
        return make(on(Command::add, of(x), of(y), factor), [&](const int to) {
          system->add(of(x), factor, of(y), to);
        });
      }
      double
      product_elsewhere(const Kept &x, const Kept &y) const override
      {
        const auto together =
          call(on(Command::product_elsewhere, of(x), of(y)));
        return system->product_elsewhere(of(x), of(y));
      }
      Kept
      multiply(const Kept &u) const override
      {
        return make(on(Command::multiply, of(u)),
                    [&](const int to) { system->multiply(of(u), to); });
      }
      Array
      diagonal() const override
      {
        const auto together = call(on(Command::diagonal));
        return gather(system->diagonal());
      }
      std::optional<Step>
      solve(const std::vector<NodeLaw> &laws,
            const Kept                 &f,
            const Precision            &precision) const override
      {
        std::optional<SharedSystem::Found> found;
        const Kept du = make(on(Command::solve, of(f)), [&](const int to) {
          found = system->solve(laws, of(f), precision, to);
        });
        if (!found)
          return {};
        return Step{du, found->iterations, found->error};
      }

    private:
      static Order
      on(const Command command,
         const int     x      = 0,
         const int     y      = 0,
         const double  factor = 0)
      {
        return {command, 0, 0, 0, x, y, factor};
      }
      static int
      of(const Kept &x)
      {
        return static_cast<const KeptVector &>(*x).number;
      }
      /** Asks the other processes, if they have parts of it. */
      std::unique_ptr<Together>
      call(Order order) const
      {
        if (number == 0)
          return nullptr;
        order.number = number;
        order.value  = n_parts;
        return std::make_unique<Together>(order);
      }
      /** All forget what nobody refers to any more. */
      void
      forget_vectors() const
      {
        for (const int x : std::exchange(*forgotten, {}))
          {
            const auto together = call(on(Command::forget_vector, x));
            system->forget(x);
          }
      }
      /** A vector that make_vector(its number) makes here, and this order in
       * other processes. */
      template <typename Do>
      Kept
      make(Order order, const Do &make_vector) const
      {
        forget_vectors();
        const auto made     = std::make_shared<KeptVector>(++n_kept, forgotten);
        order.to            = made->number;
        const auto together = call(order);
        make_vector(made->number);
        return made;
      }
      WholeSystem
      to_whole(LargeStiffness &given) const
      {
        WholeSystem whole;
        whole.elements       = std::move(given.elements);
        whole.places         = places.of;
        whole.first          = places.first;
        whole.preconditioner = given.preconditioner;
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
        if (!given.side.empty())
          whole.side = sides_of_places(given);
        given = {};
        return whole;
      }
      /** That of its node for each place, 0 if nothing is said. */
      Array
      sides_of_places(const LargeStiffness &given) const
      {
        const int block = places.block;
        Array     sides = Array::Zero(places.first.back());
        for (std::size_t q = 0; q < given.node_of.size(); ++q)
          if (const auto it = given.side.find(given.node_of[q]);
              it != given.side.end())
            sides.segment(places.of[q] / block * block, block)
              .setConstant(it->second);
        return sides;
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

      static inline int                       n_made = 0; ///< with others
      const int                               n_parts;
      const int                               number; ///< among those; 0: alone
      const Places                            places;
      std::unique_ptr<SharedSystem>           system;
      mutable int                             n_kept = 0;
      const std::shared_ptr<std::vector<int>> forgotten =
        std::make_shared<std::vector<int>>();
    };
  } // namespace



  void
  SystemParts::make(const Order &order, const unsigned int dim)
  {
    const Communicator processes = Communicator::of_first(order.value);
    if (processes.is_member())
      systems[order.number] = share_system({}, dim, processes);
  }

  void
  SystemParts::go_along(const Order &order) const
  {
    const auto it = systems.find(order.number);
    if (it == systems.end())
      return;
    SharedSystem &system = *it->second;
    const int     to = order.to, x = order.x, y = order.y;
    switch (order.command)
      {
        case Command::keep:
          return system.keep({}, to);
        case Command::numbers:
          return (void)system.numbers(x);
        case Command::of_contact:
          return (void)system.of_contact(x);
        case Command::add:
          return system.add(x, order.factor, y, to);
        case Command::product_elsewhere:
          return (void)system.product_elsewhere(x, y);
        case Command::multiply:
          return system.multiply(x, to);
        case Command::diagonal:
          return (void)system.diagonal();
        case Command::solve:
          return (void)system.solve({}, x, {}, to);
        case Command::forget_vector:
          return system.forget(x);
        default:
          break;
      }
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
} // namespace conetact::iterative
