// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/element_rows.h"

#include "conetact/base/index.h"
#include "conetact/base/partition.h"

#include <algorithm>

namespace conetact::iterative
{
  namespace
  {
    using Eigen::Index;

    /** Where the unknowns of an element are. */
    template <int block>
    struct ElementNodes
    {
      struct Own
      {
        std::size_t node; ///< among `nodes`
        int         component;
      };
      std::vector<int> nodes; ///< of all, each once
      std::vector<Own> own;   ///< of each unknown, unless it is whole
      /** Nodes bring all their unknowns, one behind the other. */
      bool is_whole = false;

      void
      find(const std::vector<int> &places)
      {
        nodes.clear();
        own.clear();
        is_whole = brings_whole_nodes(places);
        if (is_whole)
          for (std::size_t k = 0; k < places.size(); k += block)
            nodes.push_back(places[k] / block);
        else
          for (const int p : places)
            {
              const int i  = p / block;
              auto      it = std::find(nodes.begin(), nodes.end(), i);
              if (it == nodes.end())
                it = nodes.insert(it, i);
              own.push_back(
                {static_cast<std::size_t>(it - nodes.begin()), p % block});
            }
      }

    private:
      static bool
      brings_whole_nodes(const std::vector<int> &places)
      {
        if (places.size() % block != 0)
          return false;
        for (std::size_t k = 0; k < places.size(); ++k)
          {
            const int c = static_cast<int>(k % block);
            if (places[k] % block != c ||
                places[k] != places[k - k % block] + c)
              return false;
          }
        return true;
      }
    };

    /**
     * Rows of own nodes, to which elements add one by one. A row is handed on
     * as soon as the last element of its node has come, so that few are open at
     * a time.
     */
    template <int block>
    class OpenRows
    {
    public:
      using Row = GrowingRow<block, block>;

      /** Of nodes first_node, ...: how many elements each has. */
      OpenRows(std::vector<int> elements_of_nodes, const int first_node)
        : first(first_node)
        , left(std::move(elements_of_nodes))
        , place(left.size(), none)
      {}

      /** Calls take(number among own nodes, row) for what is complete. */
      template <typename Take>
      void
      add(const std::vector<int> &places,
          const double           *matrix,
          const Take             &take)
      {
        element.find(places);
        const std::size_t n_nodes = element.nodes.size();
        for (std::size_t i = 0; i < n_nodes; ++i)
          {
            const int own = element.nodes[i] - first;
            if (own < 0 || at(own) >= left.size())
              continue;
            Row &row = open(own);
            blocks.clear();
            for (const int j : element.nodes)
              blocks.push_back(row.find(j));
            if (element.is_whole)
              add_blocks(i, places.size(), matrix, row);
            else
              add_numbers(i, matrix, row);
            if (--left[at(own)] == 0)
              {
                take(own, row);
                close(own);
              }
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
              const int own = static_cast<int>(i);
              row.clear();
              row[first + own];
              take(own, row);
            }
      }

    private:
      static constexpr int none = -1, gone = -2;

      /* One triangle of the matrix, so that the sum is symmetric to the last
         bit. */
      void
      add_blocks(const std::size_t i,
                 const std::size_t n,
                 const double     *matrix,
                 Row              &row) const
      {
        using Rows      = Eigen::Matrix<double, block, block, Eigen::RowMajor>;
        using Stride    = Eigen::OuterStride<>;
        const auto part = [&](const std::size_t a, const std::size_t b) {
          return Eigen::Map<const Rows, 0, Stride>(
            matrix + block * (a * n + b), Stride(static_cast<Index>(n)));
        };
        for (std::size_t j = 0; j < blocks.size(); ++j)
          {
            auto &to = row.block[blocks[j]];
            if (j < i)
              to += part(i, j);
            else if (j > i)
              to += part(j, i).transpose();
            else
              to += Rows(part(i, i).template selfadjointView<Eigen::Lower>());
          }
      }
      void
      add_numbers(const std::size_t i, const double *matrix, Row &row) const
      {
        const std::size_t n = element.own.size();
        for (std::size_t a = 0; a < n; ++a)
          if (const auto &[node, c] = element.own[a]; node == i)
            for (std::size_t b = 0; b < n; ++b)
              row.block[blocks[element.own[b].node]](
                c, element.own[b].component) +=
                matrix[std::max(a, b) * n + std::min(a, b)];
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

      const int        first;
      std::vector<int> left;  ///< elements of each node that come yet
      std::vector<int> place; ///< of its row
      std::vector<Row> rows;
      std::vector<int> unused; ///< of them
      // of an element
      ElementNodes<block>      element;
      std::vector<std::size_t> blocks; ///< of a row, one for each node
    };

    /** Elements on their way to a process that has nodes of them. */
    class Parcel
    {
    public:
      void
      add(const std::vector<int> &its_places, const double *matrix)
      {
        const std::size_t n = its_places.size();
        size.push_back(static_cast<int>(n));
        places.insert(places.end(), its_places.begin(), its_places.end());
        // Neighbours are often congruent.
        const bool is_new =
          last_size != n * n ||
          !std::equal(matrix, matrix + n * n, numbers.end() - n_last());
        has_matrix.push_back(is_new ? 1 : 0);
        if (!is_new)
          return;
        numbers.insert(numbers.end(), matrix, matrix + n * n);
        last_size = n * n;
      }
      bool
      is_empty() const
      {
        return size.empty();
      }
      bool
      is_full() const
      {
        constexpr std::size_t many = 1 << 20;
        return numbers.size() + places.size() > many;
      }
      /** It is empty then; an empty one is the last. */
      void
      send(const int to, const Communicator &processes)
      {
        processes.send(size, to);
        if (is_empty())
          return;
        processes.send(has_matrix, to);
        processes.send(places, to);
        processes.send(numbers, to);
        *this = {};
      }
      /** False: that was the last one. */
      bool
      receive(const Communicator &processes)
      {
        size = processes.receive<int>(0);
        if (is_empty())
          return false;
        has_matrix = processes.receive<char>(0);
        places     = processes.receive<int>(0);
        numbers    = processes.receive<double>(0);
        return true;
      }
      /** Calls visit(places, matrix) for all. */
      template <typename Visit>
      void
      for_each(const Visit &visit) const
      {
        std::vector<int> own;
        auto             next   = places.begin();
        const double    *matrix = numbers.data(), *behind = matrix;
        for (std::size_t e = 0; e < size.size(); ++e)
          {
            own.assign(next, next + size[e]);
            next += size[e];
            if (has_matrix[e] != 0)
              {
                matrix = behind;
                behind += own.size() * own.size();
              }
            visit(own, matrix);
          }
      }

    private:
      std::ptrdiff_t
      n_last() const
      {
        return static_cast<std::ptrdiff_t>(last_size);
      }

      std::vector<int>    size;       ///< unknowns of each
      std::vector<char>   has_matrix; ///< 0: that of the one before
      std::vector<int>    places;
      std::vector<double> numbers;
      std::size_t         last_size = 0; ///< of the last matrix
    };

    /** Elements as the first process knows them, in places. */
    class PlacedElements
    {
    public:
      PlacedElements(const Elements         &e,
                     const std::vector<int> &p,
                     const std::vector<int> &f)
        : elements(e)
        , places(p)
        , first(f)
      {}
      template <typename Visit>
      void
      for_each(const Visit &visit) const
      {
        std::vector<int> own;
        elements.for_each(
          [&](const std::vector<Index> &unknowns, const double *matrix) {
            find_places(unknowns, own);
            visit(own, matrix);
          });
      }
      /** Of all nodes. */
      template <int block>
      std::vector<int>
      elements_of_nodes() const
      {
        std::vector<int>    count(at(first.back() / block), 0);
        ElementNodes<block> element;
        std::vector<int>    own;
        elements.for_each_connection([&](const std::vector<Index> &unknowns) {
          find_places(unknowns, own);
          element.find(own);
          for (const int i : element.nodes)
            ++count[at(i)];
        });
        return count;
      }
      void
      send(const Communicator &processes) const
      {
        if (processes.size() == 1)
          return;
        std::vector<Parcel> parcels(at(processes.size()));
        std::vector<int>    owners;
        for_each([&](const std::vector<int> &own, const double *matrix) {
          find_owners(own, owners);
          for (const int p : owners)
            {
              Parcel &parcel = parcels[at(p)];
              parcel.add(own, matrix);
              if (parcel.is_full())
                parcel.send(p, processes);
            }
        });
        for (int p = 1; p < processes.size(); ++p)
          {
            if (!parcels[at(p)].is_empty())
              parcels[at(p)].send(p, processes);
            parcels[at(p)].send(p, processes); // the last one
          }
      }

    private:
      void
      find_places(const std::vector<Index> &unknowns,
                  std::vector<int>         &own) const
      {
        own.clear();
        for (const Index q : unknowns)
          own.push_back(places[at(q)]);
      }
      /** Processes but the first that have unknowns of an element. */
      void
      find_owners(const std::vector<int> &own, std::vector<int> &owners) const
      {
        owners.clear();
        for (const int place : own)
          if (place >= first[1])
            {
              const int p = owner_of(place, first);
              if (std::find(owners.begin(), owners.end(), p) == owners.end())
                owners.push_back(p);
            }
      }

      const Elements         &elements;
      const std::vector<int> &places, &first;
    };
  } // namespace



  template <int block>
  BlockMatrix<block, block, double>
  rows_of_elements(const Elements         &elements,
                   const std::vector<int> &places,
                   const std::vector<int> &first,
                   const Communicator     &processes)
  {
    std::vector<int> first_node;
    for (const int place : first)
      first_node.push_back(place / block);
    const PlacedElements placed(elements, places, first);
    const bool           has_elements = processes.rank() == 0;
    Eigen::VectorXi      count;
    if (has_elements)
      {
        const auto all = placed.elements_of_nodes<block>();
        count =
          Eigen::Map<const Eigen::VectorXi>(all.data(),
                                            static_cast<Index>(all.size()));
      }
    count = processes.scatter(std::move(count), first_node);

    RowByRow<block, block, double> matrix(true);
    std::vector<int>               number, columns;
    std::vector<double>            numbers;
    const auto take = [&](const int i, const GrowingRow<block, block> &row) {
      columns.clear();
      numbers.clear();
      row.append_to(columns, numbers);
      matrix.append(columns.data(), columns.size(), numbers);
      number.push_back(i);
    };
    OpenRows<block> rows({count.begin(), count.end()},
                         first_node[at(processes.rank())]);
    const auto add = [&](const std::vector<int> &own, const double *element) {
      rows.add(own, element, take);
    };
    if (has_elements)
      {
        // The others first: they have begun, then.
        placed.send(processes);
        placed.for_each(add);
      }
    else
      for (Parcel parcel; parcel.receive(processes);)
        parcel.for_each(add);
    rows.finish(take);
    return matrix.finish(number);
  }

  template BlockMatrix<2, 2, double>
  rows_of_elements<2>(const Elements         &elements,
                      const std::vector<int> &places,
                      const std::vector<int> &first,
                      const Communicator     &processes);
  template BlockMatrix<3, 3, double>
  rows_of_elements<3>(const Elements         &elements,
                      const std::vector<int> &places,
                      const std::vector<int> &first,
                      const Communicator     &processes);
} // namespace conetact::iterative
