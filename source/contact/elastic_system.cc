// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/elastic_system.h"

#include "conetact/bodies/element_forces.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/affine_constraints.templates.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>

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

    using Number  = dealii::types::global_dof_index;
    using Numbers = std::vector<Number>;

    /**
     * The map u = C q as constraints: the numbers of dofs that are unknowns are
     * these, all others stand behind the unknowns and depend on them.
     */
    class Constraints
    {
    public:
      explicit Constraints(const LinearMap &c)
        : n_unknowns(static_cast<Number>(c.n_unknowns()))
        , coordinates(c)
      {
        for (Eigen::Index i = 0; i < coordinates.n_rows(); ++i)
          if (coordinates.plain(i) < 0)
            add(i);
        affine.close();
        n_numbers = n_unknowns + static_cast<Number>(affine.n_constraints());
      }

      /** Whether all of the element's dofs are unknowns. */
      bool
      find_numbers(const std::vector<unsigned int> &dofs, Numbers &found) const
      {
        found.clear();
        bool are_plain = true;
        for (const unsigned int dof : dofs)
          {
            found.push_back(number_of(dof));
            are_plain = are_plain && found.back() < n_unknowns;
          }
        return are_plain;
      }

      const Number                      n_unknowns;
      Number                            n_numbers;
      dealii::AffineConstraints<double> affine;

    private:
      Number
      number_of(const Eigen::Index dof) const
      {
        // LinearMap counts rows of the other kind downwards from -1.
        const Eigen::Index plain = coordinates.plain(dof);
        return static_cast<Number>(
          plain >= 0 ? plain : coordinates.n_unknowns() - 1 - plain);
      }
      void
      add(const Eigen::Index dof)
      {
        std::map<Number, double> entries; // an unknown may come twice
        coordinates.for_row(dof,
                            [&](const Eigen::Index unknown,
                                const double       factor) {
                              entries[static_cast<Number>(unknown)] += factor;
                            });
        const Number number = number_of(dof);
        affine.add_line(number);
        for (const auto &[unknown, factor] : entries)
          affine.add_entry(number, unknown, factor);
      }

      const LinearMap &coordinates;
    };

    /** One element on the unknowns that it touches: a matrix for
     * AffineConstraints to add to, of which it knows these rows and columns. */
    class ReducedElement
    {
    public:
      using value_type = double;
      explicit ReducedElement(const Constraints &c)
        : constraints(c)
      {}
      virtual ~ReducedElement() = default; // deal.II asks for its type
      void
      reinit(const LinearMap                 &coordinates,
             const std::vector<unsigned int> &dofs)
      {
        unknowns.clear();
        for (const unsigned int dof : dofs)
          coordinates.for_row(dof, [&](const Eigen::Index unknown, double) {
            unknowns.push_back(unknown);
          });
        std::sort(unknowns.begin(), unknowns.end());
        unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                       unknowns.end());
        matrix.assign(unknowns.size() * unknowns.size(), 0.);
      }

      Number
      m() const
      {
        return constraints.n_numbers;
      }
      Number
      n() const
      {
        return m();
      }
      void
      add(const Number row, const Number column, const double value)
      {
        if (row < constraints.n_unknowns) // others have a diagonal only
          matrix[place(row) * unknowns.size() + place(column)] += value;
      }
      void
      add(const Number  row,
          const Number  n_columns,
          const Number *columns,
          const double *values,
          const bool /*elide_zero_values*/,
          const bool /*columns_are_sorted*/)
      {
        for (Number k = 0; k < n_columns; ++k)
          add(row, columns[k], values[k]);
      }

      std::vector<Eigen::Index> unknowns; ///< ascending
      std::vector<double>       matrix;   ///< row by row

    private:
      std::size_t
      place(const Number unknown) const
      {
        return static_cast<std::size_t>(
          std::lower_bound(unknowns.begin(),
                           unknowns.end(),
                           static_cast<Eigen::Index>(unknown)) -
          unknowns.begin());
      }

      const Constraints &constraints;
    };

    void
    copy(const std::size_t           n,
         const double               *matrix,
         dealii::FullMatrix<double> &k)
    {
      if (k.m() != n)
        k.reinit(n, n, /*omit_default_initialization=*/true);
      k.fill(matrix);
    }

    /** Of the first unknowns, with a diagonal: an unknown that no element
     * touches shall be found as singular by direct solvers. */
    Eigen::SparseMatrix<double>
    upper_triangle(const dealii::SparseMatrix<double> &all, const Number n)
    {
      Eigen::SparseMatrix<double> upper(n, n);
      upper.reserve((all.n_nonzero_elements() + n) / 2);
      for (Number q = 0; q < n; ++q)
        {
          upper.startVec(q);
          // deal.II has the diagonal first, and then ascending columns.
          for (auto entry = all.begin(q); entry != all.end(q); ++entry)
            if (entry->column() < q)
              upper.insertBack(entry->column(), q) = entry->value();
          upper.insertBack(q, q) = all.diag_element(q);
        }
      upper.finalize();
      return upper;
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
    const Constraints constraints(coordinates);
    ReducedElement    element(constraints);
    Numbers           numbers;
    system.for_each_connection([&](const std::vector<unsigned int> &dofs) {
      if (constraints.find_numbers(dofs, numbers))
        element.unknowns.assign(numbers.begin(), numbers.end());
      else
        element.reinit(coordinates, dofs);
      visit(element.unknowns);
    });
  }

  void
  for_each_element(const ElasticSystem   &system,
                   const LinearMap       &coordinates,
                   const UnknownsVisitor &visit)
  {
    const Constraints          constraints(coordinates);
    ReducedElement             element(constraints);
    dealii::FullMatrix<double> k;
    Numbers                    numbers;
    system.for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        // Most elements have no special node: they need no C^T k C.
        if (constraints.find_numbers(dofs, numbers))
          {
            element.unknowns.assign(numbers.begin(), numbers.end());
            visit(element.unknowns, matrix);
            return;
          }
        element.reinit(coordinates, dofs);
        copy(dofs.size(), matrix, k);
        constraints.affine.distribute_local_to_global(k, numbers, element);
        visit(element.unknowns, element.matrix.data());
      });
  }

  Eigen::SparseMatrix<double>
  assemble(const ElasticSystem &system, const LinearMap &coordinates)
  {
    const Constraints              constraints(coordinates);
    Numbers                        numbers;
    dealii::DynamicSparsityPattern entries(constraints.n_numbers);
    system.for_each_connection([&](const std::vector<unsigned int> &dofs) {
      constraints.find_numbers(dofs, numbers);
      constraints.affine.add_entries_local_to_global(numbers, entries, false);
    });
    dealii::SparsityPattern pattern;
    pattern.copy_from(entries);
    dealii::SparseMatrix<double> all(pattern);
    dealii::FullMatrix<double>   k;
    system.for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        constraints.find_numbers(dofs, numbers);
        copy(dofs.size(), matrix, k);
        constraints.affine.distribute_local_to_global(k, numbers, all);
      });
    return upper_triangle(all, constraints.n_unknowns);
  }
} // namespace conetact::contact
