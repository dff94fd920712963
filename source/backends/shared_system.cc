// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/shared_system.h"

#include "conetact/backends/block_system.h"
#include "conetact/base/index.h"

#include <algorithm>

namespace conetact::backends
{
  namespace
  {
    using Eigen::Index;
    using solvers::NodeLaw;

    /**
     * The rows of nodes, to which elements add one by one. A row is handed on
     * as soon as the last element of its node has come, so that few are open at
     * a time.
     */
    template <int block>
    class OpenRows
    {
    public:
      using Row = GrowingRow<block, block>;

      OpenRows(const Elements         &for_each_element,
               const std::vector<int> &places_of_unknowns,
               const int               n_nodes)
        : places(places_of_unknowns)
        , left(at(n_nodes), 0)
        , place(at(n_nodes), none)
      {
        for_each_element(
          [&](const std::vector<Index> &unknowns, const double *) {
            find_nodes(unknowns);
            for (const int i : nodes)
              ++left[at(i)];
          });
      }

      /** Calls take(node, row) for what is complete. */
      template <typename Take>
      void
      add(const std::vector<Index> &unknowns,
          const double             *matrix,
          const Take               &take)
      {
        find_nodes(unknowns);
        blocks.clear();
        for (const int i : nodes)
          {
            Row &row = open(i);
            for (const int j : nodes)
              blocks.push_back(row.find(j));
          }
        const std::size_t n = unknowns.size();
        for (std::size_t a = 0; a < n; ++a)
          {
            Row &row = rows[at(place[at(nodes[own[a].node])])];
            for (std::size_t b = 0; b < n; ++b)
              // one triangle of it, so that the sum is symmetric to the last
              // bit
              row.block[blocks[own[a].node * nodes.size() + own[b].node]](
                own[a].component, own[b].component) +=
                matrix[std::max(a, b) * n + std::min(a, b)];
          }
        for (const int i : nodes)
          if (--left[at(i)] == 0)
            {
              take(i, rows[at(place[at(i)])]);
              close(i);
            }
      }

      /** The same for nodes without elements. */
      template <typename Take>
      void
      finish(const Take &take)
      {
        Row row;
        for (std::size_t i = 0; i < place.size(); ++i)
          if (place[i] == none)
            {
              row.clear();
              row[static_cast<int>(i)];
              take(static_cast<int>(i), row);
            }
      }

    private:
      static constexpr int none = -1, gone = -2;

      /** Of the unknowns of an element. */
      struct Place
      {
        std::size_t node; ///< among `nodes`
        int         component;
      };

      /** Each once. */
      void
      find_nodes(const std::vector<Index> &unknowns)
      {
        nodes.clear();
        own.clear();
        for (const Index q : unknowns)
          {
            const int i  = places[at(q)] / block;
            auto      it = std::find(nodes.begin(), nodes.end(), i);
            if (it == nodes.end())
              it = nodes.insert(it, i);
            own.push_back({static_cast<std::size_t>(it - nodes.begin()),
                           places[at(q)] % block});
          }
      }
      Row &
      open(const int i)
      {
        int &to = place[at(i)];
        if (to == none && unused.empty())
          {
            to = static_cast<int>(rows.size());
            rows.emplace_back();
          }
        else if (to == none)
          {
            to = unused.back();
            unused.pop_back();
          }
        return rows[at(to)];
      }
      void
      close(const int i)
      {
        rows[at(place[at(i)])].clear();
        unused.push_back(place[at(i)]);
        place[at(i)] = gone;
      }

      const std::vector<int> &places;
      std::vector<int>        left;  ///< elements of each node that come yet
      std::vector<int>        place; ///< of its row
      std::vector<Row>        rows;
      std::vector<int>        unused; ///< of them
      // of an element
      std::vector<int>   nodes;
      std::vector<Place> own;
      std::vector<std::size_t>
        blocks; ///< of rows, a row of places for each node
    };

    /** Rows on their way to the process that has them. */
    template <int block>
    class Parcel
    {
    public:
      void
      add(const int                  i,
          const std::vector<int>    &its_columns,
          const std::vector<double> &its_numbers)
      {
        row.push_back(i);
        length.push_back(static_cast<int>(its_columns.size()));
        columns.insert(columns.end(), its_columns.begin(), its_columns.end());
        numbers.insert(numbers.end(), its_numbers.begin(), its_numbers.end());
      }
      bool
      is_empty() const
      {
        return row.empty();
      }
      bool
      is_full() const
      {
        constexpr std::size_t many = 1 << 20;
        return numbers.size() > many;
      }
      /** It is empty then; an empty one is the last. */
      void
      send(const int to, const Communicator &processes)
      {
        processes.send(row, to);
        if (is_empty())
          return;
        processes.send(length, to);
        processes.send(columns, to);
        processes.send(numbers, to);
        row.clear();
        length.clear();
        columns.clear();
        numbers.clear();
      }
      /** False: that was the last one. */
      bool
      receive(const Communicator &processes)
      {
        row = processes.receive<int>(0);
        if (row.empty())
          return false;
        length  = processes.receive<int>(0);
        columns = processes.receive<int>(0);
        numbers = processes.receive<double>(0);
        return true;
      }
      void
      unpack(RowByRow<block, block, double> &matrix,
             std::vector<int>               &rows) const
      {
        std::vector<double> its_numbers;
        std::size_t         k = 0;
        for (const int n : length)
          {
            const double *const from = numbers.data() + k * block * block;
            its_numbers.assign(from, from + at(n) * block * block);
            matrix.append(columns.data() + k, at(n), its_numbers);
            k += at(n);
          }
        rows.insert(rows.end(), row.begin(), row.end());
      }

    private:
      std::vector<int>    row, length, columns;
      std::vector<double> numbers;
    };

    /** Own rows, in the order in which they come. */
    template <int block>
    struct OwnRows
    {
      RowByRow<block, block, double> matrix{true};
      std::vector<int>               number;
    };

    /** The first process makes all rows. */
    template <int block>
    void
    deal_rows(const WholeSystem      &whole,
              const std::vector<int> &first,
              const Communicator     &processes,
              OwnRows<block>         &own)
    {
      std::vector<Parcel<block>> parcels(at(processes.size()));
      std::vector<int>           columns;
      std::vector<double>        numbers;
      const auto take = [&](const int i, const GrowingRow<block, block> &row) {
        columns.clear();
        numbers.clear();
        row.append_to(columns, numbers);
        const auto p = std::upper_bound(first.begin(), first.end(), i * block) -
                       first.begin() - 1;
        const int number = i - first[at(p)] / block;
        if (p == 0)
          {
            own.matrix.append(columns.data(), columns.size(), numbers);
            own.number.push_back(number);
            return;
          }
        Parcel<block> &parcel = parcels[at(p)];
        parcel.add(number, columns, numbers);
        if (parcel.is_full())
          parcel.send(static_cast<int>(p), processes);
      };
      OpenRows<block> open(whole.for_each_element,
                           whole.places,
                           first.back() / block);
      whole.for_each_element(
        [&](const std::vector<Index> &unknowns, const double *matrix) {
          open.add(unknowns, matrix, take);
        });
      open.finish(take);
      for (int p = 1; p < processes.size(); ++p)
        {
          if (!parcels[at(p)].is_empty())
            parcels[at(p)].send(p, processes);
          parcels[at(p)].send(p, processes); // the last one
        }
    }

    template <int block>
    BlockMatrix<block, block, double>
    make_rows(const WholeSystem      &whole,
              const std::vector<int> &first,
              const Communicator     &processes)
    {
      OwnRows<block> own;
      if (processes.rank() == 0)
        deal_rows<block>(whole, first, processes, own);
      else
        for (Parcel<block> parcel; parcel.receive(processes);)
          parcel.unpack(own.matrix, own.number);
      return own.matrix.finish(own.number);
    }

    /** Laws of all contact nodes as numbers, one behind the other. */
    std::vector<double>
    to_numbers(const std::vector<NodeLaw> &laws)
    {
      std::vector<double> x;
      for (const NodeLaw &law : laws)
        {
          x.insert(x.end(), law.p.data(), law.p.data() + law.p.size());
          x.insert(x.end(), law.d.data(), law.d.data() + law.d.size());
          x.insert(x.end(), law.h.data(), law.h.data() + law.h.size());
        }
      return x;
    }

    NodeLaw
    to_law(const double *x, const Index n)
    {
      using Square = Eigen::Map<const Eigen::MatrixXd>;
      NodeLaw law;
      law.p = Square(x, n, n);
      law.d = Square(x + n * n, n, n);
      law.h = Eigen::Map<const Eigen::VectorXd>(x + 2 * n * n, n);
      return law;
    }

    /** The unknowns of contact nodes of each process, and where their laws
     * begin among those of all. */
    struct ContactShare
    {
      std::vector<std::vector<int>> places;
      std::vector<std::size_t>      law;
    };

    /** Contact nodes as numbers: where its law is, how many places, which. */
    std::vector<std::vector<int>>
    contact_numbers(const std::vector<std::vector<int>> &contact,
                    const std::vector<int>              &first)
    {
      std::vector<std::vector<int>> numbers(first.size() - 1);
      int                           law = 0;
      for (const std::vector<int> &node : contact)
        {
          const int  n = static_cast<int>(node.size());
          const auto owner =
            at(std::upper_bound(first.begin(), first.end(), node.at(0)) -
               first.begin() - 1);
          std::vector<int> &list = numbers[owner];
          list.push_back(law);
          list.push_back(n);
          for (const int p : node)
            list.push_back(p - first[owner]);
          law += 2 * n * n + n;
        }
      return numbers;
    }

    ContactShare
    read_contact(const std::vector<int> &numbers)
    {
      ContactShare share;
      for (auto it = numbers.begin(); it != numbers.end();)
        {
          share.law.push_back(at(*it++));
          const int n = *it++;
          share.places.emplace_back(it, it + n);
          it += n;
        }
      return share;
    }

    ContactShare
    deal_contact(const std::vector<std::vector<int>> &contact,
                 const std::vector<int>              &first,
                 const Communicator                  &processes)
    {
      if (processes.rank() > 0)
        return read_contact(processes.receive<int>(0));
      const auto numbers = contact_numbers(contact, first);
      for (int p = 1; p < processes.size(); ++p)
        processes.send(numbers[at(p)], p);
      return read_contact(numbers[0]);
    }

    template <int block>
    class Shared : public SharedSystem
    {
    public:
      Shared(WholeSystem &whole, const Communicator &p)
        : processes(p)
      {
        first = whole.first;
        processes.broadcast(first);
        ContactShare contact = deal_contact(whole.contact, first, processes);
        laws_begin           = std::move(contact.law);
        for (const std::vector<int> &node : contact.places)
          sizes.push_back(static_cast<Index>(node.size()));
        BlockShare<block> share;
        share.processes = processes;
        share.first     = first;
        share.contact   = std::move(contact.places);
        share.surface   = deal_surface(std::move(whole.surface));
        share.exists    = deal_places(whole.places);
        share.modes     = deal_modes(std::move(whole.modes));
        share.K         = make_rows<block>(whole, first, processes);
        system = std::make_unique<const BlockSystem<block>>(std::move(share));
      }

      Array
      multiply(Array x) const override
      {
        const Array own = processes.scatter(std::move(x), first);
        return processes.gather(system->multiply(own), first);
      }
      Array
      diagonal() const override
      {
        return processes.gather(system->diagonal(), first);
      }
      Step
      solve(const std::vector<NodeLaw> &laws,
            Array                       f,
            const Precision            &precision) const override
      {
        std::vector<double> asked = {precision.relative, precision.forces};
        processes.broadcast(asked);
        const Array own = processes.scatter(std::move(f), first);
        Step step = system->solve(deal_laws(laws), own, {asked[0], asked[1]});
        step.du   = processes.gather(step.du, first);
        return step;
      }

    private:
      /** 1 where there is an unknown. */
      Array
      deal_places(const std::vector<int> &places) const
      {
        Array exists;
        if (processes.rank() == 0)
          exists = Array::Zero(first.back());
        for (const int p : places)
          exists[p] = 1;
        return processes.scatter(std::move(exists), first);
      }
      /** Nodes of all processes. */
      std::vector<int>
      deal_surface(std::vector<int> places) const
      {
        processes.broadcast(places);
        for (int &p : places)
          p /= block;
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
      }
      Eigen::MatrixXd
      deal_modes(Eigen::MatrixXd modes) const
      {
        if (processes.size() == 1)
          return modes;
        const auto      own     = at(processes.rank());
        constexpr int   n_modes = 3 * (block - 1);
        Eigen::MatrixXd part(first[own + 1] - first[own], n_modes);
        for (Index j = 0; j < n_modes; ++j)
          part.col(j) = processes.scatter(
            processes.rank() == 0 ? Array(modes.col(j)) : Array(), first);
        return part;
      }
      std::vector<NodeLaw>
      deal_laws(const std::vector<NodeLaw> &laws) const
      {
        if (processes.size() == 1)
          return laws;
        std::vector<double> numbers = to_numbers(laws);
        processes.broadcast(numbers);
        std::vector<NodeLaw> own;
        for (std::size_t i = 0; i < sizes.size(); ++i)
          own.push_back(to_law(numbers.data() + laws_begin[i], sizes[i]));
        return own;
      }

      const Communicator                        processes;
      std::vector<int>                          first;
      std::vector<std::size_t>                  laws_begin;
      std::vector<Index>                        sizes; ///< of own contact nodes
      std::unique_ptr<const BlockSystem<block>> system;
    };
  } // namespace



  std::unique_ptr<SharedSystem>
  share_system(WholeSystem       &&whole,
               const unsigned int  dim,
               const Communicator &processes)
  {
    if (dim == 2)
      return std::make_unique<Shared<2>>(whole, processes);
    return std::make_unique<Shared<3>>(whole, processes);
  }
} // namespace conetact::backends
