// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/mumps.h"

#include "conetact/base/communicator.h"
#include "conetact/base/process.h"
#include "conetact/condensed/schur_solver.h"

#include <memory>
#include <new>
#include <stdexcept>

namespace conetact::condensed
{
  namespace
  {
    constexpr int job_begin = -1, job_end = -2; // jobs, as MUMPS calls them

    int n_shared = 0; // made so far

    /* Nothing where this process is alone. */
    std::unique_ptr<Together>
    order(const Command command, const int number, const int value)
    {
      return number == 0 ?
               nullptr :
               std::make_unique<Together>(Order{command, number, value});
    }

    /* All of these processes do so. */
    void
    begin_on(const Communicator &processes, DMUMPS_STRUC_C &data)
    {
      data.sym = 1; // positive definite
      data.par = 1; // the first process works, too
      data.comm_fortran =
        static_cast<MUMPS_INT>(MPI_Comm_c2f(processes.handle()));
      data.job = job_begin;
      dmumps_c(&data);
      for (const int i : {1, 2, 3}) // silent
        data.icntl[i - 1] = -1;
      data.icntl[4 - 1] = 0;
    }
  } // namespace



  Mumps::Mumps(const int n_processes)
    : number(n_processes > 1 ? ++n_shared : 0)
  {
    {
      const auto together = order(Command::make_mumps, number, n_processes);
      begin_on(number == 0 ? Communicator() :
                             Communicator::of_first(n_processes),
               data);
    }
    throw_errors();
    control(7)  = 1;  // the order is given
    control(8)  = -1; // and the scaling
    control(14) = 10; // spare workspace [%]
    control(28) = 1;  // sequential analysis
  }



  Mumps::~Mumps()
  {
    if (number == 0 ? ProcessSession::mpi_is_running() :
                      Together::is_possible())
      call(job_end);
  }



  void
  Mumps::analyse()
  {
    call(1);
    throw_errors();
  }



  void
  Mumps::factorize()
  {
    const ManyThreads threads;
    call(2);
    while ((info(1) == -8 || info(1) == -9) && control(14) < 2000)
      {
        control(14) *= 3;
        call(2);
      }
    throw_errors();
    if (info(12) > 0) // negative pivots
      throw SingularMatrix(std::nullopt);
  }



  void
  Mumps::solve()
  {
    call(3);
    throw_errors();
  }



  void
  Mumps::call(const int job)
  {
    const auto together = order(Command::call_mumps, number, job);
    data.job            = job;
    dmumps_c(&data);
  }



  void
  Mumps::throw_errors() const
  {
    const int error = info(1);
    if (error == -5 || error == -7 || error == -13)
      throw std::bad_alloc();
    if (error == -10)
      throw SingularMatrix(std::nullopt);
    if (error < 0)
      throw std::runtime_error("MUMPS gives up with its error " +
                               std::to_string(error) + " (" +
                               std::to_string(info(2)) + ").");
  }



  void
  MumpsParts::make(const Order &order)
  {
    const auto processes = Communicator::of_first(order.value);
    if (processes.is_member())
      begin_on(processes, parts[order.number]);
  }



  void
  MumpsParts::call(const Order &order)
  {
    const auto part = parts.find(order.number);
    if (part == parts.end())
      return;
    part->second.job = order.value;
    dmumps_c(&part->second);
    if (order.value == job_end)
      parts.erase(part);
  }
} // namespace conetact::condensed
