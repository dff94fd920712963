// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_path_rates_h
#define conetact_load_path_path_rates_h

#include "conetact/load_path/rate_lcp.h"

namespace conetact::load_path
{
  enum class RateOutcome
  {
    found,
    mechanism, ///< moves without end at constant loads: v is its velocity
    none       ///< no continuous solution
  };

  struct Rates
  {
    RateOutcome     outcome = RateOutcome::none;
    Scheme          scheme; ///< after the decision
    SchemeFactor    factor; ///< of that scheme; its values follow from it
    Eigen::VectorXd v, r;
    int             way = 1; ///< the parameter: 1 grows, -1 falls, at rate 1
  };

  /** The linear piece on which a path has come to a vertex. */
  struct Arrival
  {
    Scheme          scheme;
    Eigen::VectorXd velocity; ///< of its displacements, forwards
    int             way = 0;  ///< of the parameter; 0: it stood still
  };

  /**
   * The rate problem at a point of a load path: which way do all nodes go that
   * may go either way? For rates (v', r') of displacements and reactions,
   * @f[ K v' = r' + f', \quad
   *     0 \le g' \perp r_n' \ge 0, \quad
   *     0 \le s u_t' \perp \mu r_n' + s r_t' \ge 0 @f]
   * at critical nodes, each of these where it is critical, while the other
   * nodes keep their state.
   *
   * Decides all critical nodes. From `scheme`, the guess, a few steps of an
   * active set method are tried first, then Lemke's method.
   */
  Rates
  solve_rate_problem(const PathSystem      &system,
                     const Scheme          &scheme,
                     const CriticalNodes   &critical,
                     const Eigen::VectorXd &load_rate);

  /**
   * The other way out of a vertex: the piece on which a path goes on that has
   * come on another one, whatever the parameter does. Where no rates exist for
   * a growing parameter it has to fall (a turning point), or to stand still.
   * `load_rate` is that of a growing parameter.
   */
  Rates
  pass_vertex(const PathSystem      &system,
              const Arrival         &arrival,
              const CriticalNodes   &critical,
              const Eigen::VectorXd &load_rate);

  /** Rates below this share of the largest count as none. */
  constexpr double rate_tolerance = 1e-11;
} // namespace conetact::load_path

#endif
