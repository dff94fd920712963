// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/increment_laws.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <limits>
#include <utility>

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

  IncrementLaws::IncrementLaws(const ContactPoints            &p,
                               std::vector<pairing::Situation> known,
                               const Eigen::VectorXd          &r,
                               const double                    duration,
                               const std::vector<bool>        &wet)
    : points(p)
  {
    Assert(r.size() >= points.n_unknowns(),
           dealii::ExcMessage("Each candidate has a reaction at the start."));
    Assert(wet.empty() || wet.size() == points.size(),
           dealii::ExcMessage("Each candidate is wet or not."));
    AssertDimension(known.size(), points.size());
    all.reserve(known.size());
    for (std::size_t i = 0; i < known.size(); ++i)
      {
        const Index first = points[i].first, nt = points[i].normal() - first;
        const CandidateLaw &law = all.emplace_back(
          points,
          i,
          CandidateStart{std::move(known[i]), r.segment(first, nt), duration},
          i < wet.size() && wet[i]);
        elliptic = elliptic || law.is_elliptic();
        soft     = soft || law.is_soft();
        bonded =
          bonded || law.bond().holds() || law.is_wet() || law.is_joined();
      }
  }

  /* A copy that wears by a part of the coefficient: an increment solved in
     halves tells how far Wear acceleration is off. */
  std::shared_ptr<const IncrementLaws>
  IncrementLaws::with_wear(const double part) const
  {
    Assert(part >= 0, dealii::ExcMessage("Nothing grows by wear."));
    const auto result = std::make_shared<IncrementLaws>(*this);
    for (CandidateLaw &law : result->all)
      law.set_wear(part);
    return result;
  }

  /* Methods that need a second-order cone take constant coefficients only: no
     bond, no ellipse whose aspect varies, and no mu of p or v. */
  bool
  IncrementLaws::has_cones() const
  {
    return !bonded && !elliptic &&
           std::all_of(all.begin(), all.end(), [](const CandidateLaw &law) {
             return law.has_cone();
           });
  }

  /* What opens or slips in the increment holds no more than what has not. */
  solvers::Holding
  IncrementLaws::holding(const Eigen::VectorXd &r) const
  {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    const auto       n           = static_cast<Index>(all.size());
    solvers::Holding most{Eigen::VectorXd::Zero(n),
                          Eigen::VectorXd::Zero(n),
                          Eigen::VectorXd::Zero(n)};
    for (Index i = 0; i < n; ++i)
      {
        const CandidateLaw &law = at(i);
        if (!law.sees())
          continue;
        most.push[i] = without_end;
        if (law.is_joined())
          {
            most.friction[i] = most.pull[i] = without_end;
            continue;
          }
        const pairing::Situation &start = law.start().situation;
        most.friction[i] = law.most_friction(r[points[i].normal()]);
        most.pull[i]     = law.pull(0, std::max(start.gap, start.opened)).value;
      }
    return most;
  }

  Eigen::VectorXd
  IncrementLaws::largest_coefficients() const
  {
    return of_each([&](const Index i) { return at(i).largest_coefficient(); });
  }

  Eigen::VectorXd
  IncrementLaws::coefficients(const solvers::ContactState &end) const
  {
    return of_each([&](const Index i) { return at(i).coefficient(end); });
  }

  /* Ways of increments add up to the way so far, s of Friction coefficient.
     What sticks has none, whatever the rounding of v. */
  Eigen::VectorXd
  IncrementLaws::slips(const solvers::ContactState &end) const
  {
    AssertDimension(end.node.size(), all.size());
    return of_each([&](const Index i) {
      return end.node[static_cast<std::size_t>(i)] == solvers::NodeState::slip ?
               slip_in(at(i).seen(end)) :
               0.;
    });
  }

  Eigen::VectorXd
  IncrementLaws::shears(const solvers::ContactState &end) const
  {
    AssertDimension(end.node.size(), all.size());
    return of_each([&](const Index i) {
      const solvers::NodeState state = end.node[static_cast<std::size_t>(i)];
      return state == solvers::NodeState::slip ||
                 (state == solvers::NodeState::open && at(i).bond().holds()) ?
               slip_in(at(i).seen(end)) :
               0.;
    });
  }

  /* Archard's law k p |ds| with pressure and slip of the end of the increment,
     as what wears at once has it in the increment itself. */
  Eigen::VectorXd
  IncrementLaws::wear(const solvers::ContactState &end) const
  {
    const Eigen::VectorXd way = slips(end);
    return of_each([&](const Index i) {
      const auto &law = points[i].node->layer;
      if (!law)
        return 0.;
      const pairing::Situation here =
        at(i).situation(end.r[points[i].normal()], way[i]);
      return way[i] * (at(i).start().part_of_wear * here.pressure *
                       law->wear_by_pressure(here));
    });
  }

  Eigen::VectorXd
  IncrementLaws::areas() const
  {
    return of_each(
      [&](const Index i) { return points[i].node->covered_area(); });
  }

  /* Of the end of an increment: the largest pressure so far is what a layer
     unloads from. Only what is accepted is asked for a layer that falls; on the
     way to it iterates may press by anything. */
  Eigen::VectorXd
  IncrementLaws::pressures(const solvers::ContactState &end) const
  {
    return of_each([&](const Index i) {
      const pairing::Situation here =
        at(i).situation(end.r[points[i].normal()], 0);
      const pairing::ContactNode &node = *points[i].node;
      if (node.layer && node.layer->is_soft() && here.pressure > 0)
        refuse_falling_closing(node, here);
      return here.pressure;
    });
  }

  /* Gaps without what a layer stretches by. A node that is closed counts 0: the
     rounding of its gap must not soften its bond. */
  Eigen::VectorXd
  IncrementLaws::openings(const solvers::ContactState &end) const
  {
    AssertDimension(end.node.size(), all.size());
    return of_each([&](const Index i) {
      return at(i).bond().holds() && end.node[static_cast<std::size_t>(i)] ==
                                       solvers::NodeState::open ?
               std::max(0., at(i).seen(end).tail<1>()(0)) :
               0.;
    });
  }

  Eigen::VectorXd
  IncrementLaws::fracture(const Eigen::VectorXd       &before,
                          const solvers::ContactState &end) const
  {
    AssertDimension(before.size(), static_cast<Index>(all.size()));
    const Eigen::VectorXd after = openings(end), way = shears(end);
    return of_each([&](const Index i) {
      const CandidateBond &bond = at(i).bond();
      return bond.holds() ? bond.fracture(before[i], after[i], way[i]) : 0.;
    });
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
