// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/large_unknowns.h"

#include "conetact/contact/large_nodes.h"
#include "conetact/iterative/separate_systems.h"
#include "conetact/solvers/null_space.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace conetact::contact
{
  using Eigen::VectorXd;

  namespace
  {
    /** The translation e or the rotation e x (p - c) of all unknowns, as each
     * body sees it in its frame, with the norm 1; rotating nodes turn by the
     * same angle. */
    VectorXd
    common_motion(const model::Bodies &bodies,
                  const Coordinates   &coordinates,
                  const Point<3>      &centre,
                  const Tensor<1, 3>  &axis,
                  const bool           turns)
    {
      const unsigned int dim = bodies.dim;
      VectorXd           u   = VectorXd::Zero(coordinates.n_dofs());
      for (unsigned int b = 0; b < bodies.n_elastic(); ++b)
        for (unsigned int i = 0; i < bodies.structures[b]->n_nodes(); ++i)
          {
            const bodies::Structure &structure = *bodies.structures[b];
            const Tensor<1, 3>       moved     = bodies.in_frame(
              b,
              turns ? cross_product_3d(axis, bodies.position(b, i) - centre) :
                                axis);
            const Eigen::Index first = coordinates.dof(b, i);
            for (unsigned int c = 0; c < dim; ++c)
              u[first + c] = moved[c];
            for (unsigned int c = dim; c < structure.n_components() && turns;
                 ++c)
              u[first + c] = axis[dim == 2 ? 2 : c - dim];
          }
      VectorXd mode = coordinates.values(u);
      // Levels orthogonalise modes against each other: of one size, none is
      // taken for rounding. Where nothing is free a mode is zero.
      mode /= std::max(mode.norm(), 1e-300);
      return mode;
    }

    /* The near null space for aggregation: all bodies together, as if joined.
       About the mean of all nodes turns are nearly orthogonal to translations.
       Functions make them when asked, one at a time, for each is as long as all
       unknowns. */
    std::vector<std::function<VectorXd()>>
    common_motions(const model::Bodies &bodies, const Coordinates &coordinates)
    {
      const unsigned int dim = bodies.dim, n_turns = dim == 2 ? 1 : 3;
      Point<3>           centre;
      unsigned int       n = 0;
      for (unsigned int b = 0; b < bodies.n_elastic(); ++b)
        for (unsigned int i = 0; i < bodies.structures[b]->n_nodes(); ++i, ++n)
          centre += Tensor<1, 3>(bodies.position(b, i));
      centre /= std::max(n, 1u);
      std::vector<std::function<VectorXd()>> modes;
      for (unsigned int k = 0; k < dim + n_turns; ++k)
        {
          Tensor<1, 3> axis;
          axis[k < dim ? k : dim == 2 ? 2 : k - dim] = 1;
          modes.emplace_back([&bodies, &coordinates, centre, axis, k, dim] {
            return common_motion(bodies, coordinates, centre, axis, k >= dim);
          });
        }
      return modes;
    }

    /* Displacements of all dofs by the motions that nothing resists,
       orthonormal. */
    Eigen::MatrixXd
    unresisted_fields(const RigidMotions &motions,
                      const Coordinates  &coordinates)
    {
      const Eigen::MatrixXd unseen = motions.unseen();
      Eigen::MatrixXd       fields(coordinates.n_dofs(), unseen.cols());
      for (Eigen::Index j = 0; j < unseen.cols(); ++j)
        fields.col(j) = motions.field(motions.of_free(unseen.col(j)));
      return solvers::orthonormal_basis(fields);
    }

    /* An unknown for each of these fields: held, they keep bodies from moving
       so, and take no force as long as none drives these. The one that all
       motions together move furthest is held, motions that are left do not move
       it, and of these the next one is chosen, as pivots are. */
    std::vector<Eigen::Index>
    find_pins(const Eigen::MatrixXd &fields, const Coordinates &coordinates)
    {
      std::vector<Eigen::Index> pins;
      Eigen::MatrixXd           moved(coordinates.n_unknowns(), fields.cols());
      for (Eigen::Index j = 0; j < fields.cols(); ++j)
        moved.col(j) = coordinates.values(fields.col(j));
      for (Eigen::Index j = 0; j < fields.cols(); ++j)
        {
          Eigen::Index furthest = 0;
          moved.rowwise().squaredNorm().maxCoeff(&furthest);
          pins.push_back(furthest);
          // The motions that are left with it held.
          const VectorXd row = moved.row(furthest).normalized();
          moved -= (moved * row).eval() * row.transpose();
        }
      return pins;
    }
  } // namespace

  LargeUnknowns::LargeUnknowns(const ElasticSystem            &e,
                               const NodeRules                &supports,
                               const ContactPoints            &p,
                               const RigidMotions             &m,
                               const iterative::Preconditioner by)
    : coordinates(e.bodies, supports, &p, arm_of_rotations(e))
    , further(further_contacts(e, coordinates, p))
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
        if (further)
          springs_of(*further).for_each(visit);
      };
      some.for_each_connection = [&, nodes](const auto &visit) {
        for_each_connection(elastic, coordinates, visit, nodes.get());
        for (const Eigen::Index pin : pins)
          visit({pin});
        if (further)
          springs_of(*further).for_each_connection(visit);
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
