// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/iterative/trilinos_levels.h"

#include "conetact/base/index.h"
#include "conetact/base/process.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <optional>

namespace conetact::iterative
{
  namespace
  {
    using TrilinosMatrix = dealii::TrilinosWrappers::SparseMatrix;
    using AMG            = dealii::TrilinosWrappers::PreconditionAMG;

    /** deal.II's choices for elliptic systems, but for the near null space, of
     * which it knows constants only, and for the threshold: no connection is
     * dropped. ML keeps the address of the modes, which must outlive it. */
    Teuchos::ParameterList
    ml_parameters(const TrilinosMatrix &matrix,
                  Eigen::MatrixXd      &modes,
                  const int             block)
    {
      Teuchos::ParameterList              list;
      std::unique_ptr<Epetra_MultiVector> constants;
      AMG::AdditionalData                 data;
      data.aggregation_threshold = 0;
      data.set_parameters(list, constants, matrix);
      list.set("PDE equations", block);
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", static_cast<int>(modes.cols()));
      list.set("null space: vectors", modes.data());
      return list;
    }
  } // namespace

  template <int block>
  struct TrilinosLevels<block>::Implementation
  {
    const DistributedMatrix<block, block, double> &K;
    double                                         scale;
    const Eigen::VectorXd                         &exists;
    Eigen::MatrixXd                                modes;
    std::vector<int>                               nodes;
    std::unique_ptr<TrilinosMatrix>                matrix;
    AMG                                            levels;
    std::optional<std::vector<NodeState<block>>>   shown;
    dealii::Vector<double>                         r, x;

    /** Zeros are entries, too: laws of contact may fill them later. */
    void
    make_pattern()
    {
      const auto                n = static_cast<unsigned int>(exists.size());
      std::vector<unsigned int> length(n, 0);
      for_all([&](const int row, const auto &columns, const auto &) {
        length[at(row)] = static_cast<unsigned int>(columns.size());
      });
      matrix = std::make_unique<TrilinosMatrix>(dealii::complete_index_set(n),
                                                MPI_COMM_SELF,
                                                length);
      for_all([&](const int row, const auto &columns, const auto &values) {
        matrix->set(static_cast<unsigned int>(row),
                    columns,
                    values,
                    /*elide_zero_values=*/false);
      });
      // ML refers to this matrix: it stays, and each state writes other numbers
      // into the same pattern.
      matrix->compress(dealii::VectorOperation::insert);
    }

    /** Calls visit(row, its columns, its values) of A without states. */
    template <typename Visit>
    void
    for_all(const Visit &visit) const
    {
      std::vector<unsigned int> columns;
      for (int i = 0; i < static_cast<int>(exists.size()) / block; ++i)
        {
          columns.clear();
          std::vector<std::vector<double>> values(block);
          K.for_row(at(i), [&](const int j, const auto &numbers) {
            for (int b = 0; b < block; ++b)
              {
                columns.push_back(static_cast<unsigned int>(j * block + b));
                for (int a = 0; a < block; ++a)
                  values[at(a)].push_back(numbers(a, b) / scale);
              }
          });
          for (int a = 0; a < block; ++a)
            visit(i * block + a, columns, values[at(a)]);
        }
    }

    /** Held unknowns have but the diagonal in their rows and columns: one, the
     * size of all others, since A is K over its mean diagonal. */
    void
    write(const std::vector<NodeState<block>> &states)
    {
      Eigen::VectorXd held = Eigen::VectorXd::Ones(exists.size()) - exists;
      std::vector<const NodeState<block> *> state(at(exists.size() / block));
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          held.segment<block>(nodes[k] * block) =
            states[k].held.template cast<double>();
          state[at(nodes[k])] = &states[k];
        }
      for_all([&](const int row, const auto &columns, auto values) {
        const int node = row / block;
        for (std::size_t k = 0; k < columns.size(); ++k)
          {
            const auto column = static_cast<int>(columns[k]);
            if (column / block == node && state[at(node)] != nullptr)
              values[k] += static_cast<double>(
                state[at(node)]->added(row % block, column % block));
            if (held[row] + held[column] > 0)
              values[k] = row == column ? 1. : 0.;
            else if (row == column && values[k] == 0)
              values[k] = 1; // of a mechanism: nothing resists
          }
        matrix->set(static_cast<unsigned int>(row), columns, values, false);
      });
      matrix->compress(dealii::VectorOperation::insert);
    }
  };

  template <int block>
  TrilinosLevels<block>::TrilinosLevels(
    const DistributedMatrix<block, block, double> &K,
    const double                                   scale,
    const Eigen::VectorXd                         &exists,
    const Eigen::MatrixXd                         &modes,
    const std::vector<int>                        &nodes)
  {
    AssertDimension(modes.rows(), exists.size());
    ProcessSession::require_mpi();
    implementation.reset(
      new Implementation{K, scale, exists, modes, nodes, {}, {}, {}, {}, {}});
    Implementation &own = *implementation;
    own.r.reinit(static_cast<unsigned int>(exists.size()));
    own.x.reinit(own.r);
    own.make_pattern();
  }

  template <int block>
  TrilinosLevels<block>::~TrilinosLevels() = default;

  /* ML's maps depend on the matrix and are made anew. That costs as much as 25
     to 30 iterations, but with maps of another state each system takes 14 to
     66. */
  template <int block>
  void
  TrilinosLevels<block>::set_states(const std::vector<NodeState<block>> &states,
                                    const bool exactly)
  {
    Implementation &own = *implementation;
    AssertDimension(states.size(), own.nodes.size());
    if (own.shown &&
        (exactly ? *own.shown == states : serve(*own.shown, states)))
      return;
    own.write(states);
    own.shown = states;
    own.levels.initialize(*own.matrix,
                          ml_parameters(*own.matrix, own.modes, block));
  }

  /* ML computes in double precision, and all that is around it in single: GMRES
     is flexible, and its outer residual tells what is accurate. */
  template <int block>
  void
  TrilinosLevels<block>::correct(const FloatVector &r, FloatVector &x)
  {
    Implementation &own = *implementation;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      own.r[static_cast<unsigned int>(i)] = static_cast<double>(r[i]);
    own.levels.vmult(own.x, own.r);
    x.resize(r.size());
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] = static_cast<float>(own.x[static_cast<unsigned int>(i)]);
  }

  template class TrilinosLevels<2>;
  template class TrilinosLevels<3>;
} // namespace conetact::iterative
