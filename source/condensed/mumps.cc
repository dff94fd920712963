// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/mumps.h"

#include "conetact/base/process.h"
#include "conetact/condensed/schur_solver.h"

#include <new>
#include <stdexcept>

namespace conetact::condensed
{
  namespace
  {
    constexpr int job_begin = -1, job_end = -2; // jobs, as MUMPS calls them
  }                                             // namespace



  Mumps::Mumps()
  {
    data.sym          = 1; // positive definite
    data.par          = 1; // this process works
    data.comm_fortran = ProcessSession::require_mpi();
    call(job_begin);
    for (const int i : {1, 2, 3}) // silent
      control(i) = -1;
    control(4) = 0;
    throw_errors();
    control(7)  = 1;  // the order is given
    control(8)  = -1; // and the scaling
    control(14) = 10; // spare workspace [%]
    control(28) = 1;  // sequential analysis
  }



  Mumps::~Mumps()
  {
    if (ProcessSession::mpi_is_running())
      call(job_end);
  }



  void
  Mumps::analyse()
  {
    call(1);
    throw_errors();
  }



  /* Symmetric factorisation of "positive definite" matrices means that MUMPS
     does not pivot, not that it looks: it factorises indefinite ones without a
     word, and only the number of negative pivots tells. Errors -8 and -9 say
     that workspace does not suffice. */
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
    data.job = job;
    dmumps_c(&data);
  }



  void
  Mumps::throw_errors() const
  {
    const int error = info(1);
    // Memory that cannot be allocated; a pivot that is zero; anything else.
    if (error == -5 || error == -7 || error == -13)
      throw std::bad_alloc();
    if (error == -10)
      throw SingularMatrix(std::nullopt);
    if (error < 0)
      throw std::runtime_error("MUMPS gives up with its error " +
                               std::to_string(error) + " (" +
                               std::to_string(info(2)) + ").");
  }
} // namespace conetact::condensed
