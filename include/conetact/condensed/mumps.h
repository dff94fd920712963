// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_mumps_h
#define conetact_condensed_mumps_h

#include <dmumps_c.h>

namespace conetact::condensed
{
  /**
   * One instance of the direct solver MUMPS for symmetric positive definite
   * matrices, silent, in this process alone. What it complains of becomes
   * exceptions: SingularMatrix, std::bad_alloc, and std::runtime_error for what
   * should never happen.
   */
  class Mumps
  {
  public:
    Mumps();
    ~Mumps();
    Mumps(const Mumps &) = delete;
    Mumps &
    operator=(const Mumps &) = delete;

    /** ICNTL(i) and INFOG(i), counted from 1 as in the manual of MUMPS. */
    int &
    control(const int i)
    {
      return data.icntl[i - 1];
    }
    int
    info(const int i) const
    {
      return data.infog[i - 1];
    }

    void
    analyse();

    /** Factorises, once more with more workspace where that of the analysis is
     * too small. */
    void
    factorize();

    /** Treats the right-hand sides in `data`. */
    void
    solve();

    DMUMPS_STRUC_C data{};

  private:
    void
    call(const int job);

    void
    throw_errors() const;
  };
} // namespace conetact::condensed

#endif
