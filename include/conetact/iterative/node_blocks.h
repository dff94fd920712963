// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_node_blocks_h
#define conetact_iterative_node_blocks_h

#include "conetact/iterative/block_matrix.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace conetact::iterative
{
  using FloatVector = Eigen::VectorXf;

  /** Numbers that stay in the cache, whole blocks of 2, 3 and 6; sums over so
   * many in single precision are exact enough. */
  constexpr Eigen::Index piece = 768;

  /** Calls f(begin, n) for all pieces of a vector. */
  template <typename F>
  void
  for_pieces(const FloatVector &x, const F &f)
  {
    for (Eigen::Index i = 0; i < x.size(); i += piece)
      f(i, std::min(piece, x.size() - i));
  }

  /**
   * A matrix D of a block for each node, such as the inverse of the diagonal
   * of a stiffness. Equal blocks are kept once: those of a regular mesh stay in
   * the cache.
   */
  template <int size>
  class NodeBlocks
  {
  public:
    using Block = Eigen::Matrix<float, size, size>;

    NodeBlocks() = default;
    explicit NodeBlocks(const std::vector<Block> &blocks)
    {
      EqualRows<float> known;
      for (const Block &block : blocks)
        place.push_back(static_cast<std::uint32_t>(
          known.place(block.data(), n_numbers, numbers)));
      n_shared = numbers.size();
      numbers.resize(n_shared + more);
    }

    std::size_t
    n_nodes() const
    {
      return place.size();
    }
    Eigen::Map<const Block>
    operator[](const std::size_t i) const
    {
      return Eigen::Map<const Block>(numbers.data() + place[i]);
    }
    /** Gives a node a block of its own. */
    void
    set(const std::size_t i, const Block &block)
    {
      if (place[i] < n_shared)
        {
          place[i] = static_cast<std::uint32_t>(numbers.size() - more);
          numbers.resize(numbers.size() + n_numbers);
        }
      std::copy_n(block.data(), n_numbers, numbers.data() + place[i]);
    }

    /**
     * Piece by piece: prepare(begin, n) may change r there, then use(begin, D
     * r) gets the product.
     */
    template <typename Prepare, typename Use>
    void
    for_products(const FloatVector &r,
                 const Prepare     &prepare,
                 const Use         &use) const
    {
      Eigen::Matrix<float, piece + more, 1> product;
      for_pieces(r, [&](const Eigen::Index begin, const Eigen::Index n) {
        prepare(begin, n);
        multiply(begin, n, r.data() + begin, product.data());
        use(begin, product.head(n));
      });
    }
    /** z = D r. */
    void
    multiply(const FloatVector &r, FloatVector &z) const
    {
      for_products(
        r,
        [](const Eigen::Index, const Eigen::Index) {},
        [&](const Eigen::Index begin, const auto &product) {
          z.segment(begin, product.size()) = product;
        });
    }

  private:
    static constexpr std::size_t n_numbers =
      static_cast<std::size_t>(size) * size;
    /** What is read and written too much where a column goes in fours. */
    static constexpr int more = lanes(size) - size;

    void
    multiply(const Eigen::Index begin,
             const Eigen::Index n,
             const float       *r,
             float             *z) const
    {
      using Lanes = Eigen::Array<float, lanes(size), 1>;
      for (Eigen::Index i = begin / size; i < (begin + n) / size; ++i)
        {
          const float *const a =
            numbers.data() + place[static_cast<std::size_t>(i)];
          Lanes sum = Eigen::Map<const Lanes>(a) * r[0];
          for (int c = 1; c < size; ++c)
            sum += Eigen::Map<const Lanes>(a + c * size) * r[c];
          // what is too much belongs to the next node
          Eigen::Map<Lanes> out(z);
          out = sum;
          r += size;
          z += size;
        }
    }

    std::vector<std::uint32_t> place; ///< of the block of each node
    std::vector<float>         numbers;
    std::size_t                n_shared = 0; ///< numbers of equal blocks
  };
} // namespace conetact::iterative

#endif
