// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_communicator_h
#define conetact_base_communicator_h

#include <Eigen/Core>
#include <mpi.h>

#include <type_traits>
#include <vector>

namespace conetact
{
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

    double
    sum(const double x) const;
    /** Of each number. */
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
      const Counts counts = count(part.size() * scalar<Vector>);
      Vector       all(counts.total / scalar<Vector>);
      gather_all(part.data(), all.data(), counts);
      return all;
    }
    /** The same for the first process only, where lengths are known. */
    template <typename Vector>
    Vector
    gather(Vector part, const std::vector<int> &first) const
    {
      if (n == 1)
        return part;
      const Counts counts = count(first, scalar<Vector>);
      Vector       all(own == 0 ? counts.total / scalar<Vector> : 0);
      gather(part.data(), all.data(), counts);
      return all;
    }
    /** The first process has all; process p gets first[p], ... */
    template <typename Vector>
    Vector
    scatter(Vector all, const std::vector<int> &first) const
    {
      if (n == 1)
        return all;
      const Counts counts = count(first, scalar<Vector>);
      Vector       part(counts.own / scalar<Vector>);
      scatter(all.data(), part.data(), counts);
      return part;
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
    template <typename T>
    void
    send(const std::vector<T> &x, const int to) const
    {
      static_assert(std::is_trivially_copyable_v<T>);
      const unsigned long long length = x.size();
      send(&length, sizeof(length), to);
      send(x.data(), length * sizeof(T), to);
    }
    template <typename T>
    std::vector<T>
    receive(const int from) const
    {
      static_assert(std::is_trivially_copyable_v<T>);
      unsigned long long length = 0;
      receive(&length, sizeof(length), from);
      std::vector<T> x(length);
      receive(x.data(), length * sizeof(T), from);
      return x;
    }
    /** Lists for each process; returns those from each. */
    std::vector<std::vector<int>>
    exchange(const std::vector<std::vector<int>> &lists) const;

  private:
    /** Bytes from and to each process. */
    struct Counts
    {
      std::vector<int> length, start;
      int              total = 0, own = 0;
    };
    template <typename Vector>
    static constexpr int scalar = sizeof(typename Vector::Scalar);

    /** Of lengths that the processes do not know of each other. */
    Counts
    count(const Eigen::Index own_bytes) const;
    Counts
    count(const std::vector<int> &first, const int bytes) const;
    void
    gather_all(const void *part, void *all, const Counts &counts) const;
    void
    gather(const void *part, void *all, const Counts &counts) const;
    void
    scatter(const void *all, void *part, const Counts &counts) const;
    void
    broadcast(void *x, const std::size_t bytes) const;
    void
    send(const void *x, const std::size_t bytes, const int to) const;
    void
    receive(void *x, const std::size_t bytes, const int from) const;

    int      n = 1, own = 0;
    MPI_Comm comm = MPI_COMM_NULL;
  };
} // namespace conetact

#endif
