// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_exchange_fclib_file_h
#define conetact_exchange_fclib_file_h

#include "conetact/solvers/contact_problem.h"

#include <optional>
#include <string>

namespace conetact::exchange
{
  /**
   * Contact problems as files of FCLib, the exchange format of the field
   * (Acary, Brémond, Koziara, Pérignon, FCLIB: a collection of discrete 3D
   * frictional contact problems, INRIA RT-444, 2014): HDF5 with the Delassus
   * matrix W, the vector q and the friction coefficients of
   * @f[ u = W r + q, \quad r_n \ge 0,\; u_n \ge 0,\; r_n u_n = 0,\;
   *     |r_t| \le \mu r_n,\; u_t \ne 0 \Rightarrow r_t = -\mu r_n u_t/|u_t| .
   * @f]
   * This is our compliance form, with u in the place of (slip, gap) in
   * whatever units the file has. A contact is (n, t1[, t2]) there and
   * (t1, [t2,] n) here; the functions below convert. W may be unsymmetric, as
   * the gyroscopic terms of multibody programs make it, and is taken as it is.
   * Global problems are reduced to local ones, see FclibGlobal.
   */

  /**
   * Reads the local problem, or the global one as a local one. Throws
   * InputError with a sentence for a file that is missing, damaged or
   * inconsistent, and for what we do not treat (local problems with equality
   * constraints).
   */
  solvers::ContactProblem
  read_fclib(const std::string &file);

  /**
   * The solution in the file, and its first guess, if there are any. Entries
   * that the file lacks follow from u = W r + q. Throws like read_fclib().
   */
  std::optional<solvers::ContactState>
  read_fclib_solution(const std::string             &file,
                      const solvers::ContactProblem &problem);
  std::optional<solvers::ContactState>
  read_fclib_guess(const std::string             &file,
                   const solvers::ContactProblem &problem);

  /**
   * Writes the problem, and a solution and a guess if they are given, as a new
   * file (an old one is replaced, atomically). A problem in stiffness form is
   * turned into W = K^-1, q = K^-1 f first. Throws InputError if K is singular
   * (a floating body has no W) or if the nodes have different numbers of
   * tangents, or none; WriteError if the file cannot be written.
   */
  void
  write_fclib(const solvers::ContactProblem &problem,
              const std::string             &file,
              const solvers::ContactState   *solution = nullptr,
              const solvers::ContactState   *guess    = nullptr,
              const std::string             &title    = "Conetact");

  /**
   * Copies `from` to `to` (which may be the same file) with this solution in
   * the place of any it may hold; global problems get the velocities of the
   * bodies and the forces of bilateral constraints that belong to it, too.
   * Throws WriteError.
   */
  void
  store_fclib_solution(const solvers::ContactProblem &problem,
                       const solvers::ContactState   &solution,
                       const std::string             &from,
                       const std::string             &to);

  /** The same problem in compliance form; throws InputError if K is singular.
   */
  solvers::ContactProblem
  compliance_form(const solvers::ContactProblem &problem);
} // namespace conetact::exchange

#endif
