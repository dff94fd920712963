// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/equal_bodies.h"

#include "conetact/condensed/free_motion.h"

#include <algorithm>
#include <set>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    // A body that is moved by many times its size has this error in the
    // coordinates of its nodes, over the size of its cells.
    constexpr double round_off = 1e-12;

    // Bodies get the same numbers each, by which their forces compare.
    VectorXd
    displacement_without_order(const BodyCoordinates &own,
                               const std::size_t      n_bodies)
    {
      VectorXd p(own.n_unknowns());
      for (std::size_t body = 0; body < n_bodies; ++body)
        {
          const Index n                 = own.end(body) - own.begin(body);
          p.segment(own.begin(body), n) = condensed::numbers_without_order(n);
        }
      return p;
    }

    bool
    are_equal(const Eigen::Ref<const VectorXd> &a,
              const Eigen::Ref<const VectorXd> &b)
    {
      return (a - b).cwiseAbs().maxCoeff() <=
             round_off * a.cwiseAbs().maxCoeff();
    }
  } // namespace



  bool
  may_have_equals(const model::Bodies &bodies)
  {
    std::set<unsigned int> sizes;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      if (!bodies.is_at_rest(body) &&
          !sizes.insert(bodies.structures[body]->n_nodes()).second)
        return true;
    return false;
  }



  std::vector<std::vector<unsigned int>>
  find_equal_bodies(const ElasticSystem &elastic, const BodyCoordinates &own)
  {
    const model::Bodies &bodies = elastic.bodies;
    const std::size_t    n      = bodies.structures.size();
    // A displacement without any symmetry: different matrices answer it by
    // different forces.
    const VectorXd u = own.expand(displacement_without_order(own, n));
    // Structure and foundations are compared each by itself: a stiff one would
    // hide a soft one.
    std::vector<VectorXd> forces = {own.restrict(elastic.structure_forces(u))};
    for (const VectorXd &f : elastic.forces_by_foundation(u))
      forces.push_back(own.restrict(f));
    const auto equal = [&](const unsigned int a, const unsigned int b) {
      const Index n_unknowns = own.end(a) - own.begin(a);
      return n_unknowns == own.end(b) - own.begin(b) &&
             std::all_of(forces.begin(), forces.end(), [&](const VectorXd &f) {
               return are_equal(f.segment(own.begin(a), n_unknowns),
                                f.segment(own.begin(b), n_unknowns));
             });
    };

    std::vector<std::vector<unsigned int>> groups;
    for (unsigned int body = 0; body < n; ++body)
      {
        if (own.begin(body) == own.end(body))
          continue;
        // Bodies of other sizes differ at once, and of the others most are
        // equal: few are compared in full.
        const auto group =
          std::find_if(groups.begin(), groups.end(), [&](const auto &other) {
            return equal(other[0], body);
          });
        if (group == groups.end())
          groups.push_back({body});
        else
          group->push_back(body);
      }
    // A body that equals no other is no group.
    groups.erase(std::remove_if(groups.begin(),
                                groups.end(),
                                [](const auto &group) {
                                  return group.size() == 1;
                                }),
                 groups.end());
    return groups;
  }
} // namespace conetact::contact
