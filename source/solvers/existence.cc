// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/existence.h"

#include "conetact/solvers/cone.h"
#include "conetact/solvers/null_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact::solvers
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    constexpr double negligible = 1e-10; ///< of a load: not a proof
    constexpr double noise      = 1e-12; ///< of the largest force: round-off
  }                                      // namespace



  ExistenceCheck::ExistenceCheck(std::shared_ptr<const ContactSystem> layout,
                                 std::vector<Frame> node_frames)
    : system(std::move(layout))
    , frames(std::move(node_frames))
    , R(system->n_contact_unknowns(), 0)
  {
    eigen_assert(frames.empty() ||
                 static_cast<Index>(frames.size()) == system->n_nodes());
    eigen_assert(system->null_space.cols() == 0 ||
                 system->null_space.rows() == R.rows());
    if (system->null_space.cols() > 0)
      R = orthonormal_basis(system->null_space);
  }



  Reach
  ExistenceCheck::reach(const VectorXd &c, const VectorXd &mu) const
  {
    eigen_assert(c.size() == R.cols());
    eigen_assert(mu.size() == system->n_nodes());
    return nearest_reach(*system, R, c, mu);
  }



  /* A motion is a proof by its own properties, however it was found: contacts
     either open faster than friction could hold them or stay at rest, and the
     load drives it. */
  bool
  ExistenceCheck::proves(const VectorXd &w, const VectorXd &c) const
  {
    eigen_assert(w.size() == R.cols());
    eigen_assert(c.size() == R.cols());
    const VectorXd v    = R * w;
    const double   size = v.lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < system->n_nodes(); ++i)
      {
        const Index  t    = system->n_tangents(i);
        const double slip = v.segment(system->first[i], t).norm();
        if (v[system->normal(i)] < system->mu[i] * slip - 1e-9 * size)
          return false;
      }
    return c.dot(w) > 0;
  }



  /* A small z has lost digits to the load it was left over from. Seen as a
     load of its own it is reached by nothing: its nearest point is the cone's
     vertex, up to exactly these digits. */
  VectorXd
  ExistenceCheck::sharpen(const VectorXd &z) const
  {
    eigen_assert(z.size() == R.cols());
    return reach(z, system->mu).z.normalized();
  }



  /* Newton's method on the distance along a line: it is convex, so that the
     zeros of its tangents come down to the limit from above. */
  double
  ExistenceCheck::limit(const VectorXd &from,
                        const VectorXd &to,
                        VectorXd       &w) const
  {
    eigen_assert(from.size() == R.cols());
    eigen_assert(to.size() == R.cols());
    const VectorXd rate = to - from;
    double         s    = 1;
    for (unsigned int i = 0; i < 100; ++i)
      {
        // Along the load path the load drives the motion w with the force (from
        // + s rate) . w. Beyond its zero w proves that nothing holds.
        const double slope = rate.dot(w);
        const double next  = slope > 0 ? -from.dot(w) / slope : 0.;
        // Driven at the start already.
        if (!(next > 0))
          return 0;
        if (next >= s * (1 - 1e-15))
          return s;
        s                = next;
        const VectorXd c = from + s * rate;
        const VectorXd z = reach(c, system->mu).z;
        // the direction of a smaller remainder would mean little
        if (z.norm() <= 1e-9 * c.norm())
          return s;
        w = sharpen(z);
      }
    return s;
  }



  /* The distance falls with the friction; its derivative is what the reactions
     at their cones' mantle would gain. */
  void
  ExistenceCheck::find_needed_friction(const MatrixXd &motions,
                                       const VectorXd &c,
                                       Existence      &result) const
  {
    const auto reach = [&](const VectorXd &given, const VectorXd &friction) {
      return nearest_reach(*system, motions, given, friction);
    };
    const double   zero = noise * c.norm();
    const double   most = system->mu.maxCoeff();
    const VectorXd mu =
      most > 0 ? system->mu : VectorXd::Ones(system->mu.size());
    const VectorXd no_slip = mu.unaryExpr(
      [](const double m) { return m > 0 ? no_slip_friction : 0.; });
    // What contacts that never slip cannot hold, no friction can.
    if (reach(c, no_slip).z.norm() > 100 * zero)
      return;

    // low is refused, high is admissible.
    double low = most > 0 ? 1 : 0, high = std::max(2 * low, 1.);
    while (reach(c, high * mu).z.norm() > zero)
      {
        low = high;
        if ((high *= 2) * mu.maxCoeff() > 1e6)
          return;
      }
    double factor = .5 * (low + high), width = 2 * (high - low);
    for (unsigned int i = 0; i < 100 && high - low > 1e-12 * high; ++i)
      {
        const Reach  at       = reach(c, factor * mu);
        const double distance = at.z.norm();
        // In space steps from below may shrink and never reach the end.
        const bool is_slow = high - low > .5 * width;
        width              = high - low;
        if (distance <= zero)
          {
            high   = factor;
            factor = .5 * (low + high);
            continue;
          }
        low                 = factor;
        const VectorXd v    = motions * at.z / distance;
        double         gain = 0;
        for (Index j = 0; j < system->n_nodes(); ++j)
          {
            const Index begin = system->first[j], t = system->n_tangents(j);
            gain -= v.segment(begin, t).dot(at.r.segment(begin, t)) / factor;
          }
        // Newton step from below, kept within the bracket.
        const double step = distance / gain;
        if (step > 0 && step <= 1e-11 * factor)
          high = std::min(high, factor + step);
        factor = step > 0 && low + step < high && !is_slow ? low + step :
                                                             .5 * (low + high);
      }
    if (most > 0)
      result.friction_factor = high;
    result.friction_needed = high * mu.maxCoeff();
  }



  /* The resultants of a load that presses all contacts alike: where a load
     has no start of its own, its limit on the way from here names the motion.
   */
  VectorXd
  ExistenceCheck::even_pressure(const double force) const
  {
    eigen_assert(force >= 0);
    VectorXd sum = VectorXd::Zero(R.cols());
    for (Index i = 0; i < system->n_nodes(); ++i)
      sum -= R.row(system->normal(i)).transpose();
    return sum.norm() > 1e-6 ? VectorXd(sum * (force / sum.norm())) : sum;
  }



  /* Nodes that are open where the body stands see none of its motions. */
  MatrixXd
  ExistenceCheck::motions_of_touching(const VectorXd &gap) const
  {
    eigen_assert(gap.size() == system->n_nodes());
    constexpr double as_close = 1e-6; // of the widest gap
    MatrixXd         motions  = R;
    const double most = gap.minCoeff() + as_close * gap.cwiseAbs().maxCoeff();
    for (Index i = 0; i < system->n_nodes(); ++i)
      if (gap[i] > most)
        motions.middleRows(system->first[i], system->n_tangents(i) + 1)
          .setZero();
    return motions;
  }



  Existence
  ExistenceCheck::check(const VectorXd &load,
                        const VectorXd &start,
                        const double    reference_force,
                        const VectorXd &gap) const
  {
    eigen_assert(reference_force >= 0);
    eigen_assert(gap.size() == 0 || gap.size() == system->n_nodes());
    Existence result;
    if (R.cols() == 0)
      return result;
    const VectorXd c     = R.transpose() * load;
    const VectorXd c0    = R.transpose() * start;
    const double   floor = noise * std::max(reference_force, load.norm());
    if (c.norm() <= floor)
      return result;
    // What is left of the resultants after the best reactions.
    const VectorXd z = reach(c, system->mu).z;
    result.distance  = z.norm();
    if (result.distance <= std::max(negligible * c.norm(), floor))
      return result;
    const VectorXd w = sharpen(z);
    if (!proves(w, c))
      return result;

    result.admissible = false;
    result.w          = w;
    name_motion(result);
    // a load that pulls all contacts open neither slides nor tips first
    const bool lifts_off = result.motion == Motion::lifts_off;
    result.fraction      = c0.norm() > floor ? limit(c0, c, result.w) : 0.;
    // Nothing of the load can be carried: more friction is the only advice.
    if (result.fraction < 1e-9)
      {
        result.fraction = 0;
        result.w        = w;
        if (gap.size() > 0)
          find_needed_friction(motions_of_touching(gap), c, result);
        if (!result.friction_needed)
          find_needed_friction(R, c, result);
        if (!lifts_off)
          limit(even_pressure(c.norm()), c, result.w);
      }
    if (lifts_off || !proves(result.w, c))
      result.w = w;
    name_motion(result);
    return result;
  }



  void
  ExistenceCheck::name_motion(Existence &result) const
  {
    VectorXd &v = result.v;
    v           = R * result.w;
    result.w /= v.lpNorm<Eigen::Infinity>();
    v /= v.lpNorm<Eigen::Infinity>();
    result.moving = moving_nodes(v);
    result.tight  = tight_nodes(result, 0);
    // On a surface that is not quite even some lift a little more than others.
    constexpr double little = .1;
    if (!result.tight.empty() &&
        tight_nodes(result, little).size() == result.moving.size())
      result.tight = result.moving;
    if (result.tight.empty())
      result.motion = Motion::lifts_off;
    else if (is_translation(v, result.tight) ||
             (result.tight.size() == result.moving.size() &&
              is_mostly_translation(v, result.tight)))
      result.motion = Motion::slides;
    else
      result.motion =
        result.tight.size() == result.moving.size() || stays_flat(result) ?
          Motion::turns :
          Motion::tips;
  }



  std::vector<Index>
  ExistenceCheck::tight_nodes(const Existence &result,
                              const double     little) const
  {
    constexpr double   rounding = 1e-6; // v has 1 as its largest entry
    std::vector<Index> tight;
    for (const Index i : result.moving)
      {
        const double slip =
          result.v.segment(system->first[i], system->n_tangents(i)).norm();
        if (result.v[system->normal(i)] <=
            (system->mu[i] + little) * slip + rounding)
          tight.push_back(i);
      }
    return tight;
  }



  /* The proof of a body that spins lifts it, all nodes alike: friction is not
     associated. One that tips opens some more than others. */
  bool
  ExistenceCheck::stays_flat(const Existence &result) const
  {
    constexpr double little = .1; // of how far it lifts
    double           least = 1, most = 0;
    for (const Index i : result.moving)
      {
        const double away = result.v[system->normal(i)];
        least             = std::min(least, away);
        most              = std::max(most, away);
      }
    return most - least <= little * most;
  }



  /* All nodes of the body with the largest motion, those at rest included:
     nodes that R R^T couples, directly or through others. */
  std::vector<Index>
  ExistenceCheck::moving_nodes(const VectorXd &v) const
  {
    eigen_assert(v.size() == R.rows());
    Index       largest = 0, start = 0;
    const Index n = system->n_nodes();
    // rows of nodes that no motion moves may hold rounding
    const double none = 1e-10 * R.cwiseAbs().maxCoeff();
    v.cwiseAbs().maxCoeff(&largest);
    while (system->first[start + 1] <= largest)
      ++start;
    std::vector<char>  seen(static_cast<std::size_t>(n), 0);
    std::vector<Index> queue              = {start};
    seen[static_cast<std::size_t>(start)] = 1;
    for (std::size_t k = 0; k < queue.size() && Index(queue.size()) < n; ++k)
      {
        const Index    i = queue[k], size = system->n_tangents(i) + 1;
        const auto     own     = R.middleRows(system->first[i], size);
        const MatrixXd coupled = R * own.transpose();
        for (Index j = 0; j < n; ++j)
          {
            const Index begin = system->first[j],
                        rows  = system->first[j + 1] - begin;
            if (!seen[static_cast<std::size_t>(j)] &&
                R.middleRows(begin, rows).norm() > none &&
                coupled.middleRows(begin, rows).norm() >
                  1e-10 * own.norm() * R.middleRows(begin, rows).norm())
              {
                seen[static_cast<std::size_t>(j)] = 1;
                queue.push_back(j);
              }
          }
      }
    std::sort(queue.begin(), queue.end());
    return queue;
  }



  /* The proof of a body that slides may turn it a little besides: friction is
     not associated. */
  bool
  ExistenceCheck::is_mostly_translation(const VectorXd           &v,
                                        const std::vector<Index> &nodes) const
  {
    constexpr double most = .7; // of the root mean square
    if (frames.empty())
      return false;
    Eigen::Vector3d sum     = Eigen::Vector3d::Zero();
    double          squares = 0, n = 0;
    for (const Index i : nodes)
      {
        const Eigen::Vector3d u =
          frames[static_cast<std::size_t>(i)] *
          v.segment(system->first[i], system->n_tangents(i) + 1);
        // Others are at rest, such as those of a body below this one.
        if (u.norm() < 1e-6)
          continue;
        sum += u;
        squares += u.squaredNorm();
        n += 1;
      }
    return sum.norm() > most * std::sqrt(squares * n);
  }



  bool
  ExistenceCheck::is_translation(const VectorXd           &v,
                                 const std::vector<Index> &nodes) const
  {
    eigen_assert(v.size() == R.rows());
    eigen_assert(!nodes.empty());
    const auto motion = [&](const Index i) -> SmallVector {
      return v.segment(system->first[i], system->n_tangents(i) + 1);
    };
    // A node without tangents knows one component of the motion only.
    Index reference = nodes[0];
    for (const Index i : nodes)
      if (system->n_tangents(i) > system->n_tangents(reference))
        reference = i;
    const SmallVector u = motion(reference);
    if (u.norm() < 1e-6)
      return false;
    for (const Index i : nodes)
      {
        SmallVector expected = u.tail(std::min(u.size(), motion(i).size()));
        if (!frames.empty())
          expected = frames[static_cast<std::size_t>(i)].transpose() *
                     (frames[static_cast<std::size_t>(reference)] * u);
        if ((motion(i).tail(expected.size()) - expected).norm() > 1e-6)
          return false;
      }
    return true;
  }
} // namespace conetact::solvers
