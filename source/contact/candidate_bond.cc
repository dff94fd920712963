// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/candidate_bond.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::contact
{
  CandidateBond::CandidateBond(const pairing::ContactNode &node,
                               const pairing::Situation   &start)
    : law(node.bond)
    , strength(law->strength(start) * node.bonded_area())
    , cohesion(law->cohesion(start) * node.bonded_area())
    , opened(start.opened)
    , shorn(start.shorn)
    , least(node.least_opening())
    , bears(rest(0, 0) * (strength + cohesion) > 0)
  {}

  /* What softens does so in the increment; what breaks, at its end. */
  double
  CandidateBond::rest(const double slip, const double gap) const
  {
    return law->is_brittle() ?
             law->rest(opened, shorn, least) :
             law->rest(std::max(opened, gap), shorn + slip, least);
  }

  /* T a (1 - w / l), of which less is left where an opening closes again. */
  double
  CandidateBond::pull(const double slip, const double gap) const
  {
    return strength * rest(slip, gap) * law->unloading(gap, opened, least);
  }

  /* The rest of a bond is piecewise linear in opening and slip. A difference
     over a step that is rounding to both is its slope to the right, from a kink
     on as well. */
  solvers::Bond
  CandidateBond::with_slopes(const double slip, const double gap) const
  {
    Assert(least > 0, dealii::ExcMessage("Ways have a size that is rounding."));
    const double now = pull(slip, gap);
    return {now,
            (pull(slip + least, gap) - now) / least,
            (pull(slip, gap + least) - now) / least};
  }

  solvers::FrictionLimit
  CandidateBond::friction(const double slip, const double gap) const
  {
    const double now = rest(slip, gap);
    return {cohesion * now,
            0,
            cohesion * (rest(slip + least, gap) - now) / least,
            cohesion * (rest(slip, gap + least) - now) / least};
  }

  /* A bond that has opened by more than rounding is not whole, even if it still
     bears something. */
  bool
  CandidateBond::is_whole(const double opened_in_all,
                          const double shorn_in_all) const
  {
    return holds() && opened_in_all <= least &&
           law->rest(opened_in_all, shorn_in_all, least) > 0;
  }

  /* The work of pull t(g, s) dg + c rest(g, s) ds along a straight way from the
     start to the end of the increment, by the midpoint rule in a thousand
     steps: where softening ends, or unloading does, the integrand has a
     kink. What is never lost is the same all the way. */
  double
  CandidateBond::fracture(const double gap_at_start,
                          const double gap_at_end,
                          const double slip) const
  {
    Assert(slip >= 0, dealii::ExcMessage("A way of slip has no sign."));
    constexpr unsigned int n   = 1000;
    const double           h   = 1. / n;
    const double           dg  = gap_at_end - gap_at_start;
    double                 sum = 0;
    if (dg == 0 && slip == 0)
      return 0;
    if (!law->may_be_lost())
      return rest(slip, gap_at_end) * (strength * dg + cohesion * slip);
    for (unsigned int k = 0; k < n; ++k)
      {
        const double x = (k + .5) * h, g = gap_at_start + x * dg;
        const double left = rest(x * slip, g);
        sum += strength * left * law->unloading(g, opened, least) * dg +
               cohesion * left * slip;
      }
    return h * sum;
  }
} // namespace conetact::contact
