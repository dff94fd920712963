// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_communicator_h
#define conetact_base_communicator_h

#include <Eigen/Core>
#include <mpi.h>

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace conetact
{
  /** What this process has sent to others since it started. */
  struct Traffic
  {
    std::uint64_t messages = 0, bytes = 0;                ///< to neighbours
    std::uint64_t n_collective = 0, collective_bytes = 0; ///< its part
    std::uint64_t ghosts = 0; ///< most nodes of others in one exchange
    double        waited = 0; ///< CPU time of waiting for others [s]

    void
    add_message(const std::size_t n_bytes)
    {
      ++messages;
      bytes += n_bytes;
    }
    void
    add_collective(const std::size_t n_bytes)
    {
      ++n_collective;
      collective_bytes += n_bytes;
    }
  };
  /** That of this process, which all communicators count. */
  Traffic &
  traffic();

  /**
   * The first processes of a run, which do something together; by default this
   * process alone. All of them must call each function, in the same order. One
   * that is alone gets back what it gave, and MPI is not asked.
   */
  class Communicator
  {
  public:
    Communicator() = default;
    /** The first n of all processes, which all must call this. */
    static Communicator
    of_first(const int n);

    int
    size() const
    {
      return n;
    }
    int
    rank() const
    {
      return own;
    }
    /** Whether this process belongs to them. */
    bool
    is_member() const
    {
      return own < n;
    }
    MPI_Comm
    handle() const;

    /** The same on all processes to the last bit: in the order of processes. */
    double
    sum(const double x) const;
    /** Of each number; so are sums of few. */
    void
    sum(double *x, const Eigen::Index length) const;
    void
    sum(float *x, const Eigen::Index length) const;

    /**
     * Until all of these are done. Who waits lets others have the core, and
     * sleeps in between if it takes long: there may be fewer cores than
     * processes, and other programs.
     */
    static void
    wait(std::vector<MPI_Request> &requests);

    /** What each process has, one behind the other. */
    template <typename Vector>
    Vector
    gather_all(Vector part) const
    {
      if (n == 1)
        return part;
      const Counts counts = count(part.size());
      Vector       all(counts.total);
      gather_all(part.data(),
                 all.data(),
                 counts,
                 sizeof(typename Vector::Scalar));
      return all;
    }
    /** What the first process has, of any length. */
    template <typename T>
    void
    broadcast(std::vector<T> &x) const
    {
      static_assert(std::is_trivially_copyable_v<T>);
      if (n == 1)
        return;
      unsigned long long length = x.size();
      broadcast(&length, sizeof(length));
      x.resize(length);
      broadcast(x.data(), length * sizeof(T));
    }
    /** The same where all know its length. */
    void
    broadcast(Eigen::Ref<Eigen::VectorXd> x) const
    {
      if (n > 1)
        broadcast(x.data(),
                  static_cast<std::size_t>(x.size()) * sizeof(double));
    }
    /** Lists for each process; returns those from each. */
    std::vector<std::vector<int>>
    exchange(const std::vector<std::vector<int>> &lists) const;

  private:
    /** Numbers from and to each process. */
    struct Counts
    {
      std::vector<int> length, start;
      int              total = 0, own = 0;
    };
    Counts
    count(const Eigen::Index own_numbers) const;
    /** Of numbers of so many bytes each: messages count numbers, of which there
     * may be as many as an int counts. */
    void
    gather_all(const void       *part,
               void             *all,
               const Counts     &counts,
               const std::size_t bytes) const;
    void
    broadcast(void *x, const std::size_t bytes) const;

    int      n = 1, own = 0;
    MPI_Comm comm = MPI_COMM_NULL;
  };

  /** Of n things, those from the first number to before the second: as many as
   * others have, but for one. */
  inline std::pair<Eigen::Index, Eigen::Index>
  share_of(const Eigen::Index n, const Communicator &processes)
  {
    return {n * processes.rank() / processes.size(),
            n * (processes.rank() + 1) / processes.size()};
  }
} // namespace conetact

#endif
