// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The elastic system in the unknowns of coordinates, element by element.

#include "conetact/base/index.h"
#include "conetact/contact/elastic_system.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/affine_constraints.templates.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

#include <algorithm>
#include <map>

namespace conetact::contact
{
  namespace
  {
    using Number  = dealii::types::global_dof_index;
    using Numbers = std::vector<Number>;

    /**
     * The map u = C q as constraints of deal.II: numbers of dofs that are
     * unknowns are these, all other dofs stand behind the unknowns and depend
     * on them. An element K_e becomes C_e^T K_e C_e by its ways to add local
     * matrices.
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

      /** Numbers of all dofs of an element. */
      void
      find_numbers(const std::vector<unsigned int> &dofs, Numbers &found) const
      {
        found.clear();
        for (const unsigned int dof : dofs)
          found.push_back(number_of(dof));
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

    /** Tells whether all dofs of an element are unknowns, and which. */
    bool
    are_plain(const LinearMap                 &coordinates,
              const std::vector<unsigned int> &dofs,
              std::vector<Eigen::Index>       &unknowns)
    {
      unknowns.clear();
      for (const unsigned int dof : dofs)
        {
          unknowns.push_back(coordinates.plain(dof));
          if (unknowns.back() < 0)
            return false;
        }
      return true;
    }

    /**
     * One element on the unknowns that it touches: C^T K C, where C has the
     * rows of its dofs. A node of a surface may hang on dozens of others, so
     * that C is kept as the sparse matrix that it is: the way of deal.II's
     * AffineConstraints takes the square of its entries.
     */
    class ReducedElement
    {
    public:
      void
      reinit(const LinearMap                 &coordinates,
             const std::vector<unsigned int> &dofs)
      {
        unknowns.clear();
        entries.clear();
        start.assign(1, 0);
        for (const unsigned int dof : dofs)
          {
            coordinates.for_row(dof,
                                [&](const Eigen::Index unknown,
                                    const double       factor) {
                                  unknowns.push_back(unknown);
                                  entries.push_back({0, factor});
                                });
            start.push_back(entries.size());
          }
        const std::vector<Eigen::Index> of_entries = unknowns;
        std::sort(unknowns.begin(), unknowns.end());
        unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                       unknowns.end());
        for (std::size_t e = 0; e < entries.size(); ++e)
          entries[e].place =
            std::lower_bound(unknowns.begin(), unknowns.end(), of_entries[e]) -
            unknowns.begin();
      }
      /** Both K and the result are row by row. */
      const double *
      reduce(const double *K)
      {
        const auto  n = static_cast<Eigen::Index>(start.size()) - 1;
        const auto  m = static_cast<Eigen::Index>(unknowns.size());
        const auto &C = entries;
        half.setZero(n, m);
        for (Eigen::Index i = 0; i < n; ++i)
          for (std::size_t j = 0; j + 1 < start.size(); ++j, ++K)
            for (std::size_t e = start[j]; e < start[j + 1]; ++e)
              half(i, C[e].place) += *K * C[e].factor;
        // One triangle, so that the result is symmetric to the last bit.
        result.setZero(m, m);
        for (Eigen::Index i = 0; i < n; ++i)
          for (std::size_t e = start[at(i)]; e < start[at(i) + 1]; ++e)
            result.row(C[e].place).head(C[e].place + 1) +=
              C[e].factor * half.row(i).head(C[e].place + 1);
        result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
        return result.data();
      }

      std::vector<Eigen::Index> unknowns; ///< ascending

    private:
      using Rows =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      struct Entry
      {
        Eigen::Index place; ///< of its unknown
        double       factor;
      };

      std::vector<Entry>       entries; ///< of C, row by row
      std::vector<std::size_t> start;   ///< of rows
      Rows                     half;    ///< K C
      Rows                     result;
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

    /**
     * The upper triangle of the first n unknowns, with a whole diagonal: an
     * unknown that no element touches has a zero there, and direct solvers name
     * its node.
     */
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
  } // namespace



  void
  for_each_connection(
    const ElasticSystem                                          &system,
    const LinearMap                                              &coordinates,
    const std::function<void(const std::vector<Eigen::Index> &)> &visit,
    const SomeNodesOfBodies                                      *nodes)
  {
    ReducedElement element;
    system.for_each_connection(
      [&](const std::vector<unsigned int> &dofs) {
        if (!are_plain(coordinates, dofs, element.unknowns))
          element.reinit(coordinates, dofs);
        visit(element.unknowns);
      },
      nodes);
  }

  /* C^T K C is the sum of C_e^T K_e C_e over elements. Most elements have no
     special node: their matrices are taken as they are. */
  void
  for_each_element(const ElasticSystem     &system,
                   const LinearMap         &coordinates,
                   const UnknownsVisitor   &visit,
                   const SomeNodesOfBodies *nodes)
  {
    ReducedElement element;
    system.for_each_element(
      [&](const std::vector<unsigned int> &dofs, const double *matrix) {
        if (are_plain(coordinates, dofs, element.unknowns))
          return visit(element.unknowns, matrix);
        element.reinit(coordinates, dofs);
        visit(element.unknowns, element.reduce(matrix));
      },
      nodes);
  }



  /* A node is meant if one of its dofs depends on one of these unknowns: nodes
     that hang on others, or follow masters, are found by the rows of C. */
  SomeNodesOfBodies
  nodes_of(const model::Bodies     &bodies,
           const LinearMap         &coordinates,
           const std::vector<bool> &some)
  {
    AssertDimension(some.size(), coordinates.n_unknowns());
    SomeNodesOfBodies nodes;
    Eigen::Index      dof = 0;
    for (const bodies::Structure *structure : bodies.structures)
      {
        bodies::SomeNodes of_body(structure->n_nodes(), false);
        for (unsigned int i = 0; i < structure->n_nodes(); ++i)
          for (unsigned int c = 0; c < structure->n_components(); ++c)
            coordinates.for_row(dof++, [&](const Eigen::Index q, double) {
              if (some[static_cast<std::size_t>(q)])
                of_body[i] = true;
            });
        nodes.push_back(std::move(of_body));
      }
    return nodes;
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
