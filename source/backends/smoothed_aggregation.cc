// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/backends/smoothed_aggregation.h"

#include "conetact/base/process.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_include.h>

#include <stdexcept>

namespace conetact::backends
{
  namespace
  {
    using dealii::TrilinosWrappers::SparseMatrix;

    /** Unknowns of a level that needs none below it. */
    constexpr int coarse_enough = 600;

    std::unique_ptr<SparseMatrix>
    to_trilinos(const int                                              n,
                const std::function<void(const int row, SparseRow &)> &row_of)
    {
      SparseRow                 row;
      std::vector<unsigned int> length(static_cast<std::size_t>(n));
      for (int i = 0; i < n; ++i)
        {
          row_of(i, row);
          length[static_cast<std::size_t>(i)] =
            static_cast<unsigned int>(row.columns.size());
        }
      auto result =
        std::make_unique<SparseMatrix>(dealii::complete_index_set(
                                         static_cast<unsigned int>(n)),
                                       MPI_COMM_SELF,
                                       length);
      std::vector<SparseMatrix::size_type> columns;
      for (int i = 0; i < n; ++i)
        {
          row_of(i, row);
          columns.assign(row.columns.begin(), row.columns.end());
          result->set(static_cast<unsigned int>(i),
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
      result.columns.resize(static_cast<std::size_t>(length));
      result.values.resize(result.columns.size());
    }
  } // namespace



  struct SmoothedAggregation::Implementation
  {
    Eigen::MatrixXd               modes;
    std::unique_ptr<SparseMatrix> matrix;
    // refers to both
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> levels;

    ML &
    ml() const
    {
      return *const_cast<ML *>(levels->GetML());
    }
  };



  SmoothedAggregation::SmoothedAggregation(
    const int                                              n,
    const int                                              block,
    const std::function<void(const int row, SparseRow &)> &row_of,
    const Eigen::MatrixXd                                 &modes)
    : implementation(std::make_unique<Implementation>())
  {
    ProcessSession::require_mpi();
    implementation->modes  = modes;
    implementation->matrix = to_trilinos(n, row_of);
    implementation->levels =
      std::make_unique<ML_Epetra::MultiLevelPreconditioner>(
        implementation->matrix->trilinos_matrix(),
        parameters(block, implementation->modes),
        true);
    if (!implementation->levels->IsPreconditionerComputed())
      throw std::runtime_error("ML has built no levels");
  }

  SmoothedAggregation::~SmoothedAggregation() = default;

  int
  SmoothedAggregation::n_levels() const
  {
    return implementation->ml().ML_num_actual_levels;
  }

  int
  SmoothedAggregation::size(const int level) const
  {
    return implementation->ml().Amat[level].outvec_leng;
  }

  void
  SmoothedAggregation::matrix_row(const int  level,
                                  const int  row,
                                  SparseRow &result) const
  {
    read_row(&implementation->ml().Amat[level], row, result);
  }

  void
  SmoothedAggregation::prolongator_row(const int  level,
                                       const int  row,
                                       SparseRow &result) const
  {
    read_row(&implementation->ml().Pmat[level], row, result);
  }
} // namespace conetact::backends
