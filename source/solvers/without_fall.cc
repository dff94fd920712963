// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/without_fall.h"

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
    class WithoutFall : public NodalLaws
    {
    public:
      explicit WithoutFall(std::shared_ptr<const NodalLaws> l)
        : laws(std::move(l))
      {}

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
      Aspect
      aspect(const Index  node,
             const double s,
             const double slip,
             const double gap) const override
      {
        return laws->aspect(node, s, slip, gap);
      }
      bool
      has_ellipses() const override
      {
        return laws->has_ellipses();
      }
      Layer
      layer(const Index  node,
            const double r_n,
            const double slip) const override
      {
        return laws->layer(node, r_n, slip);
      }
      bool
      has_cones() const override
      {
        return false;
      }
      bool
      has_layers() const override
      {
        return laws->has_layers();
      }
      Bond
      bond(const Index node, const double slip, const double gap) const override
      {
        return laws->bond(node, slip, gap);
      }
      bool
      is_bonded(const Index node) const override
      {
        return laws->is_bonded(node);
      }
      bool
      has_bonds() const override
      {
        return laws->has_bonds();
      }
      bool
      is_apart(const Index node) const override
      {
        return laws->is_apart(node);
      }
      bool
      is_joined(const Index node) const override
      {
        return laws->is_joined(node);
      }

    private:
      std::shared_ptr<const NodalLaws> laws;
    };
  } // namespace



  ContactProblem
  without_fall(const ContactProblem &problem)
  {
    ContactProblem result = problem;
    result.laws           = std::make_shared<WithoutFall>(problem.laws);
    return result;
  }
} // namespace conetact::solvers
