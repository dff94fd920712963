// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_halo_h
#define conetact_iterative_halo_h

#include "conetact/base/communicator.h"

#include <memory>
#include <vector>

namespace conetact::iterative
{
  /**
   * Which blocks of a vector this process sees of others, and they of it. Each
   * process has blocks first[p], ..., first[p+1]-1 of all.
   */
  class HaloPlan
  {
  public:
    /** Each process says which blocks of others it needs: ascending. */
    HaloPlan(const std::vector<int> &needed,
             const std::vector<int> &first,
             const Communicator     &processes);

    /** What goes to and comes from another process. */
    struct Side
    {
      int              rank;
      std::vector<int> sent; ///< blocks, as this process numbers its own
      int              first_received, n_received; ///< among those needed
    };
    std::vector<Side> sides;
    int               n_needed;
    MPI_Comm          comm;
  };

  /** Sends blocks of `size` numbers as a plan says. */
  template <int size, typename Number>
  class Halo
  {
  public:
    Halo() = default;
    explicit Halo(std::shared_ptr<const HaloPlan> p)
      : plan(std::move(p))
    {
      std::size_t sent = 0;
      for (const HaloPlan::Side &side : plan->sides)
        sent += side.sent.size();
      near.resize(sent * size);
      far.resize(static_cast<std::size_t>(plan->n_needed) * size);
    }
    const std::shared_ptr<const HaloPlan> &
    its_plan() const
    {
      return plan;
    }

    /** Begins to bring what others have of x. */
    void
    start(const Number *x)
    {
      Number *to = near.data();
      for (const HaloPlan::Side &side : plan->sides)
        {
          receive(side,
                  far.data() + side.first_received * size,
                  incoming(side));
          Number *const begin = to;
          for (const int i : side.sent)
            for (int c = 0; c < size; ++c)
              *to++ = x[static_cast<std::ptrdiff_t>(i) * size + c];
          send(side, begin, static_cast<int>(to - begin));
        }
    }
    /** The blocks needed, one behind the other. */
    const Number *
    finish()
    {
      wait();
      return far.data();
    }

    /** The way back: room for what goes to the blocks of others. */
    Number *
    far_blocks()
    {
      return far.data();
    }
    void
    start_back()
    {
      Number *to = near.data();
      for (const HaloPlan::Side &side : plan->sides)
        {
          const int n = static_cast<int>(side.sent.size()) * size;
          receive(side, to, n);
          to += n;
          send(side, far.data() + side.first_received * size, incoming(side));
        }
    }
    /** Adds what others sent to x. */
    void
    finish_back(Number *x)
    {
      wait();
      const Number *from = near.data();
      for (const HaloPlan::Side &side : plan->sides)
        for (const int i : side.sent)
          for (int c = 0; c < size; ++c)
            x[static_cast<std::ptrdiff_t>(i) * size + c] += *from++;
    }

  private:
    static int
    incoming(const HaloPlan::Side &side)
    {
      return side.n_received * size;
    }
    static int
    bytes(const int n)
    {
      return n * static_cast<int>(sizeof(Number));
    }
    void
    receive(const HaloPlan::Side &side, Number *to, const int n)
    {
      if (n > 0)
        MPI_Irecv(to,
                  bytes(n),
                  MPI_BYTE,
                  side.rank,
                  1,
                  plan->comm,
                  &requests.emplace_back());
    }
    void
    send(const HaloPlan::Side &side, const Number *from, const int n)
    {
      if (n == 0)
        return;
      traffic().add_message(static_cast<std::size_t>(bytes(n)));
      MPI_Isend(from,
                bytes(n),
                MPI_BYTE,
                side.rank,
                1,
                plan->comm,
                &requests.emplace_back());
    }
    void
    wait()
    {
      Communicator::wait(requests);
    }

    std::shared_ptr<const HaloPlan> plan;
    std::vector<Number>             near, far; ///< own blocks, those needed
    std::vector<MPI_Request>        requests;
  };
} // namespace conetact::iterative

#endif
