// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/iterative_backend.h"

#include "conetact/backends/large_stiffness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace conetact::contact
{
  namespace
  {
    using Eigen::VectorXd;

    /** Of linear systems without contact: as exact as rounding lets them be. */
    constexpr double to_the_end = 1e-13;

    /** Rigid motions of all bodies together, in the unknowns. */
    Eigen::MatrixXd
    rigid_modes(const Bodies &bodies, const Coordinates &coordinates)
    {
      const unsigned int dim = bodies.dim, n_turns = dim == 2 ? 1 : 3;
      Point<3>           centre;
      unsigned int       n = 0;
      for (const bodies::Structure *structure : bodies.structures)
        for (unsigned int i = 0; i < structure->n_nodes(); ++i, ++n)
          centre += structure->position(i);
      centre /= std::max(n, 1u);
      Eigen::MatrixXd modes(coordinates.n_unknowns(), dim + n_turns);
      for (unsigned int k = 0; k < dim + n_turns; ++k)
        {
          Tensor<1, 3> axis;
          axis[k < dim ? k : dim == 2 ? 2 : k - dim] = 1;
          VectorXd u = VectorXd::Zero(coordinates.n_dofs());
          for (unsigned int b = 0; b < bodies.structures.size(); ++b)
            for (unsigned int i = 0; i < bodies.structures[b]->n_nodes(); ++i)
              {
                const Tensor<1, 3> moved =
                  k < dim ? axis :
                            cross_product_3d(axis,
                                             bodies.structures[b]->position(i) -
                                               centre);
                for (unsigned int c = 0; c < dim; ++c)
                  u[coordinates.dof(b, i) + c] = moved[c];
              }
          modes.col(k) = coordinates.values(u);
          modes.col(k) /= std::max(modes.col(k).norm(), 1e-300);
        }
      return modes;
    }

    /** Else some motion of a body that floats may be open to all directions. */
    bool
    has_friction(const ContactPoints &points, const unsigned int body)
    {
      return std::any_of(points.begin(),
                         points.end(),
                         [&](const ContactPoint &point) {
                           const pairing::ContactNode &node = *point.node;
                           const bool                  is_its =
                             node.body == body ||
                             (!node.masters.empty() && node.master == body);
                           return is_its && node.mu_1 > 0 && node.mu_2 > 0;
                         });
    }

    /** Entries of K on its diagonal, of all dofs. */
    VectorXd
    diagonal_of(const ElasticSystem &elastic, const Eigen::Index n_dofs)
    {
      VectorXd diagonal = VectorXd::Zero(n_dofs);
      elastic.for_each_element(
        [&](const std::vector<unsigned int> &dofs, const double *matrix) {
          for (std::size_t i = 0; i < dofs.size(); ++i)
            diagonal[dofs[i]] += matrix[i * dofs.size() + i];
        });
      return diagonal;
    }

    /** Nodes of contacts whose slave is much harder than its master, with those
     * of the master: numbers of Coordinates. */
    std::set<unsigned int>
    hard_slaves(const ElasticSystem &elastic,
                const Coordinates   &coordinates,
                const ContactPoints &points)
    {
      constexpr double much = 20;
      struct Pair
      {
        std::set<unsigned int> nodes;
        double                 slave = 0, master = 0; ///< hardest
      };
      std::map<std::pair<unsigned int, unsigned int>, Pair> pairs;
      VectorXd                                              diagonal;
      const auto add = [&](const unsigned int body,
                           const unsigned int node,
                           Pair              &pair,
                           double            &hardest) {
        pair.nodes.insert(coordinates.number(body, node));
        hardest = std::max(hardest, diagonal[coordinates.dof(body, node)]);
      };
      for (const ContactPoint &point : points)
        {
          const pairing::ContactNode &node = *point.node;
          if (node.masters.empty())
            continue;
          if (diagonal.size() == 0)
            diagonal = diagonal_of(elastic, coordinates.n_dofs());
          Pair &pair = pairs[{node.body, node.master}];
          add(node.body, node.node, pair, pair.slave);
          for (const auto &[master, weight] : node.masters)
            add(node.master, master, pair, pair.master);
        }
      std::set<unsigned int> nodes;
      for (auto &[bodies, pair] : pairs)
        if (pair.slave > much * pair.master)
          nodes.merge(pair.nodes);
      return nodes;
    }

    /** Whether nodes with unknowns of their own contacts are masters, too. */
    bool
    masters_are_slaves(const ContactPoints &points)
    {
      std::set<std::pair<unsigned int, unsigned int>> slaves;
      for (const ContactPoint &point : points)
        if (!point.node->masters.empty())
          slaves.insert({point.node->body, point.node->node});
      for (const ContactPoint &point : points)
        for (const auto &[node, weight] : point.node->masters)
          if (slaves.count({point.node->master, node}) > 0)
            return true;
      return false;
    }
  } // namespace



  std::string
  IterativeBackend::obstacle(const Bodies        &bodies,
                             const ContactPoints &points,
                             const RigidMotions  &motions)
  {
    for (std::size_t b = 0; b < bodies.structures.size(); ++b)
      if (bodies.structures[b]->n_components() != bodies.dim)
        return "solves continua that are held, and " + bodies.called(b) +
               (bodies.is_rigid(b) ? " is free" : " is a frame");
    if (!bodies.frames().empty())
      return "knows contacts of undeformed bodies only, not those that slide "
             "far, nor bodies that turn";
    if (points.n_bound() > 0)
      return "knows no ties and no bilateral contacts";
    for (const unsigned int body : motions.body_of_free())
      if (!has_friction(points, body))
        return "solves bodies that supports or friction hold, and " +
               bodies.called(body) + " is not";
    if (points.share_nodes())
      return "wants each node in one contact";
    if (points.have_prescribed_slip())
      return "knows no friction along what supports hold";
    for (const ContactPoint &point : points)
      if (!point.node->slaves.empty())
        return "wants a contact node for each node of a mortar surface, and "
               "supports or other contacts hold some";
    if (masters_are_slaves(points))
      return "wants nodes of one body to face those of another, but not both "
             "each other";
    return "";
  }

  IterativeBackend::IterativeBackend(const ElasticSystem &e,
                                     const NodeRules     &supports,
                                     const ContactPoints &points,
                                     const RigidMotions  &m)
    : ElasticBackend(WorkingSet(points.layout()))
    , elastic(e)
    , motions(m)
    , coordinates(elastic.bodies, supports, &points)
  {
    auto system = std::make_shared<solvers::ContactSystem>(points.layout());
    backends::LargeStiffness given;
    given.for_each_element = [&](const UnknownsVisitor &visit) {
      for_each_element(elastic, coordinates, visit);
    };
    given.node_of  = coordinates.node_of_unknowns();
    given.modes    = rigid_modes(elastic.bodies, coordinates);
    given.contact  = points.layout();
    given.surface  = hard_slaves(elastic, coordinates, points);
    given.position = [&](const unsigned int number) {
      const auto [body, node] = coordinates.locate(number);
      const Point<3> p        = elastic.bodies.structures[body]->position(node);
      return std::array<double, 3>{{p[0], p[1], p[2]}};
    };
    system->large =
      backends::make_large_system(std::move(given), elastic.bodies.dim);
    const VectorXd diagonal = system->large->diagonal();
    system->large_diagonal  = diagonal.tail(system->n_unknowns());
    system->null_space      = motions.null_space();
    if (diagonal.size() > 0 && diagonal.mean() > 0)
      stiffness_scale = std::exp2(std::round(std::log2(diagonal.mean())));
    contact_system = system;
  }

  VectorXd
  IterativeBackend::resultants(const VectorXd &load) const
  {
    constexpr double       rounding = 1e-13; // of a sum
    const Eigen::MatrixXd &free     = motions.unresisted();
    VectorXd               result(free.cols());
    for (Eigen::Index j = 0; j < free.cols(); ++j)
      {
        const VectorXd terms =
          coordinates.values(motions.field(motions.of_free(free.col(j))))
            .cwiseProduct(load);
        const double sum = terms.sum();
        result[j] = std::abs(sum) > rounding * terms.lpNorm<1>() ? sum : 0.;
      }
    return result;
  }

  void
  IterativeBackend::reduce_one(const VectorXd &forces,
                               const VectorXd &prescribed,
                               LoadCase       &load)
  {
    load.b = coordinates.restrict(forces - elastic.internal_forces(prescribed));
    load.f = load.b;
  }

  LoadCase
  IterativeBackend::nothing() const
  {
    LoadCase load;
    load.b = VectorXd::Zero(coordinates.n_unknowns());
    load.f = load.b;
    return load;
  }

  Eigen::MatrixXd
  IterativeBackend::expand(const std::vector<const LoadCase *> &loads,
                           const std::vector<VectorXd>         &primal) const
  {
    Eigen::MatrixXd w(coordinates.n_dofs(),
                      static_cast<Eigen::Index>(loads.size()));
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        VectorXd u = primal[k];
        // Where nothing may touch no solver has been asked.
        if (set.layout().n_unknowns() == 0)
          {
            u = VectorXd::Zero(loads[k]->f.size());
            for (unsigned int i = 0; i < 2; ++i) // and the rounding of that
              if (const auto step = contact_system->large->solve(
                    {},
                    contact_system->large->multiply(u) - loads[k]->f,
                    to_the_end))
                u += step->du;
          }
        w.col(static_cast<Eigen::Index>(k)) =
          coordinates.expand(u) + loads[k]->prescribed;
      }
    return w;
  }

  LoadCase
  IterativeBackend::reduce_unbalanced(const VectorXd &unbalanced) const
  {
    LoadCase change;
    change.b = -coordinates.restrict(unbalanced);
    change.f = change.b;
    return change;
  }

  VectorXd
  IterativeBackend::correction(const LoadCase &, const VectorXd &primal) const
  {
    return coordinates.expand(primal);
  }
} // namespace conetact::contact
