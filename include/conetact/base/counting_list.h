// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_counting_list_h
#define conetact_base_counting_list_h

#include <cstddef>
#include <vector>

namespace conetact
{
  /**
   * A list of numbers that mostly go up by the same step from one to the next,
   * as numbers of unknowns do: it takes the memory of the places where they do
   * not.
   */
  class CountingList
  {
  public:
    void
    push_back(const int number)
    {
      if (!runs.empty() && n == runs.back().begin + 1)
        runs.back().step = number - runs.back().value;
      if (runs.empty() || runs.back().at(n) != number)
        runs.push_back({n, number, 0});
      if (n % block == 0)
        run_of_block.push_back(static_cast<unsigned int>(runs.size() - 1));
      ++n;
    }
    int
    operator[](const std::size_t i) const
    {
      std::size_t r = run_of_block[i / block];
      while (r + 1 < runs.size() && runs[r + 1].begin <= i)
        ++r;
      return runs[r].at(static_cast<unsigned int>(i));
    }
    std::size_t
    size() const
    {
      return n;
    }

  private:
    static constexpr unsigned int block = 64;

    /** Numbers value, value + step, ... from the place `begin` on. */
    struct Run
    {
      unsigned int begin;
      int          value, step;

      int
      at(const unsigned int i) const
      {
        return value + step * static_cast<int>(i - begin);
      }
    };
    std::vector<Run>          runs;
    std::vector<unsigned int> run_of_block; ///< of places 0, 64, 128, ...
    unsigned int              n = 0;
  };
} // namespace conetact

#endif
