// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/communicator.h"

#include "conetact/base/index.h"
#include "conetact/base/process.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <map>
#include <thread>

namespace conetact
{
  namespace
  {
    /** Bytes that go in one message, whose length is an int. */
    constexpr std::size_t longest_message = 1 << 30;

    // Who waits looks again at once, then whenever no other program wants the
    // core, later after an eighth of the time it has waited: a sleep takes 60
    // us at least, as long as a product.
    constexpr std::chrono::microseconds at_once{20}, briefly{500},
      longest_sleep{2000};

    void
    wait_for(const MPI_Request request)
    {
      std::vector<MPI_Request> requests = {request};
      Communicator::wait(requests);
    }

    /** Of this thread so far. */
    double
    cpu_seconds()
    {
      timespec t;
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
      return static_cast<double>(t.tv_sec) +
             1e-9 * static_cast<double>(t.tv_nsec);
    }

    bool
    are_done(std::vector<MPI_Request> &requests)
    {
      int done = 0;
      MPI_Testall(static_cast<int>(requests.size()),
                  requests.data(),
                  &done,
                  MPI_STATUSES_IGNORE);
      return done != 0;
    }

    /** So few, as those of GMRES, are added in the order of processes. */
    constexpr Eigen::Index few = 96;

    template <typename Number>
    void
    add_in_order(Number             *x,
                 const Eigen::Index  length,
                 MPI_Datatype        type,
                 const Communicator &processes)
    {
      const auto          n = static_cast<Eigen::Index>(processes.size());
      std::vector<Number> all(at(n * length));
      MPI_Request         request;
      MPI_Iallgather(x,
                     static_cast<int>(length),
                     type,
                     all.data(),
                     static_cast<int>(length),
                     type,
                     processes.handle(),
                     &request);
      wait_for(request);
      using Array = Eigen::Map<Eigen::Array<Number, Eigen::Dynamic, 1>>;
      Array sum(x, length);
      sum.setZero();
      for (Eigen::Index p = 0; p < n; ++p)
        sum += Array(all.data() + p * length, length);
    }

    template <typename Number>
    void
    add_up(Number             *x,
           const Eigen::Index  length,
           MPI_Datatype        type,
           const Communicator &processes)
    {
      if (processes.size() == 1 || length == 0)
        return;
      traffic().add_collective(at(length) * sizeof(Number));
      if (length <= few)
        return add_in_order(x, length, type, processes);
      MPI_Request request;
      MPI_Iallreduce(MPI_IN_PLACE,
                     x,
                     static_cast<int>(length),
                     type,
                     MPI_SUM,
                     processes.handle(),
                     &request);
      wait_for(request);
    }
  } // namespace



  Traffic &
  traffic()
  {
    static Traffic all;
    return all;
  }



  /* Each is made once, and ends with MPI. */
  Communicator
  Communicator::of_first(const int n)
  {
    Assert(n >= 1, dealii::ExcMessage("There is a process."));
    static std::map<int, MPI_Comm> made;
    Communicator                   result;
    result.n = n;
    MPI_Comm_rank(MPI_COMM_WORLD, &result.own);
    if (n == 1)
      return result;
    const auto [it, is_new] = made.emplace(n, MPI_COMM_NULL);
    if (is_new)
      MPI_Comm_split(MPI_COMM_WORLD,
                     result.own < n ? 0 : MPI_UNDEFINED,
                     result.own,
                     &it->second);
    result.comm = it->second;
    return result;
  }



  MPI_Comm
  Communicator::handle() const
  {
    if (n > 1)
      return comm;
    ProcessSession::require_mpi();
    return MPI_COMM_SELF;
  }



  double
  Communicator::sum(const double x) const
  {
    if (n == 1)
      return x;
    double result = x;
    sum(&result, 1);
    return result;
  }



  void
  Communicator::sum(double *x, const Eigen::Index length) const
  {
    add_up(x, length, MPI_DOUBLE, *this);
  }



  void
  Communicator::sum(float *x, const Eigen::Index length) const
  {
    add_up(x, length, MPI_FLOAT, *this);
  }



  void
  Communicator::wait(std::vector<MPI_Request> &requests)
  {
    using Clock         = std::chrono::steady_clock;
    const auto   start  = Clock::now();
    const double before = cpu_seconds();
    while (!are_done(requests))
      {
        const auto waited = Clock::now() - start;
        if (waited > briefly)
          std::this_thread::sleep_for(
            std::min<Clock::duration>(waited / 8, longest_sleep));
        else if (waited > at_once)
          std::this_thread::yield();
      }
    traffic().waited += cpu_seconds() - before;
    requests.clear();
  }



  Communicator::Counts
  Communicator::count(const Eigen::Index n_own) const
  {
    Assert(n_own <= std::numeric_limits<int>::max() / n,
           dealii::ExcMessage("An int counts the numbers of all."));
    Counts counts;
    counts.own = static_cast<int>(n_own);
    traffic().add_collective(sizeof(int));
    counts.length.resize(at(n));
    MPI_Request request;
    MPI_Iallgather(&counts.own,
                   1,
                   MPI_INT,
                   counts.length.data(),
                   1,
                   MPI_INT,
                   comm,
                   &request);
    wait_for(request);
    for (const int length : counts.length)
      {
        counts.start.push_back(counts.total);
        counts.total += length;
      }
    return counts;
  }



  void
  Communicator::gather_all(const void       *part,
                           void             *all,
                           const Counts     &counts,
                           const std::size_t bytes) const
  {
    traffic().add_collective(at(counts.own) * bytes);
    MPI_Datatype number;
    MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &number);
    MPI_Type_commit(&number);
    MPI_Request request;
    MPI_Iallgatherv(part,
                    counts.own,
                    number,
                    all,
                    counts.length.data(),
                    counts.start.data(),
                    number,
                    comm,
                    &request);
    wait_for(request);
    MPI_Type_free(&number);
  }



  void
  Communicator::broadcast(void *x, const std::size_t bytes) const
  {
    traffic().add_collective(own == 0 ? bytes : 0);
    for (std::size_t k = 0; k < bytes; k += longest_message)
      {
        MPI_Request request;
        MPI_Ibcast(static_cast<char *>(x) + k,
                   static_cast<int>(std::min(longest_message, bytes - k)),
                   MPI_BYTE,
                   0,
                   comm,
                   &request);
        wait_for(request);
      }
  }



  std::vector<std::vector<int>>
  Communicator::exchange(const std::vector<std::vector<int>> &lists) const
  {
    AssertDimension(lists.size(), at(n));
    std::vector<int> sent, received(at(n));
    for (const std::vector<int> &list : lists)
      sent.push_back(static_cast<int>(list.size()));
    traffic().add_collective(sent.size() * sizeof(int));
    MPI_Request request;
    MPI_Ialltoall(
      sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm, &request);
    wait_for(request);
    std::vector<std::vector<int>> result(at(n));
    std::vector<MPI_Request>      requests;
    for (int p = 0; p < n; ++p)
      {
        result[at(p)].resize(at(received[at(p)]));
        if (received[at(p)] > 0)
          MPI_Irecv(result[at(p)].data(),
                    received[at(p)],
                    MPI_INT,
                    p,
                    0,
                    comm,
                    &requests.emplace_back());
      }
    for (int p = 0; p < n; ++p)
      if (sent[at(p)] > 0)
        {
          traffic().add_message(lists[at(p)].size() * sizeof(int));
          MPI_Isend(lists[at(p)].data(),
                    sent[at(p)],
                    MPI_INT,
                    p,
                    0,
                    comm,
                    &requests.emplace_back());
        }
    wait(requests);
    return result;
  }
} // namespace conetact
