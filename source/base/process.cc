// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/process.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/interruption.h"

#include <deal.II/base/multithread_info.h>

#include <malloc.h>
#include <mpi.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

// Which BLAS and whether an OpenMP runtime are loaded is only known at run
// time: these are null where they are not.
extern "C"
{
  void
  openblas_set_num_threads(int) __attribute__((weak));
  int
  blas_thread_shutdown_() __attribute__((weak));
  void
  omp_set_num_threads(int) __attribute__((weak));
}

namespace conetact
{
  namespace
  {
    /** By how much sleeps may be longer than they should [ns]. */
    constexpr unsigned long shortest_sleep = 2000;

    unsigned int sessions       = 0;
    unsigned int threads        = 0; ///< not set yet
    bool         we_initialized = false;
    Ranks        joined; ///< the processes of this run

    bool
    started_by_mpirun()
    {
      for (const char *const name :
           {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"})
        if (std::getenv(name) != nullptr)
          return true;
      return false;
    }

    Ranks
    ranks_of_mpi()
    {
      int size = 1, rank = 0;
      MPI_Comm_size(MPI_COMM_WORLD, &size);
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      return {static_cast<unsigned int>(size), static_cast<unsigned int>(rank)};
    }

    void
    check_ranks(const Ranks &found)
    {
      const std::string seen = std::to_string(found.size);
      if (found.size > 1 && joined.size == 1)
        throw InputError("There are " + seen +
                         " processes, but whoever started them has told them "
                         "nothing of each other: they would all write the same "
                         "files. Start them by mpirun, or with --processes.");
      if (found.size != joined.size)
        throw InputError("mpirun has started " + std::to_string(joined.size) +
                         " processes, of which MPI sees " + seen +
                         ": it is not the mpirun of the program's MPI. Start "
                         "them with --processes.");
    }

    /** The first of these variables of the environment that is a number. */
    unsigned int
    number_of(const std::vector<const char *> &variables,
              const unsigned int               otherwise)
    {
      for (const char *const variable : variables)
        if (const char *const text = std::getenv(variable))
          {
            char               *end    = nullptr;
            const unsigned long number = std::strtoul(text, &end, 10);
            if (end != text && *end == 0)
              return static_cast<unsigned int>(number);
          }
      return otherwise;
    }

    // OpenBLAS starts a thread for each core when it is loaded; they spin for
    // a tenth of a second. It starts them again when it needs them.
    void
    set_blas_threads(const int n)
    {
      if (omp_set_num_threads != nullptr)
        omp_set_num_threads(n);
      if (openblas_set_num_threads == nullptr)
        return;
      openblas_set_num_threads(n);
      if (n == 1 && blas_thread_shutdown_ != nullptr)
        blas_thread_shutdown_();
    }

    // A lone process needs no daemon, talks to nobody and is bound to no core:
    // no need to explore the machine, its buses and displays. What the user
    // has set in the environment stays.
    void
    make_singleton_cheap()
    {
      const char *const settings[][2] = {
        {"OMPI_MCA_ess_singleton_isolated", "1"},
        {"OMPI_MCA_btl", "self"},
        // a folder shared by all lone processes, removed by the first to end
        {"OMPI_MCA_orte_create_session_dirs", "0"},
        {"OMPI_MCA_pml", "ob1"},
        {"OMPI_MCA_op", "^avx"},
        {"OMPI_MCA_coll", "^adapt,han,inter,monitoring,sm,sync,tuned"},
        // each of these is a library to be loaded that is of no use
        {"OMPI_MCA_state", "^tool,orted,novm,hnp"},
        {"OMPI_MCA_errmgr", "^default_tool,default_orted,default_hnp"},
        {"OMPI_MCA_shmem", "^sysv,posix"},
        {"OMPI_MCA_reachable", "^netlink"},
        {"OMPI_MCA_osc", "^monitoring,pt2pt,rdma,sm,ucx"},
        {"HWLOC_PLUGINS_PATH", "/"},
        {"HWLOC_SYNTHETIC", "pu:1"}};
      for (const auto &setting : settings)
        setenv(setting[0], setting[1], /*overwrite=*/0);
    }
  } // namespace



  ProcessSession::ProcessSession(const unsigned int n_threads)
  {
    if (sessions > 0)
      throw std::logic_error("There is one ProcessSession in a process.");
    ++sessions;
    set_threads(n_threads);
  }



  ProcessSession::~ProcessSession()
  {
    int finalized = 0;
    if (we_initialized)
      {
        MPI_Finalized(&finalized);
        if (finalized == 0)
          MPI_Finalize();
      }
    --sessions;
  }



  int
  ProcessSession::require_mpi()
  {
    if (!mpi_is_running())
      {
        if (sessions == 0)
          throw std::logic_error("MPI is needed outside a ProcessSession.");
        if (!started_by_mpirun())
          make_singleton_cheap();
        if (MPI_Init(nullptr, nullptr) != MPI_SUCCESS)
          throw std::runtime_error("MPI does not start.");
        we_initialized = true;
        check_ranks(ranks_of_mpi());
      }
    return static_cast<int>(MPI_Comm_c2f(MPI_COMM_SELF));
  }



  /* Who waits for a message sleeps (Communicator::wait). To yield in between
     would give way to all other programs of the machine, for milliseconds. */
  void
  ProcessSession::join()
  {
    const Ranks told = ranks_of_mpirun();
    if (told.size < 2)
      return;
    setenv("OMPI_MCA_mpi_yield_when_idle", "0", /*overwrite=*/0);
    // On one machine they share memory: to look for networks takes .2 s.
    if (number_of({"OMPI_COMM_WORLD_LOCAL_SIZE"}, 0) == told.size)
      setenv("OMPI_MCA_pml", "ob1", /*overwrite=*/0);
    prctl(PR_SET_TIMERSLACK, shortest_sleep);
    joined = told;
    try
      {
        require_mpi();
      }
    catch (const InputError &)
      {
        joined = {};
        throw;
      }
    if (joined.rank > 0)
      {
        leave_files_to_first();
        std::signal(Interruption::forwarded, SIG_IGN); // the first one decides
      }
  }



  unsigned int
  ProcessSession::n_processes()
  {
    return joined.size;
  }



  unsigned int
  ProcessSession::rank()
  {
    return joined.rank;
  }



  void
  ProcessSession::end_all(const int exit_code)
  {
    if (mpi_is_running())
      MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }



  bool
  ProcessSession::mpi_is_running()
  {
    int initialized = 0, finalized = 0;
    MPI_Initialized(&initialized);
    MPI_Finalized(&finalized);
    return initialized != 0 && finalized == 0;
  }



  void
  ProcessSession::set_threads(const unsigned int n_threads)
  {
    const unsigned int wanted =
      n_threads > 0 ? n_threads :
                      std::max(1U, std::thread::hardware_concurrency());
    if (wanted == threads)
      return;
    threads = wanted;
    set_blas_threads(1);
    dealii::MultithreadInfo::set_thread_limit(threads);
  }



  unsigned int
  ProcessSession::n_threads()
  {
    return std::max(1U, threads);
  }



  namespace
  {
    /** The least limit of a control group and all groups it is in. */
    double
    least_limit(const std::filesystem::path &root,
                std::filesystem::path        group,
                const char *const            name)
    {
      double least = std::numeric_limits<double>::infinity();
      for (;; group = group.parent_path())
        {
          std::ifstream file(root / group.relative_path() / name);
          if (double limit = 0; file >> limit) // or "max"
            least = std::min(least, limit);
          if (group == group.parent_path())
            return least;
        }
    }

    /** Limits of containers and batch systems: a line of the file is
     * "number:controllers:group", without controllers of version 2. */
    double
    memory_of_groups()
    {
      double        least = std::numeric_limits<double>::infinity();
      std::ifstream groups("/proc/self/cgroup");
      std::string   number, controllers, group;
      while (std::getline(groups, number, ':') &&
             std::getline(groups, controllers, ':') &&
             std::getline(groups, group))
        if (controllers.empty())
          least =
            std::min(least, least_limit("/sys/fs/cgroup", group, "memory.max"));
        else if (controllers == "memory")
          least = std::min(least,
                           least_limit("/sys/fs/cgroup/memory",
                                       group,
                                       "memory.limit_in_bytes"));
      return least;
    }
  } // namespace

  void
  give_back_memory()
  {
#ifdef __GLIBC__
    constexpr std::size_t worth_it = 32u << 20;
    if (mallinfo2().fordblks > worth_it)
      malloc_trim(0);
#endif
  }



  double
  resident_memory()
  {
    std::ifstream statm("/proc/self/statm");
    double        pages = 0, resident = 0;
    statm >> pages >> resident;
    return statm ? resident * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0.;
  }



  double
  machine_memory()
  {
    const double all = std::min(static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                                  static_cast<double>(sysconf(_SC_PAGE_SIZE)),
                                memory_of_groups());
    rlimit       limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
      return all;
    return std::min(all, static_cast<double>(limit.rlim_cur));
  }



  Ranks
  ranks_of_mpirun()
  {
    return {number_of({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1),
            number_of({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"}, 0)};
  }



  namespace
  {
    volatile std::sig_atomic_t mpirun = 0, is_asked = 0;

    /** A first Ctrl-C asks the first process to stop; all else ends mpirun,
     * which ends its processes. */
    void
    pass_on(const int signal)
    {
      const bool asks = signal == SIGINT && is_asked == 0;
      is_asked        = is_asked != 0 || signal == SIGINT ? 1 : 0;
      kill(mpirun, asks ? Interruption::forwarded : SIGTERM);
    }

    /** The other ends of the run are told as one process tells them. */
    [[noreturn]] void
    end_with_mpirun()
    {
      int status = 0;
      while (waitpid(mpirun, &status, 0) < 0 && errno == EINTR)
        ;
      constexpr int last_of_program = 3;
      const int     code =
        WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      if (is_asked != 0 && code > last_of_program)
        Interruption::end_process();
      std::_Exit(code);
    }

    /** The copy of the process that becomes mpirun returns. It is in a group of
     * its own: a terminal sends Ctrl-C to all of a group, and mpirun takes it
     * for the end. It does not outlive who waits for it. */
    void
    go_on_in_copy()
    {
      const pid_t waiting = getpid();
      const pid_t copy    = fork();
      if (copy < 0)
        throw InputError("Option --processes: the system starts no process.");
      if (copy == 0)
        {
          setpgid(0, 0);
          prctl(PR_SET_PDEATHSIG, SIGTERM);
          if (getppid() != waiting)
            std::_Exit(Interrupted::exit_code);
          return;
        }
      mpirun = copy;
      for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, pass_on) == SIG_IGN)
          std::signal(signal, SIG_IGN);
      end_with_mpirun();
    }
  } // namespace



  /* What the environment says to Open MPI others do not read: as many
     processes as are asked for, on whatever cores, also in a container. It says
     no more about an exit code than the program does. */
  void
  start_processes(const unsigned int n, char *const arguments[])
  {
    const char *const settings[][2] = {
      {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
      {"OMPI_MCA_hwloc_base_binding_policy", "none"},
      {"OMPI_MCA_orte_execute_quiet", "1"},
      {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
      {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}};
    for (const auto &setting : settings)
      setenv(setting[0], setting[1], /*overwrite=*/0);
    go_on_in_copy();
    const std::string number = std::to_string(n);
    const std::string program =
      std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<const char *> line = {"mpirun",
                                      "-n",
                                      number.c_str(),
                                      program.c_str()};
    for (char *const *argument = arguments + 1; *argument != nullptr;
         ++argument)
      line.push_back(*argument);
    line.push_back(nullptr);
    execvp(line[0], const_cast<char *const *>(line.data()));
    throw InputError("Option --processes: mpirun, which starts processes, is "
                     "not found. Install Open MPI (Debian: openmpi-bin), or "
                     "leave the option out.");
  }



  ManyThreads::ManyThreads()
  {
    if (ProcessSession::n_threads() > 1)
      set_blas_threads(static_cast<int>(ProcessSession::n_threads()));
  }



  ManyThreads::~ManyThreads()
  {
    if (ProcessSession::n_threads() > 1)
      set_blas_threads(1);
  }
} // namespace conetact
