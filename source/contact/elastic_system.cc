// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/elastic_system.h"

#include "conetact/bodies/element_forces.h"
#include "conetact/contact/element_reduction.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

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

    /** Unknowns of all elements, and for each unknown its elements. */
    struct Connectivity
    {
      std::vector<std::size_t> start = {0};
      std::vector<int>         unknowns;
      std::vector<std::size_t> element_start;
      std::vector<int>         elements;
    };

    /** The pattern comes first, so that values go to their places at once. */
    Connectivity
    connect(const ElasticSystem &system, const LinearMap &coordinates)
    {
      Connectivity              c;
      std::vector<Eigen::Index> unknowns;
      const ElementReduction    reduction(coordinates);
      system.for_each_connection([&](const std::vector<unsigned int> &dofs) {
        reduction.find_unknowns(dofs, unknowns);
        for (const Eigen::Index q : unknowns)
          c.unknowns.push_back(static_cast<int>(q));
        c.start.push_back(c.unknowns.size());
      });
      // Lists of elements by unknown, one behind the other: counted first, then
      // filled.
      c.element_start.assign(
        static_cast<std::size_t>(coordinates.n_unknowns()) + 1, 0);
      for (const int q : c.unknowns)
        ++c.element_start[static_cast<std::size_t>(q) + 1];
      for (std::size_t q = 1; q < c.element_start.size(); ++q)
        c.element_start[q] += c.element_start[q - 1];
      c.elements.resize(c.unknowns.size());
      std::vector<std::size_t> next = c.element_start;
      for (std::size_t e = 0; e + 1 < c.start.size(); ++e)
        for (std::size_t k = c.start[e]; k < c.start[e + 1]; ++k)
          c.elements[next[static_cast<std::size_t>(c.unknowns[k])]++] =
            static_cast<int>(e);
      return c;
    }

    /** Zero matrix with the pattern of the upper triangle. */
    Eigen::SparseMatrix<double>
    upper_pattern(const Connectivity &c, const Eigen::Index n)
    {
      Eigen::SparseMatrix<double> upper(n, n);
      // Column by column: all unknowns of the elements around, each once.
      std::vector<int> rows, last_seen(static_cast<std::size_t>(n), -1);
      std::vector<int> all_rows;
      all_rows.reserve(c.unknowns.size() * 2);
      int *const outer = upper.outerIndexPtr();
      outer[0]         = 0;
      for (int q = 0; q < n; ++q)
        {
          rows.clear();
          const auto column = static_cast<std::size_t>(q);
          for (std::size_t k = c.element_start[column];
               k < c.element_start[column + 1];
               ++k)
            {
              const auto e = static_cast<std::size_t>(c.elements[k]);
              for (std::size_t j = c.start[e]; j < c.start[e + 1]; ++j)
                {
                  const int p = c.unknowns[j];
                  // Unknowns of an element ascend: what follows is below the
                  // diagonal.
                  if (p > q)
                    break;
                  if (last_seen[static_cast<std::size_t>(p)] != q)
                    {
                      last_seen[static_cast<std::size_t>(p)] = q;
                      rows.push_back(p);
                    }
                }
            }
          // Direct solvers want a diagonal, and an unknown that no element
          // touches shall be found by them as singular.
          if (rows.empty())
            rows.push_back(q);
          std::sort(rows.begin(), rows.end());
          all_rows.insert(all_rows.end(), rows.begin(), rows.end());
          outer[q + 1] = static_cast<int>(all_rows.size());
        }
      upper.resizeNonZeros(static_cast<Eigen::Index>(all_rows.size()));
      std::copy(all_rows.begin(), all_rows.end(), upper.innerIndexPtr());
      std::fill_n(upper.valuePtr(), all_rows.size(), 0.);
      return upper;
    }

    /** Adds an element; `unknowns` ascend, `order` are their places in it. */
    void
    scatter(const std::vector<Eigen::Index> &unknowns,
            const std::vector<Eigen::Index> &order,
            const double                    *matrix,
            Eigen::SparseMatrix<double>     &upper)
    {
      const std::size_t n     = unknowns.size();
      const int *const  outer = upper.outerIndexPtr();
      const int *const  inner = upper.innerIndexPtr();
      for (std::size_t b = 0; b < n; ++b)
        {
          int                 place = outer[unknowns[b]];
          const double *const row =
            matrix + order[b] * static_cast<Eigen::Index>(n);
          for (std::size_t a = 0; a <= b; ++a, ++place)
            {
              // Both ascend: one walk through the column finds all places.
              while (inner[place] != unknowns[a])
                ++place;
              upper.valuePtr()[place] += row[order[a]];
            }
        }
    }

    /**
     * Where the far ends of springs along any directions e have moved by d_e:
     * the u without part across all of them with sum (u.e) e = sum d_e e.
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

  ElasticSystem::ElasticSystem(const Bodies &b)
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
            // from the numbers of the body to those of the scene
            for (unsigned int &dof : spring.dofs)
              dof += offset;
            springs.push_back(std::move(spring));
          });
      }
  }

  void
  ElasticSystem::for_each_element(const bodies::ElementVisitor &visit) const
  {
    std::vector<unsigned int> shifted;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      if (!bodies.is_at_rest(body))
        bodies.structures[body]->for_each_element(
          [&](const std::vector<unsigned int> &dofs, const double *matrix) {
            visit(among_all(dofs, dof_offset[body], shifted), matrix);
          });
    for (const Spring &spring : springs)
      // Springs of foundations are elements of their body like others.
      visit(spring.dofs, spring.matrix.data());
  }

  void
  ElasticSystem::for_each_connection(
    const bodies::ConnectionVisitor &visit) const
  {
    std::vector<unsigned int> shifted;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      if (!bodies.is_at_rest(body))
        bodies.structures[body]->for_each_connection(
          [&](const std::vector<unsigned int> &dofs) {
            visit(among_all(dofs, dof_offset[body], shifted));
          });
    for (const Spring &spring : springs)
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
    AssertDimension(u.size(), dof_offset.back());
    Eigen::VectorXd f = Eigen::VectorXd::Zero(u.size()), part;
    for (std::size_t body = 0; body < bodies.structures.size(); ++body)
      {
        if (bodies.is_at_rest(body))
          continue;
        const bodies::Structure &structure = *bodies.structures[body];
        part.setZero(structure.n_dofs());
        // Bodies multiply by themselves: a continuum takes out what a cell
        // moves as a whole, which an assembled K u would round.
        structure.add_internal_forces(u.segment(dof_offset[body], part.size()),
                                      part);
        f.segment(dof_offset[body], part.size()) = part;
      }
    return f;
  }

  Eigen::VectorXd
  ElasticSystem::terms(const Eigen::VectorXd &u) const
  {
    AssertDimension(u.size(), dof_offset.back());
    const Eigen::VectorXd size = u.cwiseAbs();
    Eigen::VectorXd       sum  = Eigen::VectorXd::Zero(u.size()), local;
    std::vector<double>   magnitude;
    for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        // |K| |u|, element by element: terms of the sums that make K u.
        magnitude.assign(matrix, matrix + dofs.size() * dofs.size());
        for (double &entry : magnitude)
          entry = std::abs(entry);
        bodies::multiply(dofs, magnitude.data(), size, local, sum);
      });
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
    // most foundations stand still
    if (support.is_still())
      return moved;
    for (const bodies::SurfaceNode &node : support.surface.nodes)
      {
        const Tensor<1, 3> motion = far_end(support, node, t);
        for (unsigned int c = 0; c < bodies.dim; ++c)
          moved[dof(node.node, c)] = motion[c];
      }
    // The springs stand in all dofs, those of hanging nodes, too.
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

  void
  for_each_connection(
    const ElasticSystem                                          &system,
    const LinearMap                                              &coordinates,
    const std::function<void(const std::vector<Eigen::Index> &)> &visit)
  {
    const ElementReduction    reduction(coordinates);
    std::vector<Eigen::Index> unknowns;
    system.for_each_connection([&](const std::vector<unsigned int> &dofs) {
      if (is_plain(dofs, coordinates))
        find_plain(dofs, coordinates, unknowns);
      else
        reduction.find_unknowns(dofs, unknowns);
      visit(unknowns);
    });
  }

  void
  for_each_element(const ElasticSystem   &system,
                   const LinearMap       &coordinates,
                   const UnknownsVisitor &visit)
  {
    ElementReduction          reduction(coordinates);
    ReducedElement            element;
    std::vector<Eigen::Index> unknowns;
    system.for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        // Most elements have no special node: these go on as they are, without
        // C^T k C.
        if (!is_plain(dofs, coordinates))
          {
            reduction.reduce(dofs, matrix, element);
            visit(element.unknowns, element.matrix.data());
            return;
          }
        find_plain(dofs, coordinates, unknowns);
        visit(unknowns, matrix);
      });
  }

  Eigen::SparseMatrix<double>
  assemble(const ElasticSystem &system, const LinearMap &coordinates)
  {
    Eigen::SparseMatrix<double> upper =
      upper_pattern(connect(system, coordinates), coordinates.n_unknowns());
    std::vector<Eigen::Index> order, sorted;
    for_each_element(
      system,
      coordinates,
      [&](const std::vector<Eigen::Index> &unknowns, const double *matrix) {
        order.resize(unknowns.size());
        std::iota(order.begin(), order.end(), 0);
        const auto unknown = [&](const Eigen::Index i) {
          return unknowns[static_cast<std::size_t>(i)];
        };
        std::sort(order.begin(), order.end(), [&](const auto a, const auto b) {
          return unknown(a) < unknown(b);
        });
        sorted.clear();
        for (const Eigen::Index i : order)
          sorted.push_back(unknown(i));
        scatter(sorted, order, matrix, upper);
      });
    return upper;
  }
} // namespace conetact::contact
