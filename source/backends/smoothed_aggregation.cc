// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/smoothed_aggregation.h"

#include "conetact/base/process.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_include.h>

#include <algorithm>
#include <stdexcept>

namespace conetact::backends
{
  namespace
  {
    using dealii::TrilinosWrappers::SparseMatrix;

    /** Unknowns of a level that needs none below it. */
    constexpr int coarse_enough = 600;

    std::size_t
    at(const int i)
    {
      return static_cast<std::size_t>(i);
    }

    std::unique_ptr<SparseMatrix>
    to_trilinos(const std::vector<int>                                &first,
                const std::function<void(const int row, SparseRow &)> &row_of,
                const Communicator &processes)
    {
      const int begin = first[at(processes.rank())],
                n     = first[at(processes.rank()) + 1] - begin;
      SparseRow                 row;
      std::vector<unsigned int> length(at(n));
      for (int i = 0; i < n; ++i)
        {
          row_of(i, row);
          length[at(i)] = static_cast<unsigned int>(row.columns.size());
        }
      dealii::IndexSet own(static_cast<unsigned int>(first.back()));
      own.add_range(static_cast<unsigned int>(begin),
                    static_cast<unsigned int>(begin + n));
      auto result =
        std::make_unique<SparseMatrix>(own, processes.handle(), length);
      std::vector<SparseMatrix::size_type> columns;
      for (int i = 0; i < n; ++i)
        {
          row_of(i, row);
          columns.assign(row.columns.begin(), row.columns.end());
          result->set(static_cast<unsigned int>(begin + i),
                      static_cast<unsigned int>(columns.size()),
                      columns.data(),
                      row.values.data(),
                      /*elide_zero_values=*/false);
        }
      result->compress(dealii::VectorOperation::insert);
      return result;
    }

    Teuchos::ParameterList
    parameters(const int block, const Eigen::MatrixXd &modes)
    {
      Teuchos::ParameterList list;
      ML_Epetra::SetDefaults("SA", list);
      list.set("ML output", 0);
      list.set("max levels", 10);
      list.set("PDE equations", block);
      list.set("aggregation: type", "Uncoupled");
      list.set("aggregation: threshold", 0.);
      list.set("aggregation: damping factor", 4. / 3);
      list.set("eigen-analysis: type", "cg");
      list.set("eigen-analysis: iterations", 10);
      list.set("coarse: max size", coarse_enough);
      // The cycle is not ML's.
      list.set("smoother: type", "do-nothing");
      list.set("coarse: type", "do-nothing");
      list.set("null space: type", "pre-computed");
      list.set("null space: dimension", static_cast<int>(modes.cols()));
      list.set("null space: vectors", const_cast<double *>(modes.data()));
      list.set("null space: add default vectors", false);
      return list;
    }

    /** Of the columns that an operator of ML sees, among those of all. */
    std::vector<int>
    number_columns(ML_Operator &matrix, const int begin)
    {
      const int            n    = matrix.invec_leng;
      ML_CommInfoOP *const comm = matrix.getrow->pre_comm;
      int                  more = 0;
      if (comm != nullptr)
        more = std::max(ML_CommInfoOP_Compute_TotalRcvLength(comm), 0);
      std::vector<double> number(at(n + more));
      for (int i = 0; i < n; ++i)
        number[at(i)] = begin + i;
      if (comm != nullptr)
        ML_exchange_bdry(
          number.data(), comm, n, matrix.comm, ML_OVERWRITE, nullptr);
      return {number.begin(), number.end()};
    }

    void
    read_row(ML_Operator *matrix, int row, SparseRow &result)
    {
      int length = 0;
      if (result.columns.empty())
        result.columns.resize(64);
      result.values.resize(result.columns.size());
      while (ML_Operator_Getrow(matrix,
                                1,
                                &row,
                                static_cast<int>(result.columns.size()),
                                result.columns.data(),
                                result.values.data(),
                                &length) == 0)
        {
          result.columns.resize(2 * result.columns.size());
          result.values.resize(result.columns.size());
        }
      result.columns.resize(at(length));
      result.values.resize(result.columns.size());
    }

    /** No names: as they are. */
    void
    rename(SparseRow &row, const std::vector<int> &names)
    {
      if (!names.empty())
        for (int &j : row.columns)
          j = names[at(j)];
    }
  } // namespace



  struct SmoothedAggregation::Implementation
  {
    Eigen::MatrixXd               modes;
    std::unique_ptr<SparseMatrix> matrix;
    // refers to both
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> levels;

    int                           rank = 0;
    std::vector<std::vector<int>> first; ///< of levels
    // of levels, in a run of many processes
    std::vector<std::vector<int>> matrix_columns, prolongator_columns;

    ML &
    ml() const
    {
      return *const_cast<ML *>(levels->GetML());
    }
    void
    number_levels(const std::vector<int> &finest,
                  const Communicator     &processes);
  };



  /* What ML calls columns is known to the process alone. */
  void
  SmoothedAggregation::Implementation::number_levels(
    const std::vector<int> &finest,
    const Communicator     &processes)
  {
    const int n = ml().ML_num_actual_levels;
    rank        = processes.rank();
    first       = {finest};
    matrix_columns.resize(at(n));
    prolongator_columns.resize(at(n));
    for (int l = 1; l < n; ++l)
      {
        const Eigen::VectorXi sizes    = processes.gather_all(Eigen::VectorXi(
          Eigen::VectorXi::Constant(1, ml().Amat[l].outvec_leng)));
        std::vector<int>     &of_level = first.emplace_back(1, 0);
        for (const int size : sizes)
          of_level.push_back(of_level.back() + size);
        if (processes.size() == 1)
          continue;
        const int begin            = of_level[at(processes.rank())];
        matrix_columns[at(l)]      = number_columns(ml().Amat[l], begin);
        prolongator_columns[at(l)] = number_columns(ml().Pmat[l], begin);
      }
  }



  SmoothedAggregation::SmoothedAggregation(
    const std::vector<int>                                &first,
    const int                                              block,
    const std::function<void(const int row, SparseRow &)> &row_of,
    const Eigen::MatrixXd                                 &modes,
    const Communicator                                    &processes)
    : implementation(std::make_unique<Implementation>())
  {
    ProcessSession::require_mpi();
    implementation->modes  = modes;
    implementation->matrix = to_trilinos(first, row_of, processes);
    implementation->levels =
      std::make_unique<ML_Epetra::MultiLevelPreconditioner>(
        implementation->matrix->trilinos_matrix(),
        parameters(block, implementation->modes),
        true);
    if (!implementation->levels->IsPreconditionerComputed())
      throw std::runtime_error("ML has built no levels");
    implementation->number_levels(first, processes);
  }

  SmoothedAggregation::~SmoothedAggregation() = default;

  int
  SmoothedAggregation::n_levels() const
  {
    return implementation->ml().ML_num_actual_levels;
  }

  const std::vector<int> &
  SmoothedAggregation::first(const int level) const
  {
    return implementation->first[at(level)];
  }

  int
  SmoothedAggregation::size(const int level) const
  {
    const std::vector<int> &first = implementation->first[at(level)];
    return first[at(implementation->rank) + 1] -
           first[at(implementation->rank)];
  }

  void
  SmoothedAggregation::matrix_row(const int  level,
                                  const int  row,
                                  SparseRow &result) const
  {
    read_row(&implementation->ml().Amat[level], row, result);
    rename(result, implementation->matrix_columns[at(level)]);
  }

  void
  SmoothedAggregation::prolongator_row(const int  level,
                                       const int  row,
                                       SparseRow &result) const
  {
    read_row(&implementation->ml().Pmat[level], row, result);
    rename(result, implementation->prolongator_columns[at(level)]);
  }
} // namespace conetact::backends
