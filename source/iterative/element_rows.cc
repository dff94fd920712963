// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/element_rows.h"

#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace conetact::iterative
{
  namespace
  {
    using Eigen::Index;

    /**
     * The nodes of an element, and where its unknowns are among them. Most
     * elements bring all unknowns of their nodes in order, and are added block
     * by block; those with a node of which some unknowns are missing are added
     * number by number.
     */
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
     * a time: those of a front through the mesh, if elements come in its order.
     * To keep all rows open would take the memory that equal rows save.
     */
    template <int block>
    class OpenRows
    {
    public:
      using Row = GrowingRow<block, block>;

      /** The nodes are first_node, ..., each of which has so many elements. */
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

      /** The same for nodes without elements: a diagonal block of zeros, for
       * each row has its diagonal (BlockSystem::diagonal_block()). */
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
      static constexpr int none = -1, gone = -2; ///< places of no row

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
      std::vector<int> left;  ///< elements that each node waits for
      std::vector<int> place; ///< of each node's row
      std::vector<Row> rows;
      std::vector<int> unused; ///< places of rows
      // The element at hand:
      ElementNodes<block>      element;
      std::vector<std::size_t> blocks; ///< of a row, one for each node
    };

    /**
     * Rows of a symmetric matrix in the order in which they come; numbers that
     * several of them have are kept once. Numbers stay where they are put: a
     * vector that grows takes up to three times their memory.
     */
    template <int block>
    class ArrivedRows
    {
    public:
      using Matrix = BlockMatrix<block, block, double>;

      /** Row i: its columns, and its blocks column by column. */
      void
      append(const int                  i,
             const std::vector<int>    &columns,
             const std::vector<double> &numbers)
      {
        if (at(i) >= place.size())
          place.resize(at(i) + 1);
        place[at(i)] = rows.size();
        rows.push_back({find(numbers), column.size()});
        column.insert(column.end(), columns.begin(), columns.end());
      }

      /**
       * The matrix, whose numbers are in the order of rows, too: products read
       * them one behind the other. Own columns begin at `begin`. If few rows
       * are like others, blocks of own columns left of the diagonal go.
       */
      Matrix
      matrix(const int begin) const
      {
        return 2 * n_numbers > column.size() * Matrix::block_size ?
                 upper(begin) :
                 whole();
      }

    private:
      struct Row
      {
        const double *numbers;
        std::size_t   first_column; ///< among `column`
      };

      const double *
      find(const std::vector<double> &numbers)
      {
        const std::size_t      n_bytes = numbers.size() * sizeof(double);
        const std::string_view bytes(
          reinterpret_cast<const char *>(numbers.data()), n_bytes);
        const auto found = known.find(bytes);
        if (found != known.end())
          return reinterpret_cast<const double *>(found->data());
        if (chunks.empty() ||
            chunks.back().size() + numbers.size() > chunks.back().capacity())
          chunks.emplace_back().reserve(std::max(numbers.size(), chunk));
        std::vector<double> &last = chunks.back();
        last.insert(last.end(), numbers.begin(), numbers.end());
        n_numbers += numbers.size();
        const double *const kept = last.data() + last.size() - numbers.size();
        known.emplace(reinterpret_cast<const char *>(kept), n_bytes);
        return kept;
      }
      std::size_t
      end_of(const std::size_t k) const
      {
        return k + 1 < rows.size() ? rows[k + 1].first_column : column.size();
      }
      Matrix
      whole() const
      {
        Matrix result;
        result.column.reserve(column.size());
        result.value.reserve(n_numbers + lanes(block));
        std::unordered_map<const double *, std::size_t> places;
        for (const std::size_t k : place)
          {
            const auto &[numbers, from] = rows[k];
            const std::size_t n         = end_of(k) - from;
            const auto [found, is_new] =
              places.emplace(numbers, result.value.size());
            if (is_new)
              result.value.insert(result.value.end(),
                                  numbers,
                                  numbers + n * Matrix::block_size);
            result.first.push_back(found->second);
            result.column.insert(result.column.end(),
                                 column.data() + from,
                                 column.data() + from + n);
            result.start.push_back(result.column.size());
          }
        result.value.resize(result.value.size() + lanes(block), 0.);
        return result;
      }
      Matrix
      upper(const int begin) const
      {
        Matrix result;
        result.is_upper = true;
        // Own columns right of a diagonal are those left of another one.
        std::size_t n_own = 0;
        for (const int j : column)
          n_own += is_own(j, begin) ? 1 : 0;
        const std::size_t n = column.size() - (n_own - rows.size()) / 2;
        result.column.reserve(n);
        result.value.reserve(n * Matrix::block_size + lanes(block));
        for (std::size_t i = 0; i < place.size(); ++i)
          {
            const auto &[numbers, from] = rows[place[i]];
            for (std::size_t l = from; l < end_of(place[i]); ++l)
              if (!is_own(column[l], begin) ||
                  column[l] >= begin + static_cast<int>(i))
                {
                  const double *const its =
                    numbers + (l - from) * Matrix::block_size;
                  result.column.push_back(column[l]);
                  result.value.insert(result.value.end(),
                                      its,
                                      its + Matrix::block_size);
                }
            result.start.push_back(result.column.size());
          }
        result.value.resize(result.value.size() + lanes(block), 0.);
        return result;
      }
      bool
      is_own(const int j, const int begin) const
      {
        return j >= begin && j < begin + static_cast<int>(place.size());
      }

      static constexpr std::size_t chunk = 1 << 20;

      std::vector<std::vector<double>>     chunks;
      std::unordered_set<std::string_view> known; ///< numbers of rows
      std::size_t                          n_numbers = 0;
      std::vector<Row>                     rows;
      std::vector<int>                     column;
      std::vector<std::size_t>             place; ///< of row i among `rows`
    };

    /** Elements in places, those that have some of this process. They are
     * gone through twice: first without matrices, to count those of nodes. */
    class PlacedElements
    {
    public:
      PlacedElements(const Elements         &e,
                     const std::vector<int> &p,
                     const int               own_begin,
                     const int               own_end)
        : elements(needed_for(own_unknowns(p, own_begin, own_end), e))
        , places(p)
        , begin(own_begin)
        , end(own_end)
      {}
      template <typename Visit>
      void
      for_each(const Visit &visit) const
      {
        std::vector<int> own;
        elements.for_each(
          [&](const std::vector<Index> &unknowns, const double *matrix) {
            if (find_places(unknowns, own))
              visit(own, matrix);
          });
      }
      /** Counts the elements of each own node. */
      template <int block>
      std::vector<int>
      elements_of_nodes() const
      {
        std::vector<int>    count(at((end - begin) / block), 0);
        ElementNodes<block> element;
        std::vector<int>    own;
        elements.for_each_connection([&](const std::vector<Index> &unknowns) {
          if (!find_places(unknowns, own))
            return;
          element.find(own);
          for (const int i : element.nodes)
            if (is_own(i * block))
              ++count[at(i - begin / block)];
        });
        return count;
      }

    private:
      static std::vector<bool>
      own_unknowns(const std::vector<int> &places,
                   const int               begin,
                   const int               end)
      {
        std::vector<bool> own;
        for (const int p : places)
          own.push_back(p >= begin && p < end);
        return own;
      }
      bool
      is_own(const int place) const
      {
        return place >= begin && place < end;
      }
      /** Finds the places of all unknowns of an element; true if one is own. */
      bool
      find_places(const std::vector<Index> &unknowns,
                  std::vector<int>         &found) const
      {
        bool any = false;
        found.clear();
        for (const Index q : unknowns)
          {
            found.push_back(places[at(q)]);
            any = any || is_own(found.back());
          }
        return any;
      }

      const Elements          elements;
      const std::vector<int> &places;
      const int               begin, end;
    };
  } // namespace



  /* Rows come in the order in which they are complete. Elements at the border
     are looked at by all processes that have nodes of them: no sums are sent.
   */
  template <int block>
  BlockMatrix<block, block, double>
  rows_of_elements(const Elements         &elements,
                   const std::vector<int> &places,
                   const int               begin,
                   const int               end)
  {
    Assert(0 <= begin && begin <= end && begin % block == 0 && end % block == 0,
           dealii::ExcMessage("Rows are those of whole nodes."));
    const PlacedElements placed(elements, places, begin, end);

    ArrivedRows<block>  arrived;
    std::vector<int>    columns;
    std::vector<double> numbers;
    const auto take = [&](const int i, const GrowingRow<block, block> &row) {
      columns.clear();
      numbers.clear();
      row.append_to(columns, numbers);
      arrived.append(i, columns, numbers);
    };
    { // what rows have needed is given back before they are put in order
      OpenRows<block> rows(placed.template elements_of_nodes<block>(),
                           begin / block);
      placed.for_each([&](const std::vector<int> &own, const double *element) {
        rows.add(own, element, take);
      });
      rows.finish(take);
    }
    return arrived.matrix(begin / block);
  }

  template BlockMatrix<2, 2, double>
  rows_of_elements<2>(const Elements         &elements,
                      const std::vector<int> &places,
                      const int               begin,
                      const int               end);
  template BlockMatrix<3, 3, double>
  rows_of_elements<3>(const Elements         &elements,
                      const std::vector<int> &places,
                      const int               begin,
                      const int               end);
} // namespace conetact::iterative
