// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/iterative_backend.h"

#include "conetact/backends/separate_systems.h"
#include "conetact/solvers/null_space.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
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
                const bodies::Structure &structure = *bodies.structures[b];
                const Tensor<1, 3>       moved =
                  k < dim ?
                          axis :
                          cross_product_3d(axis, structure.position(i) - centre);
                const Eigen::Index first = coordinates.dof(b, i);
                for (unsigned int c = 0; c < dim; ++c)
                  u[first + c] = moved[c];
                for (unsigned int c = dim;
                     c < structure.n_components() && k >= dim;
                     ++c)
                  u[first + c] = axis[dim == 2 ? 2 : c - dim];
              }
          modes.col(k) = coordinates.values(u);
          modes.col(k) /= std::max(modes.col(k).norm(), 1e-300);
        }
      return modes;
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

    bool
    is_frame(const bodies::Structure &structure, const unsigned int dim)
    {
      return structure.n_components() > dim;
    }

    /** Rotations of frames move the ends of such arms: entries of K are alike
     * then. A power of two, that nothing is rounded. */
    double
    arm_of_rotations(const ElasticSystem &elastic)
    {
      double       rotations = 0, displacements = 0;
      unsigned int n_rotations = 0, n_displacements = 0;
      for (const bodies::Structure *structure : elastic.bodies.structures)
        if (is_frame(*structure, elastic.bodies.dim))
          structure->for_each_element(
            [&](const std::vector<unsigned int> &dofs, const double *matrix) {
              for (std::size_t i = 0; i < dofs.size(); ++i)
                {
                  const double entry = matrix[i * dofs.size() + i];
                  const bool   turns =
                    dofs[i] % structure->n_components() >= elastic.bodies.dim;
                  (turns ? rotations : displacements) += entry;
                  ++(turns ? n_rotations : n_displacements);
                }
            });
      if (!(rotations > 0 && displacements > 0))
        return 1;
      const double arm =
        std::sqrt(rotations / n_rotations * n_displacements / displacements);
      return std::exp2(std::round(std::log2(arm)));
    }

    /** Rotations of a node are a node by themselves: blocks have `dim` unknowns
     * at most. */
    unsigned int
    node_of_rotations(const unsigned int number)
    {
      return 2 * number + 1;
    }
    unsigned int
    node_of_displacements(const unsigned int number)
    {
      return 2 * number;
    }
    unsigned int
    number_of_node(const unsigned int node)
    {
      return node / 2;
    }

    /** Of each unknown. */
    std::vector<unsigned int>
    nodes_of_unknowns(const Coordinates &coordinates)
    {
      std::vector<unsigned int> nodes    = coordinates.node_of_unknowns();
      const std::vector<bool>   rotation = coordinates.are_rotations();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        nodes[k] = rotation[k] ? node_of_rotations(nodes[k]) :
                                 node_of_displacements(nodes[k]);
      return nodes;
    }

    /** Contacts and ties of one body with another. */
    struct Pair
    {
      std::set<unsigned int> nodes;                 ///< of both surfaces
      double                 slave = 0, master = 0; ///< hardest entry of K
    };
    using Pairs = std::map<std::pair<unsigned int, unsigned int>, Pair>;

    Pairs
    find_pairs(const ElasticSystem &elastic,
               const Coordinates   &coordinates,
               const ContactPoints &points)
    {
      Pairs      pairs;
      VectorXd   diagonal;
      const auto add = [&](const unsigned int body,
                           const unsigned int node,
                           Pair              &pair,
                           double            &hardest) {
        pair.nodes.insert(
          node_of_displacements(coordinates.number(body, node)));
        hardest = std::max(hardest, diagonal[coordinates.dof(body, node)]);
      };
      for (const ContactPoint &point : points.all())
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
      return pairs;
    }

    /** Bodies that meet each other, directly or by others: the first of each
     * body. */
    std::vector<unsigned int>
    groups_of_bodies(const Pairs &pairs, const std::size_t n)
    {
      std::vector<unsigned int> group(n);
      std::iota(group.begin(), group.end(), 0);
      for (const auto &[who, pair] : pairs)
        {
          const unsigned int from =
                               std::max(group[who.first], group[who.second]),
                             to = std::min(group[who.first], group[who.second]);
          std::replace(group.begin(), group.end(), from, to);
        }
      return group;
    }

    /** Nodes that are not left to iterations. */
    struct SpecialNodes
    {
      std::set<unsigned int> direct;   ///< see DirectSystem
      std::set<unsigned int> together; ///< see SurfaceSmoother
    };

    /** Slaves that are much harder than their masters are smoothed with these,
     * and so are frames with what meets them, unless there is little of it. */
    SpecialNodes
    special_nodes(const ElasticSystem &elastic,
                  const Coordinates   &coordinates,
                  const ContactPoints &points)
    {
      constexpr double much   = 20;
      const Bodies    &bodies = elastic.bodies;
      const auto       frame  = [&](const unsigned int body) {
        return is_frame(*bodies.structures[body], bodies.dim);
      };
      // what factors of Newton's matrix take no more time for than iterations
      const unsigned int few   = bodies.dim == 2 ? 10000 : 3000;
      const Pairs        pairs = find_pairs(elastic, coordinates, points);
      const std::size_t  n     = bodies.structures.size();
      std::vector<unsigned int> group = groups_of_bodies(pairs, n);
      std::vector<unsigned int> n_dofs(n, 0);
      std::vector<bool>         has_frame(n, false);
      for (unsigned int b = 0; b < n; ++b)
        {
          n_dofs[group[b]] += bodies.structures[b]->n_dofs();
          has_frame[group[b]] = has_frame[group[b]] || frame(b);
        }
      SpecialNodes nodes;
      for (const auto &[who, pair] : pairs)
        if (pair.slave > much * pair.master || frame(who.first) ||
            frame(who.second))
          nodes.together.insert(pair.nodes.begin(), pair.nodes.end());
      for (unsigned int b = 0; b < n; ++b)
        {
          const bool meets_none =
            frame(b) && std::count(group.begin(), group.end(), group[b]) == 1;
          const bool is_direct =
            meets_none || (has_frame[group[b]] && n_dofs[group[b]] <= few);
          if (!is_direct && !frame(b))
            continue;
          for (unsigned int i = 0; i < bodies.structures[b]->n_nodes(); ++i)
            {
              const unsigned int number = coordinates.number(b, i);
              (is_direct ? nodes.direct : nodes.together)
                .insert(
                  {node_of_displacements(number), node_of_rotations(number)});
            }
        }
      return nodes;
    }

    using Nodes = std::set<std::pair<unsigned int, unsigned int>>;

    /** Whether a node has several points, bound ones included. */
    bool
    share_nodes(const ContactPoints &points)
    {
      Nodes nodes;
      for (const ContactPoint &point : points.all())
        if (!nodes.insert({point.node->body, point.node->node}).second)
          return true;
      return false;
    }

    /** Whether nodes with unknowns of their own contacts are masters, too. */
    bool
    masters_are_slaves(const ContactPoints &points)
    {
      Nodes slaves;
      for (const ContactPoint &point : points.all())
        if (!point.node->masters.empty() || point.node->is_bound())
          slaves.insert({point.node->body, point.node->node});
      for (const ContactPoint &point : points.all())
        for (const auto &[node, weight] : point.node->masters)
          if (slaves.count({point.node->master, node}) > 0)
            return true;
      return false;
    }
    /** Of all dofs. */
    double
    mean_stiffness(const ElasticSystem &elastic)
    {
      double sum = 0, n = 0;
      elastic.for_each_element(
        [&](const std::vector<unsigned int> &dofs, const double *matrix) {
          for (std::size_t i = 0; i < dofs.size(); ++i, ++n)
            sum += matrix[i * dofs.size() + i];
        });
      return n > 0 ? sum / n : 0.;
    }

    /** Displacements of all dofs by the motions that nothing resists,
     * orthonormal. */
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

    /**
     * An unknown for each of these fields, which together they move far: held,
     * they keep bodies from moving so, and take no force as long as none drives
     * these.
     */
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
          // what is left of the motions with it held
          const VectorXd row = moved.row(furthest).normalized();
          moved -= (moved * row).eval() * row.transpose();
        }
      return pins;
    }

    bool
    is_along(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      return std::abs(a * b) > 1 - 1e-12;
    }

    /** Whether supports hold all masters of a node along a direction. */
    bool
    are_masters_held(const pairing::ContactNode &node,
                     const Tensor<1, 3>         &direction,
                     const NodeRules            &supports)
    {
      return std::all_of(
        node.masters.begin(), node.masters.end(), [&](const auto &master) {
          const NodeRule *rule = supports.find(node.master, master.first);
          return master.second == 0 ||
                 (rule != nullptr && rule->masters.empty() &&
                  is_spanned(direction, directions(rule->held)));
        });
    }

    /** Whether what supports hold of a bound node is bound there as well, or
     * not at all: it is theirs then. */
    bool
    is_bound_or_held(const ContactPoint &point, const NodeRules &supports)
    {
      const NodeRule *rule = supports.find(point.node->body, point.node->node);
      if (rule == nullptr)
        return true;
      const auto is_one_of = [](const Tensor<1, 3> &h, const auto &all) {
        return std::any_of(all.begin(), all.end(), [&](const auto &direction) {
          return is_along(h, direction);
        });
      };
      return rule->masters.empty() &&
             std::all_of(rule->held.begin(),
                         rule->held.end(),
                         [&](const HeldDirection &h) {
                           return is_one_of(h.direction, point.frictionless) ||
                                  (is_one_of(h.direction, point.directions) &&
                                   are_masters_held(*point.node,
                                                    h.direction,
                                                    supports));
                         });
    }
  } // namespace



  std::string
  IterativeBackend::obstacle(const Bodies        &bodies,
                             const NodeRules     &supports,
                             const ContactPoints &points)
  {
    for (std::size_t b = 0; b < bodies.structures.size(); ++b)
      if (bodies.is_rigid(b))
        return "solves bodies that deform, and " + bodies.called(b) +
               " is rigid and free";
    if (!bodies.frames().empty())
      return "knows contacts of undeformed bodies only, not those that slide "
             "far, nor bodies that turn";
    for (std::size_t i = points.size(); i < points.all().size(); ++i)
      if (!is_bound_or_held(points.all()[i], supports))
        return "knows no ties and no bilateral contacts of nodes that supports "
               "hold askew, or where these do not hold what it meets";
    if (share_nodes(points))
      return "wants each node in one contact";
    if (points.have_prescribed_slip())
      return "knows no friction along what supports hold";
    for (const ContactPoint &point : points.all())
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
    , coordinates(elastic.bodies, supports, &points, arm_of_rotations(e))
    , nowhere(unresisted_fields(motions, coordinates))
    , n_bound(points.n_bound_unknowns())
  {
    auto system = std::make_shared<solvers::ContactSystem>(points.layout());
    backends::LargeStiffness given;
    const auto               pins = find_pins(nowhere, coordinates);
    const double pinned           = pins.empty() ? 0. : mean_stiffness(elastic);
    given.for_each_element        = [&](const UnknownsVisitor &visit) {
      for_each_element(elastic, coordinates, visit);
      for (const Eigen::Index pin : pins)
        visit({pin}, &pinned);
    };
    given.node_of        = nodes_of_unknowns(coordinates);
    given.modes          = rigid_modes(elastic.bodies, coordinates);
    given.contact        = points.layout();
    SpecialNodes special = special_nodes(elastic, coordinates, points);
    given.surface        = std::move(special.together);
    given.position       = [&](const unsigned int block) {
      const auto [body, node] = coordinates.locate(number_of_node(block));
      const Point<3> p        = elastic.bodies.structures[body]->position(node);
      return std::array<double, 3>{{p[0], p[1], p[2]}};
    };
    system->large           = backends::make_separate_systems(std::move(given),
                                                    special.direct,
                                                    elastic.bodies.dim);
    const VectorXd diagonal = system->large->diagonal();
    system->large_diagonal  = diagonal.tail(system->n_unknowns());
    system->null_space      = motions.null_space();
    if (diagonal.size() > 0 && diagonal.mean() > 0)
      stiffness_scale = std::exp2(std::round(std::log2(diagonal.mean())));
    contact_system = system;
    if (n_bound == 0)
      return;
    const VectorXd of_dofs = diagonal_of(elastic, coordinates.n_dofs());
    stiffness_of_bound.setConstant(n_bound, of_dofs.mean());
    for (const Coordinates::BoundDirection &bound :
         coordinates.bound_directions())
      {
        double sum = 0;
        for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
          sum +=
            of_dofs[bound.dof + c] * bound.direction[c] * bound.direction[c];
        stiffness_of_bound[bound.unknown] = sum;
      }
  }

  VectorXd
  IterativeBackend::expand_bound(const VectorXd &v) const
  {
    VectorXd u = VectorXd::Zero(coordinates.n_dofs());
    for (const Coordinates::BoundDirection &bound :
         coordinates.bound_directions())
      for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
        u[bound.dof + c] += v[bound.unknown] * bound.direction[c];
    return u;
  }

  VectorXd
  IterativeBackend::restrict_bound(const VectorXd &forces) const
  {
    VectorXd r = VectorXd::Zero(n_bound);
    for (const Coordinates::BoundDirection &bound :
         coordinates.bound_directions())
      for (unsigned int c = 0; c < elastic.bodies.dim; ++c)
        r[bound.unknown] += forces[bound.dof + c] * bound.direction[c];
    return r;
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
    const VectorXd all       = forces - elastic.internal_forces(prescribed);
    load.b                   = coordinates.restrict(all);
    load.f                   = load.b;
    load.bound               = VectorXd::Zero(2 * n_bound);
    load.bound.head(n_bound) = restrict_bound(all);
  }

  /* What is bound stays where it is: it moves the other way against its
     body. */
  void
  IterativeBackend::move_bound(const VectorXd &offset, LoadCase &load) const
  {
    if (offset.isZero(0))
      return;
    const VectorXd forces = elastic.internal_forces(expand_bound(offset));
    const VectorXd b      = coordinates.restrict(forces);
    load.b += b;
    load.f += b;
    load.bound.head(n_bound) += restrict_bound(forces);
    load.bound.tail(n_bound) -= offset;
  }

  BoundState
  IterativeBackend::bound_state(const LoadCase &load,
                                const VectorXd &primal) const
  {
    if (n_bound == 0)
      return {};
    const VectorXd u = coordinates.expand(unknowns(load, primal));
    return {restrict_bound(elastic.internal_forces(u)) -
              load.bound.head(n_bound),
            {}};
  }

  LoadCase
  IterativeBackend::nothing() const
  {
    LoadCase load;
    load.b     = VectorXd::Zero(coordinates.n_unknowns());
    load.f     = load.b;
    load.bound = VectorXd::Zero(2 * n_bound);
    return load;
  }

  VectorXd
  IterativeBackend::unknowns(const LoadCase &load, const VectorXd &primal) const
  {
    if (set.layout().n_unknowns() > 0)
      return primal;
    // Where nothing may touch no solver has been asked.
    VectorXd u = VectorXd::Zero(load.f.size());
    for (unsigned int i = 0; i < 2; ++i) // and the rounding of that
      if (const auto step = contact_system->large->solve(
            {}, contact_system->large->multiply(u) - load.f, to_the_end))
        u += step->du;
    return u;
  }

  Eigen::MatrixXd
  IterativeBackend::expand(const std::vector<const LoadCase *> &loads,
                           const std::vector<VectorXd>         &primal) const
  {
    Eigen::MatrixXd w(coordinates.n_dofs(),
                      static_cast<Eigen::Index>(loads.size()));
    for (std::size_t k = 0; k < loads.size(); ++k)
      {
        VectorXd column = coordinates.expand(unknowns(*loads[k], primal[k])) +
                          loads[k]->prescribed;
        if (n_bound > 0)
          column += expand_bound(loads[k]->bound.tail(n_bound));
        w.col(static_cast<Eigen::Index>(k)) = without_motion(column);
      }
    return w;
  }

  LoadCase
  IterativeBackend::reduce_unbalanced(const VectorXd &unbalanced) const
  {
    LoadCase change;
    change.b                   = -coordinates.restrict(unbalanced);
    change.f                   = change.b;
    change.bound               = VectorXd::Zero(2 * n_bound);
    change.bound.head(n_bound) = -restrict_bound(unbalanced);
    return change;
  }

  VectorXd
  IterativeBackend::correction(const LoadCase &, const VectorXd &primal) const
  {
    return without_motion(coordinates.expand(primal));
  }

  VectorXd
  IterativeBackend::without_motion(const VectorXd &w) const
  {
    if (nowhere.cols() == 0)
      return w;
    return w - nowhere * (nowhere.transpose() * w).eval();
  }
} // namespace conetact::contact
