// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_process_h
#define conetact_base_process_h

namespace conetact
{
  /**
   * What the process owns besides memory: MPI and the numbers of threads. One
   * object lives in main for as long as anything else does.
   *
   * MPI is started when the first direct solve asks for it and not before, so
   * that a help text or a typing error in a scene costs nothing; it is ended
   * by the destructor. A process that was not started by mpirun gets Open MPI
   * without its helper daemon and its network layers, which is ten times
   * faster to start and to end.
   *
   * All processes of mpirun run the program on the same scene (team.h); the
   * first one speaks and writes files. Where it works alone, the others sleep.
   */
  class ProcessSession
  {
  public:
    explicit ProcessSession(const unsigned int n_threads = 1);
    ~ProcessSession();
    ProcessSession(const ProcessSession &) = delete;
    ProcessSession &
    operator=(const ProcessSession &) = delete;

    /**
     * Starts MPI unless it runs already. Returns the Fortran handle of the
     * communicator that holds this process alone. Throws std::logic_error
     * if no ProcessSession lives, InputError if there are other processes that
     * have not joined.
     */
    static int
    require_mpi();

    /**
     * Starts MPI if mpirun has started several processes, which are one run
     * then. Throws InputError if they cannot see each other.
     */
    static void
    join();
    /** Those of the run, and which one this is. */
    static unsigned int
    n_processes();
    static unsigned int
    rank();
    /** Whether this one speaks, and writes files, for all of the run. */
    static bool
    speaks()
    {
      return rank() == 0;
    }
    /** Ends all processes at once, as one that has failed must. */
    [[noreturn]] static void
    end_all(const int exit_code);

    static bool
    mpi_is_running();

    /**
     * Sets the threads of deal.II, and those that ManyThreads gives BLAS and
     * OpenMP (0: one for each core). Results do not depend on the number but
     * for rounding.
     */
    static void
    set_threads(const unsigned int n_threads);

    static unsigned int
    n_threads();
  };

  /** Of this machine, or what this process may have of it if less [bytes]. */
  double
  machine_memory();

  /** Gives memory that has been freed in small pieces, such as that of a large
   * mesh, back to the machine. */
  void
  give_back_memory();

  /** That this process has now [bytes]; 0: it is not known. */
  double
  resident_memory();

  /** What mpirun has told this process: how many there are, and its number. */
  struct Ranks
  {
    unsigned int size = 1, rank = 0;
  };
  Ranks
  ranks_of_mpirun();

  /**
   * Runs n processes of mpirun with the same arguments and ends as they do.
   * Throws InputError if there is no mpirun, in a process that ends by it.
   */
  void
  start_processes(const unsigned int n, char *const arguments[]);

  /**
   * While it lives BLAS and OpenMP have all threads of the process, otherwise
   * one: for the factorisation of large matrices. Threads that wait for one
   * another in small products spin and cost more than they gain.
   */
  class ManyThreads
  {
  public:
    ManyThreads();
    ~ManyThreads();
    ManyThreads(const ManyThreads &) = delete;
    ManyThreads &
    operator=(const ManyThreads &) = delete;
  };
} // namespace conetact

#endif
