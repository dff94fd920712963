// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/process.h"

#include <deal.II/base/multithread_info.h>

#include <mpi.h>

#include <cstdlib>
#include <stdexcept>
#include <thread>

// Which BLAS and whether an OpenMP runtime are loaded is only known at run
// time: these are null where they are not.
extern "C"
{
  void
  openblas_set_num_threads(int) __attribute__((weak));
  void
  omp_set_num_threads(int) __attribute__((weak));
}

namespace conetact
{
  namespace
  {
    // OpenBLAS starts a thread for each core when it is loaded, and they spin
    // for a while before they sleep. Runs before any library is initialised:
    // set_threads() starts those that are wanted.
    void
    make_blas_start_alone(int, char **, char **)
    {
      setenv("OPENBLAS_NUM_THREADS", "1", /*overwrite=*/0);
    }
    __attribute__((section(".preinit_array"), used)) void (
      *const before_libraries)(int, char **, char **) = make_blas_start_alone;

    unsigned int sessions       = 0;
    unsigned int threads        = 1;
    bool         we_initialized = false;

    bool
    started_by_mpirun()
    {
      for (const char *const name :
           {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"})
        if (std::getenv(name) != nullptr)
          return true;
      return false;
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
        {"OMPI_MCA_pml", "ob1"},
        {"OMPI_MCA_op", "^avx"},
        {"OMPI_MCA_coll", "^adapt,han,inter,monitoring,sm,sync,tuned"},
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
      }
    return static_cast<int>(MPI_Comm_c2f(MPI_COMM_SELF));
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
    threads     = n_threads > 0 ? n_threads :
                                  std::max(1U, std::thread::hardware_concurrency());
    const int n = static_cast<int>(threads);
    if (openblas_set_num_threads != nullptr)
      openblas_set_num_threads(n);
    if (omp_set_num_threads != nullptr)
      omp_set_num_threads(n);
    dealii::MultithreadInfo::set_thread_limit(threads);
  }



  unsigned int
  ProcessSession::n_threads()
  {
    return threads;
  }
} // namespace conetact
