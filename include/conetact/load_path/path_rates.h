// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_load_path_path_rates_h
#define conetact_load_path_path_rates_h

#include "conetact/load_path/path_scheme.h"

#include <vector>

namespace conetact::load_path
{
  /** What is undecided at a node. */
  struct CriticalNode
  {
    bool normal = false; ///< g = r_n = 0
    bool plus   = false; ///< may slip along +t or stick
    bool minus  = false; ///< may slip along -t or stick

    bool
    any() const
    {
      return normal || plus || minus;
    }
  };
  using CriticalNodes = std::vector<CriticalNode>;

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

  /** Rates below this share of the largest count as none. */
  constexpr double rate_tolerance = 1e-11;
} // namespace conetact::load_path

#endif
