// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/existence.h"

#include <algorithm>
#include <limits>
#include <optional>

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

    /** Of what is added to a load: if more of it is left, next to nothing holds
     * it. Less may be what a search for reactions at their limits has not
     * found. */
    constexpr double most_left = .5;

    /** The friction that reactions allow, node by node. */
    VectorXd
    friction_of(const ContactSystem &system, const VectorXd &r)
    {
      VectorXd radius(system.n_nodes());
      for (Index i = 0; i < system.n_nodes(); ++i)
        radius[i] = system.mu[i] * std::max(0., r[system.normal(i)]);
      return radius;
    }

    /** The least work that reactions with this friction do in a motion: a proof
     * of what they do not hold, whether or not the motion is the best one. */
    double
    work_left(const ContactSystem &system,
              const VectorXd      &v,
              const VectorXd      &radius)
    {
      constexpr double rounding = 1e-6; // of what nodes move by
      double           work     = 0;
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          if (v[system.normal(i)] < -rounding * largest(v))
            return -std::numeric_limits<double>::infinity();
          work -=
            radius[i] * v.segment(system.first[i], system.n_tangents(i)).norm();
        }
      return work;
    }

    /**
     * The largest s for which from + s rate is balanced with this friction, and
     * the motion w that sets in there: the zeros of tangents to the distance,
     * which is convex, come down to it from above.
     */
    double
    largest_share(const ContactSystem &system,
                  const MatrixXd      &R,
                  const VectorXd      &radius,
                  const VectorXd      &from,
                  const VectorXd      &rate,
                  VectorXd            &w)
    {
      constexpr unsigned int most_steps = 100;
      double                 s          = 1;
      for (unsigned int i = 0; i < most_steps; ++i)
        {
          const VectorXd c = from + s * rate;
          const VectorXd z = nearest_reach_of_discs(system, R, c, radius).z;
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
  } // namespace



  bool
  ExistenceCheck::is_limit(const VectorXd &load,
                           const VectorXd &start,
                           const VectorXd &last) const
  {
    eigen_assert(load.size() == R.rows());
    eigen_assert(start.size() == R.rows());
    eigen_assert(last.size() == R.rows());
    const VectorXd c0 = R.transpose() * start, now = -R.transpose() * last;
    const VectorXd way    = R.transpose() * load - c0;
    const auto     solved = part_of_way(c0, way, now);
    if (!solved || *solved == 0)
      return false;
    const double   more   = std::min(near, 1 - *solved);
    const VectorXd then   = last + more / *solved * (last + start);
    const VectorXd c      = now + more * way;
    const VectorXd radius = friction_of(*system, then);
    const VectorXd z      = nearest_reach_of_discs(*system, R, c, radius).z;
    return work_left(*system, R * z, radius) + z.dot(c) >
           most_left * more * way.norm() * z.norm();
  }



  Existence
  ExistenceCheck::limit_state(const VectorXd &load,
                              const VectorXd &start,
                              const VectorXd &last) const
  {
    eigen_assert(load.size() == R.rows());
    eigen_assert(start.size() == R.rows());
    eigen_assert(last.size() == R.rows());
    Existence      result;
    const VectorXd c = R.transpose() * load, c0 = R.transpose() * start;
    const VectorXd now = -R.transpose() * last, way = c - c0;
    const auto     part = part_of_way(c0, way, now);
    if (R.cols() == 0 || !part)
      return result;
    const double solved = *part;
    VectorXd     w;
    const double more =
      largest_share(*system, R, friction_of(*system, last), now, c - now, w);
    const double beyond = more * (1 - solved);
    if (w.size() == 0 ||
        (beyond > near && beyond * way.norm() > near_of_all * c.norm()))
      return result;
    result.admissible = false;
    result.fraction   = beyond > near ? solved + beyond : solved;
    result.w          = w;
    name_motion(result);
    return result;
  }
} // namespace conetact::solvers
