// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/elastic_system.h"

#include "conetact/bodies/element_forces.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Dofs of a body among those of all. Scenes of one body, and first bodies,
     * need no copies. */
    const std::vector<unsigned int> &
    among_all(const std::vector<unsigned int> &dofs,
              const Eigen::Index               offset,
              std::vector<unsigned int>       &shifted)
    {
      if (offset == 0)
        return dofs;
      shifted = dofs;
      for (unsigned int &dof : shifted)
        dof += static_cast<unsigned int>(offset);
      return shifted;
    }

    /**
     * The displacement u of the far ends of springs along any directions e that
     * have moved by d_e: sum (u.e) e = sum d_e e, and u has no part across all
     * of them.
     */
    Tensor<1, 3>
    far_end(const bodies::Support     &support,
            const bodies::SurfaceNode &node,
            const double               t)
    {
      Tensor<1, 3>    right;
      Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
      for (const auto &[e, expression] : support.directions_at(node))
        {
          const Eigen::Vector3d v(e[0], e[1], e[2]);
          left += v * v.transpose();
          right += support.displacement[expression](node.position, t) * e;
        }
      // Few springs leave directions free: the shortest u, which has no part
      // there.
      const Eigen::Vector3d u = left.completeOrthogonalDecomposition().solve(
        Eigen::Vector3d(right[0], right[1], right[2]));
      return Tensor<1, 3>({u[0], u[1], u[2]});
    }
  } // namespace

  ElasticSystem::ElasticSystem(const model::Bodies &b)
    : bodies(b)
    , dof_offset(1, 0)
  {
    for (const bodies::Structure *structure : bodies.structures)
      dof_offset.push_back(dof_offset.back() + structure->n_dofs());
    std::vector<unsigned int> n_foundations_of(bodies.structures.size());
    for (std::size_t s = 0; s < bodies.supports.size(); ++s)
      {
        const bodies::Support &support = bodies.supports[s];
        if (!support.stiffness || bodies.is_at_rest(support.body))
          continue;
        // Equal bodies are told by their foundations one by one, in this order.
        const unsigned int place = n_foundations_of[support.body]++;
        const auto offset = static_cast<unsigned int>(dof_offset[support.body]);
        bodies.structures[support.body]->visit_springs(
          support.ids,
          [&](const Point<3> &p, const Tensor<1, 3> &normal) {
            return support.spring(p, normal);
          },
          [&](const std::vector<unsigned int> &dofs, const double *matrix) {
            Spring spring{dofs,
                          {matrix, matrix + dofs.size() * dofs.size()},
                          s,
                          place};
            // Numbers are those of the scene, not of the body.
            for (unsigned int &dof : spring.dofs)
              dof += offset;
            springs.push_back(std::move(spring));
          });
      }
  }

  bool
  ElasticSystem::has_some(const Spring            &spring,
                          const SomeNodesOfBodies *nodes) const
  {
    if (nodes == nullptr)
      return true;
    // Springs are few beside elements: they are looked through, not sorted by
    // nodes.
    const unsigned int body = bodies.supports[spring.support].body;
    const auto         n_c  = bodies.structures[body]->n_components();
    const auto         from = static_cast<unsigned int>(dof_offset[body]);
    return std::any_of(spring.dofs.begin(),
                       spring.dofs.end(),
                       [&](const unsigned int dof) {
                         return (*nodes)[body][(dof - from) / n_c];
                       });
  }

  void
  ElasticSystem::for_each_element(const bodies::ElementVisitor &visit,
                                  const SomeNodesOfBodies      *nodes) const
  {
    std::vector<unsigned int> shifted;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      {
        if (bodies.is_at_rest(body))
          continue;
        const auto see = [&](const std::vector<unsigned int> &dofs,
                             const double                    *matrix) {
          ++visited;
          visit(among_all(dofs, dof_offset[body], shifted), matrix);
        };
        if (nodes == nullptr)
          bodies.structures[body]->elements().for_each(see);
        else
          bodies.structures[body]->elements().for_each_at((*nodes)[body], see);
      }
    for (const Spring &spring : springs)
      // Springs of foundations are elements of their body like others.
      if (has_some(spring, nodes))
        visit(spring.dofs, spring.matrix.data());
  }

  void
  ElasticSystem::for_each_connection(const bodies::ConnectionVisitor &visit,
                                     const SomeNodesOfBodies *nodes) const
  {
    std::vector<unsigned int> shifted;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      {
        if (bodies.is_at_rest(body))
          continue;
        const auto see = [&](const std::vector<unsigned int> &dofs) {
          ++visited;
          visit(among_all(dofs, dof_offset[body], shifted));
        };
        if (nodes == nullptr)
          bodies.structures[body]->elements().for_each_connection(see);
        else
          bodies.structures[body]->elements().for_each_connection_at(
            (*nodes)[body], see);
      }
    for (const Spring &spring : springs)
      if (has_some(spring, nodes))
        visit(spring.dofs);
  }

  Eigen::VectorXd
  ElasticSystem::internal_forces(const Eigen::VectorXd &u) const
  {
    return spring_forces(u) + structure_forces(u);
  }

  Eigen::VectorXd
  ElasticSystem::structure_forces(const Eigen::VectorXd &u) const
  {
    SomeNodesOfBodies all;
    for (const bodies::Structure *structure : bodies.structures)
      all.emplace_back(structure->n_nodes(), true);
    return structure_forces_at(all, u);
  }

  Eigen::VectorXd
  ElasticSystem::structure_forces_at(const SomeNodesOfBodies &nodes,
                                     const Eigen::VectorXd   &u) const
  {
    AssertDimension(u.size(), dof_offset.back());
    AssertDimension(nodes.size(), bodies.structures.size());
    // One body alone has all dofs, and needs no copies of its vectors.
    if (bodies.structures.size() == 1 && !bodies.is_at_rest(0))
      {
        Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size());
        visited +=
          bodies.structures[0]->elements().add_forces_at(nodes[0], u, f);
        return f;
      }
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size()), part;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      {
        if (bodies.is_at_rest(body))
          continue;
        const bodies::Structure &structure = *bodies.structures[body];
        part.setZero(structure.n_dofs());
        // Each body multiplies by itself: a continuum takes out what a cell
        // moves as a whole, which an assembled K u would round.
        visited += structure.elements().add_forces_at(
          nodes[body], u.segment(dof_offset[body], part.size()), part);
        f.segment(dof_offset[body], part.size()) = part;
      }
    return f;
  }

  /* The rounding of a sum is measured by its terms: by eps sum_j |K_ij|
     |u_j|. */
  Eigen::VectorXd
  ElasticSystem::terms(const Eigen::VectorXd   &u,
                       const SomeNodesOfBodies *nodes) const
  {
    AssertDimension(u.size(), dof_offset.back());
    const Eigen::VectorXd size = u.cwiseAbs();
    Eigen::VectorXd       sum  = Eigen::VectorXd::Zero(u.size()), local;
    std::vector<double>   magnitude;
    for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        // sum_e |K_e| |u| over elements e, which is no less than |K| |u|:
        // entries of elements that cancel in K round all the same.
        magnitude.assign(matrix, matrix + dofs.size() * dofs.size());
        for (double &entry : magnitude)
          entry = std::abs(entry);
        bodies::multiply(dofs, magnitude.data(), size, local, sum);
      },
      nodes);
    return sum;
  }

  Eigen::VectorXd
  ElasticSystem::spring_forces(const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), dof_offset.back());
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size()), local;
    for (const Spring &spring : springs)
      bodies::multiply(spring.dofs, spring.matrix.data(), u, local, f);
    return f;
  }

  /* Foundations of one body may overlap: the k-th of each body is in the k-th
     vector, apart from its others. */
  std::vector<Eigen::VectorXd>
  ElasticSystem::forces_by_foundation(const Eigen::VectorXd &u) const
  {
    std::vector<Eigen::VectorXd> f;
    Eigen::VectorXd              local;
    for (const Spring &spring : springs)
      {
        if (spring.place >= f.size())
          f.resize(spring.place + 1, Eigen::VectorXd::Zero(u.size()));
        bodies::multiply(
          spring.dofs, spring.matrix.data(), u, local, f[spring.place]);
      }
    return f;
  }

  Eigen::VectorXd
  ElasticSystem::ground(const std::size_t s, const double t) const
  {
    AssertIndexRange(s, bodies.supports.size());
    Assert(bodies.supports[s].stiffness,
           dealii::ExcMessage("Only foundations stand on a ground."));
    Eigen::VectorXd          moved   = Eigen::VectorXd::Zero(dof_offset.back());
    const bodies::Support   &support = bodies.supports[s];
    const bodies::Structure &structure = *bodies.structures[support.body];
    const auto dof = [&](const unsigned int node, const unsigned int c) {
      return dof_offset[support.body] +
             node * static_cast<Eigen::Index>(structure.n_components()) + c;
    };
    // Most foundations stand still.
    if (support.is_still())
      return moved;
    for (const bodies::SurfaceNode &node : support.surface.nodes)
      {
        const Tensor<1, 3> motion = far_end(support, node, t);
        for (unsigned int c = 0; c < bodies.dim; ++c)
          moved[dof(node.node, c)] = motion[c];
      }
    // Surfaces list no hanging nodes, but the springs stand in their dofs as
    // well: the ground moves there as its masters do.
    for (const bodies::HangingNode &hanging : structure.hanging_nodes())
      for (unsigned int c = 0; c < bodies.dim; ++c)
        for (const auto &[master, weight] : hanging.masters)
          moved[dof(hanging.node, c)] += weight * moved[dof(master, c)];
    return moved;
  }

  Eigen::VectorXd
  ElasticSystem::ground_forces(const double t) const
  {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(dof_offset.back()), local;
    for (std::size_t s = 0; s < bodies.supports.size(); ++s)
      {
        const bodies::Support &support = bodies.supports[s];
        if (!support.stiffness || support.is_still())
          continue;
        // Springs pull by K_s (ground - u): the part of the ground is a load.
        const Eigen::VectorXd moved = ground(s, t);
        for (const Spring &spring : springs)
          if (spring.support == s)
            bodies::multiply(
              spring.dofs, spring.matrix.data(), moved, local, f);
      }
    return f;
  }

  /* f = K_s (g - u), with the displacement g of the ground. */
  std::vector<Foundation>
  ElasticSystem::foundations(const Eigen::VectorXd &u, const double t) const
  {
    AssertDimension(u.size(), dof_offset.back());
    std::vector<Foundation> all(bodies.supports.size());
    Eigen::VectorXd         local;
    for (std::size_t s = 0; s < bodies.supports.size(); ++s)
      if (bodies.supports[s].stiffness)
        {
          all[s].ground                 = ground(s, t);
          all[s].forces                 = Eigen::VectorXd::Zero(u.size());
          const Eigen::VectorXd stretch = all[s].ground - u;
          for (const Spring &spring : springs)
            if (spring.support == s)
              bodies::multiply(spring.dofs,
                               spring.matrix.data(),
                               stretch,
                               local,
                               all[s].forces);
        }
    return all;
  }
} // namespace conetact::contact
