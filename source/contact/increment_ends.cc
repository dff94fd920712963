// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the laws of an increment say of its end.

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/increment_laws.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /**
     * Refuses a layer that closes less under more pressure, which has no one
     * answer: C(p) p must not fall from p to p (1 + 1e-6). A fall by a
     * thousandth of this part is rounding.
     */
    void
    refuse_falling_closing(const pairing::ContactNode &node,
                           const pairing::Situation   &at)
    {
      constexpr double   part = 1e-6;
      pairing::Situation more = at;
      more.pressure *= 1 + part;
      const auto closing = [&](const pairing::Situation &here) {
        return here.pressure * (node.layer->is_unloaded(at) ?
                                  node.layer->unloading_by_pressure(here) :
                                  node.layer->closing_by_pressure(here));
      };
      if (closing(more) < (1 - 1e-3 * part) * closing(at))
        throw InputError(
          "A contact at " + to_text(node.position) +
          " closes less under more pressure, at p = " + to_text(at.pressure) +
          ": its closing is Compliance times p. Let Compliance fall more "
          "slowly than 1/p.");
    }
  } // namespace

  /* Displacements of the sides without what the layer between them closes or
     gives way by: the slip that laws of friction and wear count. */
  Eigen::VectorXd
  IncrementLaws::seen(const std::size_t            i,
                      const solvers::ContactState &end) const
  {
    AssertIndexRange(points[i].normal(), end.v.size());
    AssertIndexRange(points[i].normal(), end.r.size());
    const ContactPoint &point = points[i];
    const Index         size  = point.normal() - point.first + 1;
    return solvers::see(
      [&](const double r_n, const double slip) {
        return layer(static_cast<Index>(i), r_n, slip);
      },
      end.v.segment(point.first, size),
      end.r.segment(point.first, size));
  }

  double
  IncrementLaws::slip(const std::size_t            i,
                      const solvers::ContactState &end) const
  {
    const Eigen::VectorXd v = seen(i, end);
    return v.head(v.size() - 1).norm();
  }

  /* mu = f / r_n at the end, the slope of the limit f where nothing presses. A
     fluid has its part of r_n without friction. */
  Eigen::VectorXd
  IncrementLaws::coefficients(const solvers::ContactState &end) const
  {
    Eigen::VectorXd mu(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const auto   k   = static_cast<Index>(i);
        const double r_n = end.r[points[i].normal()] - fluids[i];
        const double way = slip(i, end);
        auto         now = friction(i, 0, r_n, way);
        if (has_axes(i))
          now = mean_of(i, now, friction(i, 1, r_n, way));
        mu[k] = r_n > 0 ? now.value / r_n : now.by_force;
      }
    return mu;
  }

  /* Ways of increments add up to the way so far, s of Friction coefficient.
     What sticks has none, whatever the rounding of v; a bond that has opened is
     shorn as well. */
  Eigen::VectorXd
  IncrementLaws::slips(const solvers::ContactState &end) const
  {
    AssertDimension(end.node.size(), start.size());
    Eigen::VectorXd way =
      Eigen::VectorXd::Zero(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      if (end.node[i] == solvers::NodeState::slip ||
          (end.node[i] == solvers::NodeState::open && bonds[i]))
        way[static_cast<Index>(i)] = slip(i, end);
    return way;
  }

  /* Archard's law k p |ds| with pressure and slip of the end of the increment,
     as what wears at once has it in the increment itself. */
  Eigen::VectorXd
  IncrementLaws::wear(const solvers::ContactState &end) const
  {
    Eigen::VectorXd depth = slips(end);
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const auto               k   = static_cast<Index>(i);
        const auto               law = points[i].node->layer;
        const pairing::Situation here =
          situation(i, end.r[points[i].normal()], depth[k]);
        depth[k] *=
          law ? part_of_wear * here.pressure * law->wear_by_pressure(here) : 0.;
      }
    return depth;
  }

  /* Of the end of an increment: the largest pressure so far is what a layer
     unloads from. Only what is accepted is asked for a layer that falls; on the
     way to it iterates may press by anything. */
  Eigen::VectorXd
  IncrementLaws::pressures(const solvers::ContactState &end) const
  {
    Eigen::VectorXd p(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      {
        const pairing::Situation at =
          situation(i, end.r[points[i].normal()], 0);
        const pairing::ContactNode &node = *points[i].node;
        if (node.layer && node.layer->is_soft() && at.pressure > 0)
          refuse_falling_closing(node, at);
        p[static_cast<Index>(i)] = at.pressure;
      }
    return p;
  }

  /* Gaps without what a layer stretches by. A node that is closed counts 0: the
     rounding of its gap must not soften its bond. */
  Eigen::VectorXd
  IncrementLaws::openings(const solvers::ContactState &end) const
  {
    AssertDimension(end.node.size(), start.size());
    Eigen::VectorXd gaps =
      Eigen::VectorXd::Zero(static_cast<Index>(start.size()));
    for (std::size_t i = 0; i < start.size(); ++i)
      if (bonds[i] && end.node[i] == solvers::NodeState::open)
        gaps[static_cast<Index>(i)] = std::max(0., seen(i, end).tail<1>()(0));
    return gaps;
  }

  Eigen::VectorXd
  IncrementLaws::fracture(const Eigen::VectorXd       &before,
                          const solvers::ContactState &end) const
  {
    AssertDimension(before.size(), static_cast<Index>(start.size()));
    Eigen::VectorXd work =
      Eigen::VectorXd::Zero(static_cast<Index>(start.size()));
    const Eigen::VectorXd after = openings(end), way = slips(end);
    for (std::size_t i = 0; i < start.size(); ++i)
      if (const auto k = static_cast<Index>(i); bonds[i])
        work[k] = fracture(i, before[k], after[k], way[k]);
    return work;
  }

  /* The work of pull t(g, s) dg + c rest(g, s) ds along a straight way from the
     start to the end of the increment, by the midpoint rule in a thousand
     steps: where softening ends, or unloading does, the integrand has a
     kink. */
  double
  IncrementLaws::fracture(const std::size_t i,
                          const double      gap_at_start,
                          const double      gap_at_end,
                          const double      slip) const
  {
    Assert(slip >= 0, dealii::ExcMessage("A way of slip has no sign."));
    constexpr unsigned int n   = 1000;
    const double           h   = 1. / n;
    const double           dg  = gap_at_end - gap_at_start;
    double                 sum = 0;
    if (dg == 0 && slip == 0)
      return 0;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double x = (k + .5) * h, g = gap_at_start + x * dg;
        sum +=
          pull(i, x * slip, g) * dg + cohesion[i] * rest(i, x * slip, g) * slip;
      }
    return h * sum;
  }

  /* A bond that has opened by more than rounding is not whole, even if it still
     bears something. */
  bool
  IncrementLaws::is_whole(const std::size_t i,
                          const double      opened,
                          const double      slipped) const
  {
    AssertIndexRange(i, start.size());
    const pairing::ContactNode &node = *points[i].node;
    return bonds[i] && opened <= node.least_opening() &&
           node.bond->rest(opened, slipped, node.least_opening()) > 0;
  }

  bool
  has_nodal_laws(const ContactPoints &points)
  {
    return std::any_of(points.begin(),
                       points.end(),
                       [](const ContactPoint &point) {
                         return point.node->friction != nullptr;
                       });
  }
} // namespace conetact::contact
