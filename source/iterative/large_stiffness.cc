// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/large_stiffness.h"

#include "conetact/base/index.h"
#include "conetact/base/partition.h"
#include "conetact/base/team.h"
#include "conetact/iterative/block_system.h"
#include "conetact/iterative/element_rows.h"
#include "conetact/solvers/local_system.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace conetact::iterative
{
  /* Shares of a size that is solved directly are not worth messages. */
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

    /** Work of the rows of nodes: numbers that elements bring to them. Each
     * process counts for a share of nodes, as parts are not known yet. */
    Eigen::VectorXd
    work_of_nodes(const LargeStiffness   &given,
                  const std::size_t       n_nodes,
                  const std::vector<int> &node,
                  const Communicator     &processes)
    {
      const auto [begin, end] =
        share_of(static_cast<Index>(n_nodes), processes);
      std::vector<bool> own;
      for (const int i : node)
        own.push_back(i >= begin && i < end);
      Eigen::VectorXd work = Eigen::VectorXd::Zero(end - begin);
      needed_for(own, given.elements)
        .for_each_connection([&, first = begin](const auto &unknowns) {
          for (const Index q : unknowns)
            if (own[at(q)])
              work[node[at(q)] - first] += static_cast<double>(unknowns.size());
        });
      return processes.gather_all(work);
    }

    /** The process of each node: nodes of all have about the same work, which
     * grows with the elements at a node, not with nodes. */
    std::vector<int>
    parts_of_nodes(const LargeStiffness            &given,
                   const std::vector<unsigned int> &nodes,
                   const std::vector<int>          &node,
                   const Communicator              &processes)
    {
      if (processes.size() == 1)
        return std::vector<int>(nodes.size(), 0);
      const Eigen::VectorXd work =
        work_of_nodes(given, nodes.size(), node, processes);
      std::vector<WeighedNode> weighed;
      for (const unsigned int i : nodes)
        weighed.push_back(
          {given.position(i), work[static_cast<Index>(weighed.size())]});
      return partition(weighed, processes.size());
    }

    /** Nodes of each part along lines of a regular mesh: neighbours in this
     * order have rows of the same numbers, which RowRuns multiplies at once. */
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

    /* Numbers are dense enough for a table, which is faster than a map. */
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

    /* Each node has `block` places, of which its unknowns take the first ones
       as they come. Where some are missing, as in supports, places stay empty:
       blocks of one size are worth that. */
    Places
    find_places(const LargeStiffness &given,
                const int             block,
                const Communicator   &processes)
    {
      const auto [nodes, node] = number_nodes(given.node_of);
      const auto       part    = parts_of_nodes(given, nodes, node, processes);
      Places           places;
      std::vector<int> next(nodes.size()); // place of each node
      int              n = 0;
      for (const auto &own : sort_nodes(given, nodes, part, processes.size()))
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

    /** All of the team, or each process by itself for what is small: it does
     * the same as all others then, for less than messages cost. */
    Communicator
    processes_of(const LargeStiffness &given)
    {
      const bool is_shared =
        given.preconditioner == Preconditioner::aggregation &&
        given.node_of.size() > at(small_enough);
      return is_shared ? team() : Communicator();
    }

    /** A BlockSystem of which each process has its places. */
    template <int block>
    class SharedSystem : public solvers::LargeSystem
    {
    public:
      explicit SharedSystem(LargeStiffness &&given)
        : processes(processes_of(given))
        , n(static_cast<Index>(given.node_of.size()))
        , n_contact(given.contact.n_unknowns())
      {
        BlockShare<block> share = find_share(given);
        // Elements give their memory back before levels take theirs.
        given  = {};
        system = std::make_unique<const BlockSystem<block>>(std::move(share));
      }

      Index
      n_unknowns() const override
      {
        return n;
      }
      Index
      n_own() const override
      {
        return static_cast<Index>(elsewhere.size()) + n_contact;
      }
      Array
      own(Array all) const override
      {
        AssertDimension(all.size(), n_unknowns());
        if (processes.size() == 1)
          return all;
        Array result(n_own());
        result << all(numbers_of_own), all.tail(n_contact);
        return result;
      }
      Array
      all(Array own) const override
      {
        AssertDimension(own.size(), n_own());
        if (processes.size() == 1)
          return own;
        Array result(n_unknowns());
        // All processes have all unknowns of contact. The others are gathered
        // with their numbers, as parts follow the mesh and not the order of
        // unknowns.
        result.tail(n_contact) = own.tail(n_contact);
        own.conservativeResize(numbers_of_own.size());
        own                      = processes.gather_all(std::move(own));
        const Eigen::VectorXi to = processes.gather_all(numbers_of_own);
        for (Index i = 0; i < to.size(); ++i)
          result[to[i]] = own[i];
        return result;
      }
      double
      largest(const Array &own) const override
      {
        return solvers::largest(processes.gather_all(
          Array(Array::Constant(1, solvers::largest(own)))));
      }
      Kept
      keep(const Array &x) const override
      {
        return make(in_places(x));
      }
      Array
      numbers(const Kept &x) const override
      {
        Array own(n_own());
        own << part(x)(elsewhere), of_contact(x);
        return own;
      }
      /* Laws are evaluated by all processes alike, on the same numbers: states
         are the same everywhere, and no process has to be told of them. */
      Array
      of_contact(const Kept &x) const override
      {
        return processes.gather_all(Array(part(x)(contact)))(contact_order);
      }
      Kept
      add(const Kept &x, const double factor, const Kept &y) const override
      {
        return make(part(x) + factor * part(y));
      }
      /* Sums go from one place of contact to the next: no copy is made. */
      double
      product_elsewhere(const Kept &x, const Kept &y) const override
      {
        const Array &a = part(x), &b = part(y);
        double       sum  = 0;
        Index        from = 0;
        const auto   add  = [&](const Index to) {
          sum += a.segment(from, to - from).dot(b.segment(from, to - from));
          from = to + 1;
        };
        for (const int p : ascending_contact)
          add(p);
        add(a.size());
        return processes.sum(sum);
      }
      /* Vectors of all unknowns are copied and sent as they come and go; K u is
         made of parts, and only their borders are sent. */
      Kept
      multiply(const Kept &u) const override
      {
        return make(system->multiply(part(u)));
      }
      Array
      diagonal() const override
      {
        return all(numbers(make(system->diagonal())));
      }
      std::optional<Step>
      solve(const std::vector<NodeLaw> &laws,
            const Kept                 &f,
            const Precision            &precision) const override
      {
        std::vector<NodeLaw> own;
        if (!laws.empty())
          for (const std::size_t i : own_nodes)
            own.push_back(laws[i]);
        auto step = system->solve(own, part(f), precision);
        // Where each process has all of it, machines may have rounded in other
        // ways; decisions of Newton's method must be the same on all.
        if (processes.size() == 1)
          team().broadcast(step.du);
        if (processes.sum(step.du.allFinite() ? 0. : 1.) > 0)
          return {};
        return Step{make(std::move(step.du)), step.iterations, step.error};
      }

    private:
      BlockShare<block>
      find_share(const LargeStiffness &given)
      {
        const Places places = find_places(given, block, processes);
        begin               = places.first[at(processes.rank())];
        end                 = places.first[at(processes.rank()) + 1];
        take_contact(given, places);
        take_elsewhere(places);
        BlockShare<block> share;
        share.processes      = processes;
        share.first          = places.first;
        share.surface        = surface_of(given, places);
        share.exists         = in_places(Array::Ones(n_own()));
        share.modes          = own_modes(given);
        share.side           = own_sides(given, places);
        share.preconditioner = given.preconditioner;
        share.K =
          rows_of_elements<block>(given.elements, places.of, begin, end);
        for (const std::size_t i : own_nodes)
          share.contact.push_back(own_contact_of(given.contact, places, i));
        return share;
      }
      static Kept
      make(Array x)
      {
        return std::make_shared<solvers::LocalVector>(std::move(x));
      }
      /** The part of a vector that this process has. */
      static const Array &
      part(const Kept &x)
      {
        return static_cast<const solvers::LocalVector &>(*x).x;
      }
      bool
      is_own(const int place) const
      {
        return place >= begin && place < end;
      }
      /** What it has of own numbers: not of all that are of contact. */
      Array
      in_places(const Array &x) const
      {
        AssertDimension(x.size(), n_own());
        Array own         = Array::Zero(end - begin);
        own(elsewhere)    = x.head(static_cast<Index>(elsewhere.size()));
        const Index first = n_own() - n_contact;
        for (std::size_t k = 0; k < contact.size(); ++k)
          own[contact[k]] = x[first + own_contact[k]];
        return own;
      }

      void
      take_elsewhere(const Places &places)
      {
        std::vector<int> own;
        for (Index q = 0; q < n - n_contact; ++q)
          if (is_own(places.of[at(q)]))
            {
              elsewhere.push_back(places.of[at(q)] - begin);
              if (processes.size() > 1)
                own.push_back(static_cast<int>(q));
            }
        elsewhere.shrink_to_fit();
        numbers_of_own =
          Eigen::Map<const Eigen::VectorXi>(own.data(),
                                            static_cast<Index>(own.size()));
      }

      /** Finds the unknowns of contact that are this process's, and where those
       * of all stand once they are gathered, process by process. All unknowns
       * of a node have one owner, as its law mixes them. */
      void
      take_contact(const LargeStiffness &given, const Places &places)
      {
        const solvers::ContactSystem   &nodes = given.contact;
        std::vector<std::vector<Index>> of_process(at(processes.size()));
        for (Index i = 0; i < nodes.n_nodes(); ++i)
          {
            const Index from = nodes.first[at(i)];
            const int   p    = owner_of(place(places, from), places.first);
            for (Index k = from; k < nodes.first[at(i) + 1]; ++k)
              of_process[at(p)].push_back(k);
            if (p != processes.rank())
              continue;
            own_nodes.push_back(at(i));
            for (const int own : own_contact_of(nodes, places, at(i)))
              contact.push_back(own);
            for (Index k = from; k < nodes.first[at(i) + 1]; ++k)
              own_contact.push_back(static_cast<int>(k));
          }
        contact_order.resize(at(nodes.n_unknowns()));
        int next = 0;
        for (const std::vector<Index> &unknowns : of_process)
          for (const Index k : unknowns)
            contact_order[at(k)] = next++;
        ascending_contact = contact;
        std::sort(ascending_contact.begin(), ascending_contact.end());
      }
      /** The place of unknown k of contact. */
      int
      place(const Places &places, const Index k) const
      {
        return places.of[at(n - n_contact + k)];
      }
      std::vector<int>
      own_contact_of(const solvers::ContactSystem &nodes,
                     const Places                 &places,
                     const std::size_t             i) const
      {
        std::vector<int> node;
        for (Index k = nodes.first[i]; k < nodes.first[i + 1]; ++k)
          node.push_back(place(places, k) - begin);
        return node;
      }
      /** Nodes of all processes. */
      std::vector<int>
      surface_of(const LargeStiffness &given, const Places &places) const
      {
        std::set<int> nodes;
        for (std::size_t q = 0; q < given.node_of.size(); ++q)
          if (given.surface.count(given.node_of[q]) > 0)
            nodes.insert(places.of[q] / block);
        return {nodes.begin(), nodes.end()};
      }
      /* Each mode is made in full and cut to the own part before the next one
         is: all at once they would take six vectors of all unknowns on each
         process. */
      Eigen::MatrixXd
      own_modes(const LargeStiffness &given) const
      {
        Eigen::MatrixXd modes(end - begin,
                              static_cast<Index>(given.modes.size()));
        for (Index j = 0; j < modes.cols(); ++j)
          modes.col(j) = in_places(own(given.modes[at(j)]()));
        return modes;
      }
      /** A number for each own node, or for none at all; 0 if nothing is said.
       */
      std::vector<int>
      own_sides(const LargeStiffness &given, const Places &places) const
      {
        if (given.side.empty())
          return {};
        std::vector<int> sides(at((end - begin) / block), 0);
        for (std::size_t q = 0; q < given.node_of.size(); ++q)
          if (is_own(places.of[q]))
            if (const auto it = given.side.find(given.node_of[q]);
                it != given.side.end())
              sides[at((places.of[q] - begin) / block)] = it->second;
        return sides;
      }

      const Communicator processes;
      const Index        n, n_contact;       ///< unknowns
      int                begin = 0, end = 0; ///< own places
      std::vector<int>   elsewhere;          ///< places of own unknowns
      /** Their numbers, where others have some. */
      Eigen::VectorXi          numbers_of_own;
      std::vector<std::size_t> own_nodes;   ///< of contact
      std::vector<int>         own_contact; ///< their unknowns among those
      std::vector<int> contact, ascending_contact; ///< their places among own
      /** Where each unknown of contact stands among those of all processes, one
       * behind the other. */
      std::vector<int>                          contact_order;
      std::unique_ptr<const BlockSystem<block>> system;
    };
  } // namespace



  std::shared_ptr<const solvers::LargeSystem>
  make_large_system(LargeStiffness &&given, const unsigned int dim)
  {
    Assert(dim == 2 || dim == 3,
           dealii::ExcMessage("Nodes have two unknowns or three."));
    if (dim == 2)
      return std::make_shared<SharedSystem<2>>(std::move(given));
    return std::make_shared<SharedSystem<3>>(std::move(given));
  }
} // namespace conetact::iterative
