// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/contact_change.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace conetact::iterative
{
  namespace
  {
    /** Pairs of all processes, each once, in ascending order; sorted before
     * they are sent, as most of them come many times. */
    std::vector<std::pair<int, int>>
    gather_pairs(std::vector<std::pair<int, int>> pairs,
                 const Communicator              &processes)
    {
      const auto sort = [&] {
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      };
      sort();
      if (processes.size() == 1)
        return pairs;
      Eigen::VectorXi numbers(2 * static_cast<Eigen::Index>(pairs.size()));
      Eigen::Index    k = 0;
      for (const auto &[i, j] : pairs)
        {
          numbers[k++] = i;
          numbers[k++] = j;
        }
      numbers = processes.gather_all(numbers);
      pairs.clear();
      for (k = 0; k < numbers.size(); k += 2)
        pairs.emplace_back(numbers[k], numbers[k + 1]);
      sort();
      return pairs;
    }

    /** Products of one block with many: most of the work of a change. */
    template <int size>
    class BlockProducts
    {
    public:
      using Block = Eigen::Matrix<float, size, size>;

      /** The factor has room for some numbers behind it. */
      void
      make(const float *factor, const float *blocks, const std::size_t n)
      {
        results.resize(n * Block::SizeAtCompileTime + lanes(size));
        multiply_blocks<size>(factor, blocks, n, results.data());
      }
      template <typename Factor>
      void
      make_transposed(const Factor     &factor,
                      const float      *blocks,
                      const std::size_t n)
      {
        float transposed[Block::SizeAtCompileTime + lanes(size)] = {};
        Eigen::Map<Block>(transposed, size, size) = factor.transpose();
        make(transposed, blocks, n);
      }
      Eigen::Map<const Block>
      operator[](const std::size_t k) const
      {
        return Eigen::Map<const Block>(results.data() +
                                       k * Block::SizeAtCompileTime);
      }

    private:
      std::vector<float> results;
    };

    /** A row of blocks, in the order in which their columns come. */
    template <int size>
    class BlockRow
    {
    public:
      explicit BlockRow(const int n_columns)
        : place(at(n_columns), none)
      {}
      void
      clear()
      {
        for (const int c : of_blocks)
          place[at(c)] = none;
        of_blocks.clear();
        numbers.clear();
      }
      template <typename Block>
      void
      add(const int column, const Block &block)
      {
        std::size_t &k = place[at(column)];
        if (k == none)
          {
            k = of_blocks.size();
            of_blocks.push_back(column);
            numbers.insert(numbers.end(), block.data(), block.data() + n);
          }
        else
          Eigen::Map<Eigen::Matrix<float, size, size>>(numbers.data() +
                                                       k * n) += block;
      }
      const std::vector<int> &
      columns() const
      {
        return of_blocks;
      }
      const float *
      values() const
      {
        return numbers.data();
      }
      /** Blocks by ascending columns. */
      std::vector<std::size_t>
      order() const
      {
        std::vector<std::size_t> sorted(of_blocks.size());
        std::iota(sorted.begin(), sorted.end(), std::size_t(0));
        std::sort(sorted.begin(),
                  sorted.end(),
                  [&](const auto a, const auto b) {
                    return of_blocks[a] < of_blocks[b];
                  });
        return sorted;
      }

    private:
      static constexpr std::size_t n = size * size, none = -1;

      std::vector<std::size_t> place; ///< of columns
      std::vector<int>         of_blocks;
      std::vector<float>       numbers;
    };
  } // namespace



  /* Rows of P are fetched for the neighbours of contact nodes, for A P; kept
     are those of contact nodes. P^T (A' - A) P can have blocks (a, b) and
     (b, a) only where row i of P has a and row i of A P has b for some contact
     node i: this pattern serves every state, and is found once. */
  template <int fine, int coarse>
  ContactChange<fine, coarse>::ContactChange(
    const DistributedMatrix<fine, fine, float>   &A,
    const std::vector<int>                       &nodes,
    const std::vector<int>                       &first,
    const DistributedMatrix<fine, coarse, float> &prolongator,
    const Communicator                           &p)
    : processes(p)
  {
    AssertDimension(first.size(), at(processes.size()) + 1);
    const int        begin = first[at(processes.rank())];
    std::vector<int> numbers, near;
    for (const int i : nodes)
      {
        numbers.push_back(begin + i);
        A.for_row(at(i), [&](const int column, const auto &) {
          near.push_back(A.number_of_column(column));
        });
      }
    contact = gather_numbers(numbers, processes);
    find_rows(A,
              nodes,
              begin,
              {prolongator, gather_numbers(near, processes), begin, processes});
    P = {prolongator, contact, begin, processes};

    typename Rows::Pattern pairs;
    for (std::size_t i = 0; i < own.size(); ++i)
      P.for_row(own[i].place, [&](const int a, const auto &) {
        AP.for_row(i, [&](const int b, const auto &) {
          pairs.emplace_back(a, b);
          pairs.emplace_back(b, a);
        });
      });
    first_change = Rows(gather_pairs(std::move(pairs), processes));
  }



  /* (A P)_i = sum_j A_ij P_j, with all contact nodes free: no state changes
     it. */
  template <int fine, int coarse>
  void
  ContactChange<fine, coarse>::find_rows(
    const DistributedMatrix<fine, fine, float> &A,
    const std::vector<int>                     &nodes,
    const int                                   begin,
    const SomeRows<fine, coarse>               &P_near)
  {
    for (const int i : nodes)
      {
        Node               node;
        std::map<int, Map> row;
        A.for_row(at(i), [&](const int column, const auto &block) {
          const int  j = A.number_of_column(column);
          const auto k = std::lower_bound(contact.begin(), contact.end(), j);
          if (j == begin + i)
            node.diagonal = block;
          if (k != contact.end() && *k == j)
            node.neighbours.emplace_back(k - contact.begin(), block);
          P_near.for_row(P_near.find(j), [&](const int c, const auto &of_j) {
            row.try_emplace(c, Map::Zero()).first->second += block * of_j;
          });
        });
        node.place = at(static_cast<int>(
          std::lower_bound(contact.begin(), contact.end(), begin + i) -
          contact.begin()));
        own.push_back(std::move(node));
        AP.number.push_back(begin + i);
        for (const auto &[column, block] : row)
          {
            AP.blocks.column.push_back(column);
            AP.blocks.value.insert(AP.blocks.value.end(),
                                   block.data(),
                                   block.data() + block.size());
          }
        AP.blocks.start.push_back(AP.blocks.column.size());
      }
  }



  /* The pattern of P^T C P, where C is the change of the level above. All
     processes have the whole pattern above and all rows of P that it needs, and
     so find the same without messages. */
  template <int fine, int coarse>
  void
  ContactChange<fine, coarse>::add_level(
    const DistributedMatrix<coarse, coarse, float> &prolongator,
    const int                                       begin,
    const Communicator                             &sharers)
  {
    const Rows &above = pattern(n_levels() - 1);
    Level       level;
    level.P = {prolongator, above.number, begin, sharers};
    typename Rows::Pattern pairs;
    std::vector<int>       columns;
    for (std::size_t i = 0; i < above.number.size(); ++i)
      {
        columns.clear();
        above.for_row(i, [&](const int j, const auto &) {
          level.P.for_row(level.P.find(j), [&](const int c, const auto &) {
            columns.push_back(c);
          });
        });
        std::sort(columns.begin(), columns.end());
        columns.erase(std::unique(columns.begin(), columns.end()),
                      columns.end());
        level.P.for_row(i, [&](const int a, const auto &) {
          for (const int b : columns)
            pairs.emplace_back(a, b);
        });
      }
    level.change = Rows(gather_pairs(std::move(pairs), Communicator()));
    levels.push_back(std::move(level));
  }



  /* G is a diagonal matrix, 1 where unknowns are held, D the diagonal of A, S
     what laws add, symmetric. With A' = (1 - G) A (1 - G) + G D + S
       A' - A = -G A - A G + G A G + G D + S = H + H^T,
       H = -G A + (G A G + G D + S) / 2.
     H has rows of contact nodes only: each process sums up P^T Y, Y = H P, of
     its own ones, and the transposed of the sum is added last. Held unknowns
     keep D, or coarse levels would see nothing that resists there. */
  template <int fine, int coarse>
  typename ContactChange<fine, coarse>::Rows
  ContactChange<fine, coarse>::first_level(
    const std::vector<NodeState<fine>> &states) const
  {
    Eigen::VectorXf held =
      Eigen::VectorXf::Zero(static_cast<Eigen::Index>(contact.size()) * fine);
    const auto held_at = [&](const std::size_t place) {
      return held.segment<fine>(static_cast<Eigen::Index>(place) * fine);
    };
    for (std::size_t i = 0; i < own.size(); ++i)
      held_at(own[i].place) = states[i].held;
    // Each place has one owner, and zeros of all others: the sum is what the
    // owner says. Neighbours across a border are needed for G A G.
    processes.sum(held.data(), held.size());

    Rows             result = first_change;
    std::vector<Map> Y;
    for (std::size_t i = 0; i < own.size(); ++i)
      {
        const auto add = [&](const std::size_t place, const FineBlock &a) {
          P.for_row(place, [&](const int column, const auto &block) {
            Y[AP.find(i, column) - AP.blocks.start[i]] += a * block;
          });
        };
        const auto G = states[i].held.asDiagonal();
        Y.clear();
        AP.for_row(i, [&](const int, const auto &block) {
          Y.push_back(-(G * block));
        });
        for (const auto &[place, block] : own[i].neighbours)
          if (const auto other = held_at(place); !other.isZero(0))
            add(place, .5f * (G * block * other.asDiagonal()));
        const FineBlock diagonal =
          states[i].held.cwiseProduct(own[i].diagonal.diagonal()).asDiagonal();
        add(own[i].place, .5f * (diagonal + states[i].added));
        P.for_row(own[i].place, [&](const int a, const auto &block) {
          const std::size_t row = result.find(a);
          std::size_t       k   = result.blocks.start[row];
          for (std::size_t j = 0; j < Y.size(); ++j)
            {
              // Columns ascend on both sides, and row a of the pattern has all
              // columns of this row of A P: one walk finds them.
              while (result.blocks.column[k] !=
                     AP.blocks.column[AP.blocks.start[i] + j])
                ++k;
              result.blocks.block(k) += block.transpose() * Y[j];
            }
        });
      }
    processes.sum(result.blocks.value.data(),
                  static_cast<Eigen::Index>(result.blocks.value.size()));
    for (std::size_t i = 0; i < result.number.size(); ++i)
      for (std::size_t k = result.blocks.start[i];
           k < result.blocks.start[i + 1];
           ++k)
        {
          const int j = result.blocks.column[k];
          if (j < result.number[i])
            continue;
          auto block = result.blocks.block(k);
          auto other =
            result.blocks.block(result.find(result.find(j), result.number[i]));
          // The sum is made first: on the diagonal both are one block.
          const CoarseBlock sum = block + other.transpose();
          block                 = sum;
          other                 = sum.transpose();
        }
    return result;
  }



  /* Rows are dealt out one by one, like cards: all processes have the whole of
     the level above, and about the same work with it. */
  template <int fine, int coarse>
  typename ContactChange<fine, coarse>::Rows
  ContactChange<fine, coarse>::projected(const Rows  &above,
                                         const Level &level) const
  {
    Rows             below = level.change;
    BlockRow<coarse> row(below.number.empty() ? 0 : below.number.back() + 1);
    BlockProducts<coarse> products;
    for (std::size_t i = at(processes.rank()); i < above.number.size();
         i += at(processes.size()))
      {
        row.clear();
        std::size_t of_j = 0; // columns ascend, as the rows of P do
        above.for_row(i, [&](const int j, const auto &C_ij) {
          while (level.P.number[of_j] != j)
            ++of_j;
          const auto       &all  = level.P.blocks;
          const std::size_t from = all.start[of_j],
                            n    = all.start[of_j + 1] - from;
          products.make(C_ij.data(), all.block(of_j, from).data(), n);
          for (std::size_t k = 0; k < n; ++k)
            row.add(all.column[from + k], products[k]);
        });
        const std::vector<std::size_t> order = row.order();
        level.P.for_row(i, [&](const int a, const auto &P_ia) {
          products.make_transposed(P_ia, row.values(), row.columns().size());
          // The pattern was made of the same rows of P: each (a, b) is in it,
          // and one walk finds all of them.
          std::size_t k = below.blocks.start[below.find(a)];
          for (const std::size_t l : order)
            {
              while (below.blocks.column[k] != row.columns()[l])
                ++k;
              below.blocks.block(k) += products[l];
            }
        });
      }
    processes.sum(below.blocks.value.data(),
                  static_cast<Eigen::Index>(below.blocks.value.size()));
    return below;
  }



  /* P^T C P from level to level: exactly what the coarse matrices of A' are
     more than those of A, as maps do not depend on the state. Work and messages
     grow with the contact surface, not with the body. */
  template <int fine, int coarse>
  std::vector<typename ContactChange<fine, coarse>::Rows>
  ContactChange<fine, coarse>::change(
    const std::vector<NodeState<fine>> &states) const
  {
    AssertDimension(states.size(), own.size());
    std::vector<Rows> result = {first_level(states)};
    for (const Level &level : levels)
      result.push_back(projected(result.back(), level));
    return result;
  }

  template class ContactChange<2, 3>;
  template class ContactChange<3, 6>;
} // namespace conetact::iterative
