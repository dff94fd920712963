// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/large_unknowns.h"

#include "conetact/contact/large_motions.h"
#include "conetact/contact/large_nodes.h"
#include "conetact/iterative/separate_systems.h"

#include <deal.II/base/exceptions.h>

#include <utility>

namespace conetact::contact
{
  using Eigen::VectorXd;

  LargeUnknowns::LargeUnknowns(const ElasticSystem            &e,
                               const NodeRules                &supports,
                               const ContactPoints            &p,
                               const RigidMotions             &m,
                               const iterative::Preconditioner by)
    : coordinates(e.bodies, supports, &p, arm_of_rotations(e))
    , further(further_contacts(e.bodies, coordinates, p))
    , elastic(e)
    , points(p)
    , motions(m)
    , nowhere(unresisted_fields(motions, coordinates))
  {
    using SharedNodes = std::shared_ptr<const SomeNodesOfBodies>;
    iterative::LargeStiffness given;
    const auto                pins = find_pins(nowhere, coordinates);
    const double              pinned =
      pins.empty() ? 0. : diagonal_of(elastic, coordinates.n_dofs()).mean();
    const auto some_of = [&](const SharedNodes &nodes) {
      iterative::Elements some;
      some.for_each = [&, nodes](const UnknownsVisitor &visit) {
        for_each_element(elastic, coordinates, visit, nodes.get());
        for (const Eigen::Index pin : pins)
          visit({pin}, &pinned);
      };
      some.for_each_connection = [&, nodes](const auto &visit) {
        for_each_connection(elastic, coordinates, visit, nodes.get());
        for (const Eigen::Index pin : pins)
          visit({pin});
      };
      return some;
    };
    given.elements           = some_of(nullptr);
    given.elements.that_have = [&](const std::vector<bool> &unknowns) {
      return some_of(std::make_shared<const SomeNodesOfBodies>(
        nodes_of(elastic.bodies, coordinates, unknowns)));
    };
    given.node_of        = nodes_of_unknowns(coordinates);
    given.modes          = common_motions(elastic.bodies, coordinates);
    given.contact        = coordinates.contact_axes().layout();
    SpecialNodes special = special_nodes(elastic, coordinates, points);
    given.preconditioner = by;
    given.surface        = std::move(special.together);
    given.side           = sides_of_ties(elastic.bodies, coordinates);
    given.position       = [&](const unsigned int block) {
      const auto [body, node] = coordinates.locate(number_of_node(block));
      const Point<3> at       = elastic.bodies.structures[body]->position(node);
      return std::array<double, 3>{{at[0], at[1], at[2]}};
    };
    system = iterative::make_separate_systems(std::move(given),
                                              special.direct,
                                              elastic.bodies.dim);
    if (further)
      system = iterative::make_with_further_contacts(system, *further);
  }

  VectorXd
  LargeUnknowns::own(VectorXd x) const
  {
    return system->own(std::move(x));
  }

  VectorXd
  LargeUnknowns::elastic_part(const VectorXd &x) const
  {
    VectorXd all = system->all(x);
    return further ? further->without(all) : all;
  }

  VectorXd
  LargeUnknowns::displacements(const VectorXd &x) const
  {
    return coordinates.expand(elastic_part(x));
  }

  VectorXd
  LargeUnknowns::field(const VectorXd &x) const
  {
    return without_motion(displacements(x));
  }

  /* What nothing resists is held at one unknown for each motion (find_pins()),
     by an arbitrary amount: it is no deformation. */
  VectorXd
  LargeUnknowns::without_motion(VectorXd w) const
  {
    if (nowhere.cols() > 0)
      w -= nowhere * (nowhere.transpose() * w).eval();
    return w;
  }

  VectorXd
  LargeUnknowns::values(const VectorXd &u) const
  {
    VectorXd q = coordinates.values(u);
    return further ? further->with_displacements(q) : q;
  }

  VectorXd LargeUnknowns::restrict(const VectorXd &forces) const
  {
    return own(coordinates.restrict(forces));
  }

  VectorXd
  LargeUnknowns::displacements(const VectorXd &load, const VectorXd &x) const
  {
    if (points.n_unknowns() > 0)
      return displacements(x);
    /** As exact as rounding lets it be. */
    constexpr double to_the_end = 1e-13;
    const auto       f          = system->keep(load);
    auto             u          = system->keep(VectorXd::Zero(load.size()));
    for (unsigned int i = 0; i < 2; ++i) // and the rounding of that
      if (const auto step = system->solve(
            {}, system->add(system->multiply(u), -1, f), {to_the_end}))
        u = system->add(u, 1, step->du);
    return coordinates.expand(system->all(system->numbers(u)));
  }

  VectorXd
  LargeUnknowns::motions_in(const VectorXd &x) const
  {
    return motions.free_in(field(x));
  }

  VectorXd
  LargeUnknowns::of_motions(const VectorXd &a) const
  {
    return values(motions.field(motions.of_free(a)));
  }

  VectorXd
  LargeUnknowns::resistance(const VectorXd &a) const
  {
    return restrict(elastic.spring_forces(motions.field(motions.of_free(a))));
  }
} // namespace conetact::contact
