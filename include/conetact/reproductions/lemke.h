// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_reproductions_lemke_h
#define conetact_reproductions_lemke_h

#include "conetact/load_path/load_path.h"

#include <functional>
#include <memory>
#include <string>

/**
 * The method of [P] as it is printed, to reproduce its tables and for nothing
 * else: Lemke's method on the holonomic law, with the load parameter p as the
 * artificial variable, in one full table [E -R -Rv | Rc + Fc e] with
 * @f[ x = R z + R_c + p R_v + F_c e, \quad x \ge 0 \perp z \ge 0, \quad
 *     x = (r_n, \mu r_n + c + r_t, \mu r_n + c - r_t), \quad
 *     z = (g, u_t^+, u_t^-), \quad u_t = u_t^+ - u_t^- . @f]
 * The tightening weight Fc [force] lets the first table be feasible; it changes
 * the problem: a prestress Fc and a cohesion (1 - mu) Fc of all nodes.
 */
namespace conetact::reproductions
{
  struct LemkeOptions
  {
    double weight   = 1;     ///< Fc [force]
    double accuracy = 1e-10; ///< entries below, times the largest, are zero

    /** Takes the pivots, and small tables in full, line by line. */
    std::function<void(const std::string &)> log;
  };

  /**
   * Each stage is a table of its own. Points with changes are those of the
   * tightened problem, one a pivot. The last point of a stage has none: with
   * criterion 1 (p passes the end of the stage) or 2 (a ray) p leaves the basis
   * and the values are those at the end **without** the tightening, as in [P].
   * They solve the problem only if the residual of that point says so.
   * Outcomes: target_reached (criterion 1); on a ray no_further_change, or
   * limit_load where the leading element in the row of p is zero; else
   * not_converged. Throws std::invalid_argument as make_event_follower() does.
   */
  std::unique_ptr<load_path::PathFollower>
  make_lemke_follower(std::shared_ptr<const solvers::ContactSystem> system,
                      const load_path::PathOptions &path_options,
                      const LemkeOptions           &options);
} // namespace conetact::reproductions

#endif
