// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/existence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** Of a load: what is off the way to it by more is not a part of it. */
    constexpr double off_the_way = 1e-6;

    /** Remainders below this part of a load show no direction. */
    constexpr double directed = 1e-7;

    /** Of the increment, and of the whole load: a limit that is further away is
     * not what failed. */
    constexpr double near = .02, near_of_all = .005;

    /** Guesses at the reactions there, and a share that is known well enough.
     */
    constexpr unsigned int most_guesses = 10;
    constexpr double       known        = 1e-4;

    /** Of what is added to a load: if more of it is left, next to nothing holds
     * it. Less may be what a search for reactions at their limits has not
     * found. */
    constexpr double most_left = .5;

    /** The most work that a force does against a way; without end: that is no
     * more than rounding where the way is. */
    double
    work_against(const double force, const double way, const double rounding)
    {
      return way > rounding || std::isfinite(force) ? force * way : 0.;
    }

    /** The least work that reactions which the nodes bear do in a motion: a
     * proof of what they do not hold, whether or not the motion is the best
     * one. */
    double
    work_left(const ContactSystem &system,
              const VectorXd      &v,
              const Holding       &holding)
    {
      const double rounding = 1e-6 * largest(v);
      double       work     = 0;
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const double away = v[system.normal(i)];
          const double slip =
            v.segment(system.first[i], system.n_tangents(i)).norm();
          work -= work_against(holding.friction[i], slip, rounding);
          work -= away > 0 ? work_against(holding.pull[i], away, rounding) :
                             work_against(holding.push[i], -away, rounding);
        }
      return work;
    }

    /**
     * The largest s for which nodes that bear so much balance from + s rate,
     * and the motion w that sets in there: the zeros of tangents to the
     * distance, which is convex, come down to it from above.
     */
    double
    largest_share(const ContactSystem &system,
                  const MatrixXd      &R,
                  const Holding       &holding,
                  const VectorXd      &from,
                  const VectorXd      &rate,
                  VectorXd            &w)
    {
      constexpr unsigned int most_steps = 100;
      double                 s          = 1;
      for (unsigned int i = 0; i < most_steps; ++i)
        {
          const VectorXd c = from + s * rate;
          const VectorXd z = nearest_reach(system, R, c, holding).z;
          if (z.norm() <= directed * std::max(c.norm(), from.norm()))
            return s;
          w                    = z.normalized();
          const double slope   = rate.dot(w);
          const double balance = s - z.norm() / slope; // where z vanishes
          if (!(slope > 0 && balance > 0))
            return 0;
          s = balance;
        }
      return s;
    }

    /**
     * The same of nodes whose normal reactions r do not fall. So is a limit of
     * what is jammed: slip out of a taper only relieves it.
     */
    Holding
    with_kept_normals(const ContactSystem &system,
                      const VectorXd      &r,
                      Holding              holding)
    {
      for (Index i = 0; i < system.n_nodes(); ++i)
        if (const double normal = r[system.normal(i)]; normal > 0)
          holding.pull[i] = -normal;
      return holding;
    }

    /** Whether friction is what resists a motion, at all nodes that press:
     * where normal reactions r drive it faster, contacts open instead, and
     * others bear what they lose. */
    bool
    is_resisted_by_friction(const ContactSystem &system,
                            const VectorXd      &v,
                            const VectorXd      &friction,
                            const VectorXd      &r)
    {
      constexpr double rounding = 1e-6, presses = 1e-6;
      const double     least = presses * largest(r);
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const double normal = r[system.normal(i)];
          const double away   = v[system.normal(i)];
          const double slip =
            v.segment(system.first[i], system.n_tangents(i)).norm();
          if (normal > least && away > rounding * largest(v) &&
              normal * away >= friction[i] * slip)
            return false;
        }
      return true;
    }

    /** Which part of the way from c0 on `now` is; nothing: it is beside it. */
    std::optional<double>
    part_of_way(const VectorXd &c0, const VectorXd &way, const VectorXd &now)
    {
      if (!(way.norm() > 0))
        return {};
      const double part = (now - c0).dot(way) / way.squaredNorm();
      if (part >= 0 && part < 1 &&
          (now - c0 - part * way).norm() <= off_the_way * way.norm())
        return part;
      return {};
    }

    /** The share of the load, with the motion w that sets in there, where what
     * nodes bear under it is near its end; 1: it is not. */
    double
    share_of_limit(const ContactSystem             &system,
                   const MatrixXd                  &R,
                   const VectorXd                  &load,
                   const VectorXd                  &start,
                   const VectorXd                  &last,
                   const ExistenceCheck::HoldingAt &holding,
                   VectorXd                        &w)
    {
      const VectorXd c = R.transpose() * load, c0 = R.transpose() * start;
      const VectorXd now = -R.transpose() * last, way = c - c0;
      const auto     part = part_of_way(c0, way, now);
      if (R.cols() == 0 || !part)
        return 1;
      const double solved = *part;
      const auto   share  = [&](const VectorXd &r) {
        return largest_share(system, R, holding(r), now, c - now, w);
      };
      double more = share(last);
      // What presses goes on to change as before: little from here to the
      // limit.
      for (unsigned int k = 0;
           k < most_guesses && solved > 0 && w.size() > 0 && more > known;
           ++k)
        {
          const double   ahead  = more * (1 - solved) / solved;
          const VectorXd then   = last + ahead * (last + start);
          const double   before = std::exchange(more, share(then));
          if (std::abs(more - before) <= known)
            break;
        }
      const double beyond = more * (1 - solved);
      if (w.size() == 0 || more >= 1 ||
          (beyond > near && beyond * way.norm() > near_of_all * c.norm()))
        return 1;
      return solved + beyond;
    }
  } // namespace



  Holding
  ExistenceCheck::holding_of_cones(const ContactSystem &system,
                                   const VectorXd      &r)
  {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    const Index      n           = system.n_nodes();
    eigen_assert(r.size() >= system.n_contact_unknowns());
    Holding result{VectorXd(n),
                   VectorXd::Zero(n),
                   VectorXd::Constant(n, without_end)};
    for (Index i = 0; i < n; ++i)
      result.friction[i] = system.mu[i] * std::max(0., r[system.normal(i)]);
    return result;
  }



  bool
  ExistenceCheck::is_limit(const VectorXd  &load,
                           const VectorXd  &start,
                           const VectorXd  &last,
                           const HoldingAt &holding,
                           const double     wanted) const
  {
    eigen_assert(load.size() == R.rows());
    eigen_assert(start.size() == R.rows());
    eigen_assert(last.size() == R.rows());
    eigen_assert(wanted > 0);
    const VectorXd c0 = R.transpose() * start, now = -R.transpose() * last;
    const VectorXd way    = R.transpose() * load - c0;
    const auto     solved = part_of_way(c0, way, now);
    if (!solved || *solved == 0)
      return false;
    const double   more    = std::min(wanted, 1 - *solved);
    const VectorXd then    = last + more / *solved * (last + start);
    const VectorXd c       = now + more * way;
    const auto     is_left = [&](const VectorXd &z, const Holding &bears) {
      return work_left(*system, R * z, bears) + z.dot(c) >
             most_left * more * way.norm() * z.norm();
    };
    const Holding  bears = holding(then);
    const VectorXd z     = nearest_reach(*system, R, c, bears).z;
    if (is_left(z, bears))
      return true;
    const Holding  kept = with_kept_normals(*system, then, bears);
    const VectorXd slip = nearest_reach(*system, R, c, kept).z;
    return is_left(slip, kept) &&
           is_resisted_by_friction(*system, R * slip, kept.friction, then);
  }



  /* First with all that nodes could bear, then with what they bear while
     normal reactions do not fall. */
  Existence
  ExistenceCheck::limit_state(const VectorXd  &load,
                              const VectorXd  &start,
                              const VectorXd  &last,
                              const HoldingAt &holding) const
  {
    eigen_assert(load.size() == R.rows());
    eigen_assert(start.size() == R.rows());
    eigen_assert(last.size() == R.rows());
    const auto with = [&](const HoldingAt &bears) {
      Existence result;
      result.fraction =
        share_of_limit(*system, R, load, start, last, bears, result.w);
      result.admissible = result.fraction >= 1;
      if (!result.admissible)
        name_motion(result);
      return result;
    };
    const Existence result = with(holding);
    if (!result.admissible)
      return result;
    const Existence slip = with([&](const VectorXd &r) {
      return with_kept_normals(*system, r, holding(r));
    });
    return slip.admissible || is_resisted_by_friction(*system,
                                                      slip.v,
                                                      holding(last).friction,
                                                      last) ?
             slip :
             result;
  }
} // namespace conetact::solvers
