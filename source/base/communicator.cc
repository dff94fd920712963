// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/communicator.h"

#include "conetact/base/process.h"

#include <algorithm>
#include <map>

namespace conetact
{
  namespace
  {
    std::size_t
    at(const int i)
    {
      return static_cast<std::size_t>(i);
    }

    /** Bytes that go in one message, whose length is an int. */
    constexpr std::size_t longest = 1 << 30;
  } // namespace



  /* Each is made once, and ends with MPI. */
  Communicator
  Communicator::of_first(const int n)
  {
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
    double result = 0;
    MPI_Allreduce(&x, &result, 1, MPI_DOUBLE, MPI_SUM, comm);
    return result;
  }



  Communicator::Counts
  Communicator::count(const Eigen::Index own_bytes) const
  {
    Counts counts;
    counts.own = static_cast<int>(own_bytes);
    counts.length.resize(at(n));
    MPI_Allgather(
      &counts.own, 1, MPI_INT, counts.length.data(), 1, MPI_INT, comm);
    for (const int length : counts.length)
      {
        counts.start.push_back(counts.total);
        counts.total += length;
      }
    return counts;
  }



  Communicator::Counts
  Communicator::count(const std::vector<int> &first, const int bytes) const
  {
    Counts counts;
    for (int p = 0; p < n; ++p)
      {
        counts.start.push_back(first[at(p)] * bytes);
        counts.length.push_back((first[at(p) + 1] - first[at(p)]) * bytes);
      }
    counts.own   = counts.length[at(own)];
    counts.total = first[at(n)] * bytes;
    return counts;
  }



  void
  Communicator::gather_all(const void   *part,
                           void         *all,
                           const Counts &counts) const
  {
    MPI_Allgatherv(part,
                   counts.own,
                   MPI_BYTE,
                   all,
                   counts.length.data(),
                   counts.start.data(),
                   MPI_BYTE,
                   comm);
  }



  void
  Communicator::gather(const void *part, void *all, const Counts &counts) const
  {
    MPI_Gatherv(part,
                counts.own,
                MPI_BYTE,
                all,
                counts.length.data(),
                counts.start.data(),
                MPI_BYTE,
                0,
                comm);
  }



  void
  Communicator::scatter(const void *all, void *part, const Counts &counts) const
  {
    MPI_Scatterv(all,
                 counts.length.data(),
                 counts.start.data(),
                 MPI_BYTE,
                 part,
                 counts.own,
                 MPI_BYTE,
                 0,
                 comm);
  }



  void
  Communicator::broadcast(void *x, const std::size_t bytes) const
  {
    for (std::size_t k = 0; k < bytes; k += longest)
      MPI_Bcast(static_cast<char *>(x) + k,
                static_cast<int>(std::min(longest, bytes - k)),
                MPI_BYTE,
                0,
                comm);
  }



  void
  Communicator::send(const void *x, const std::size_t bytes, const int to) const
  {
    for (std::size_t k = 0; k < bytes; k += longest)
      MPI_Send(static_cast<const char *>(x) + k,
               static_cast<int>(std::min(longest, bytes - k)),
               MPI_BYTE,
               to,
               0,
               comm);
  }



  void
  Communicator::receive(void *x, const std::size_t bytes, const int from) const
  {
    for (std::size_t k = 0; k < bytes; k += longest)
      MPI_Recv(static_cast<char *>(x) + k,
               static_cast<int>(std::min(longest, bytes - k)),
               MPI_BYTE,
               from,
               0,
               comm,
               MPI_STATUS_IGNORE);
  }



  std::vector<std::vector<int>>
  Communicator::exchange(const std::vector<std::vector<int>> &lists) const
  {
    std::vector<int> sent, received(at(n));
    for (const std::vector<int> &list : lists)
      sent.push_back(static_cast<int>(list.size()));
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, comm);
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
        MPI_Isend(lists[at(p)].data(),
                  sent[at(p)],
                  MPI_INT,
                  p,
                  0,
                  comm,
                  &requests.emplace_back());
    MPI_Waitall(static_cast<int>(requests.size()),
                requests.data(),
                MPI_STATUSES_IGNORE);
    return result;
  }
} // namespace conetact
