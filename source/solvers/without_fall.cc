// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/without_fall.h"

#include "conetact/solvers/changed_laws.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;

    /**
     * The laws as they are, but for two slopes: friction seems not to fall with
     * the slip, and without a bond to grow with pressure as a cone through the
     * present point does, f / s, if its own slope is less. Values stay those of
     * the laws, so that a residual of zero solves the problem itself.
     */
    class WithoutFall : public ChangedLaws
    {
    public:
      using ChangedLaws::ChangedLaws;

      FrictionLimit
      limit(const Index  node,
            const double s,
            const double slip,
            const double gap) const override
      {
        FrictionLimit result = laws->limit(node, s, slip, gap);
        if (s > 0 && !laws->is_bonded(node))
          result.by_force = std::max(result.by_force, result.value / s);
        result.by_slip = std::max(result.by_slip, 0.);
        return result;
      }
    };

    /** The laws as they are at a part of slips. */
    class SlowerSlip : public ChangedLaws
    {
    public:
      SlowerSlip(std::shared_ptr<const NodalLaws> l, const double p)
        : ChangedLaws(std::move(l))
        , part(p)
      {}

      FrictionLimit
      limit(const Index  node,
            const double s,
            const double slip,
            const double gap) const override
      {
        FrictionLimit result = laws->limit(node, s, part * slip, gap);
        result.by_slip *= part;
        return result;
      }
      Aspect
      aspect(const Index  node,
             const double s,
             const double slip,
             const double gap) const override
      {
        Aspect result = laws->aspect(node, s, part * slip, gap);
        result.by_slip *= part;
        return result;
      }

    private:
      double part;
    };
  } // namespace



  ContactProblem
  without_fall(const ContactProblem &problem)
  {
    ContactProblem result = problem;
    result.laws           = std::make_shared<WithoutFall>(problem.laws);
    return result;
  }



  bool
  grows_from_rest(const ContactProblem &problem)
  {
    if (problem.has_cones())
      return false;
    for (Index i = 0; i < problem.system->n_nodes(); ++i)
      if (problem.laws->limit(i, 1, 0, 0).by_slip > 0)
        return true;
    return false;
  }



  ContactProblem
  with_slower_slip(const ContactProblem &problem, const double part)
  {
    ContactProblem result = problem;
    result.laws           = std::make_shared<SlowerSlip>(problem.laws, part);
    return result;
  }
} // namespace conetact::solvers
