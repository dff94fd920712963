// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/amesos.h"

#include "conetact/base/process.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <stdexcept>
#include <vector>

namespace conetact::condensed
{
  namespace
  {
    using RowMatrix      = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    using TrilinosMatrix = dealii::TrilinosWrappers::SparseMatrix;

    /** A copy on this process alone, row by row: the matrix of each process is
     * another one, whatever others do. */
    std::unique_ptr<TrilinosMatrix>
    to_trilinos(const RowMatrix &matrix)
    {
      const auto                n = static_cast<unsigned int>(matrix.rows());
      std::vector<unsigned int> length(n);
      for (unsigned int i = 0; i < n; ++i)
        length[i] = static_cast<unsigned int>(matrix.outerIndexPtr()[i + 1] -
                                              matrix.outerIndexPtr()[i]);
      auto result =
        std::make_unique<TrilinosMatrix>(dealii::complete_index_set(n),
                                         MPI_COMM_SELF,
                                         length);
      std::vector<TrilinosMatrix::size_type> columns;
      for (unsigned int i = 0; i < n; ++i)
        {
          const int begin = matrix.outerIndexPtr()[i];
          columns.assign(matrix.innerIndexPtr() + begin,
                         matrix.innerIndexPtr() + begin + length[i]);
          result->set(i,
                      length[i],
                      columns.data(),
                      matrix.valuePtr() + begin,
                      /*elide_zero_values=*/false);
        }
      result->compress(dealii::VectorOperation::insert);
      return result;
    }
  } // namespace



  struct Amesos::Implementation
  {
    explicit Implementation(std::unique_ptr<TrilinosMatrix> m)
      : matrix(std::move(m))
    {
      problem.SetOperator(
        const_cast<Epetra_CrsMatrix *>(&matrix->trilinos_matrix()));
    }

    // Each member refers to those before it: they are destroyed after it.
    std::unique_ptr<TrilinosMatrix>    matrix;
    Epetra_LinearProblem               problem;
    std::unique_ptr<Amesos_BaseSolver> solver;
    bool                               factorised = false;
  };



  Amesos::Amesos(const std::string &name, const RowMatrix &matrix)
  {
    ProcessSession::require_mpi();
    // Failures are told by us, in a sentence.
    Epetra_Object::SetTracebackMode(0);
    implementation      = std::make_unique<Implementation>(to_trilinos(matrix));
    Implementation &own = *implementation;
    own.solver.reset(::Amesos().Create(name, own.problem));
    if (!own.solver)
      throw std::runtime_error("Trilinos was built without " + name + ".");
    Teuchos::ParameterList parameters;
    parameters.set("OutputLevel", 0);
    Teuchos::ParameterList &mumps = parameters.sublist("mumps");
    mumps.set("ICNTL(6)", 0);    // columns stay where they are
    mumps.set("ICNTL(8)", 0);    // the matrix is scaled already
    mumps.set("ICNTL(14)", 100); // spare workspace [%], not raised later
    own.solver->SetParameters(parameters);
    const ManyThreads threads;
    // A failure may be a singular matrix or want of memory: who asked has to
    // find out.
    own.factorised = own.solver->SymbolicFactorization() == 0 &&
                     own.solver->NumericFactorization() == 0;
  }



  Amesos::~Amesos() = default;



  bool
  Amesos::is_factorised() const
  {
    return implementation->factorised;
  }



  Eigen::MatrixXd
  Amesos::solve(Eigen::MatrixXd b) const
  {
    Assert(b.allFinite(), dealii::ExcMessage("Right-hand sides are finite."));
    Implementation   &own = *implementation;
    Eigen::MatrixXd   x(b.rows(), b.cols());
    const Epetra_Map &map     = own.matrix->trilinos_matrix().RowMap();
    const auto        lead    = static_cast<int>(b.rows());
    const auto        n_sides = static_cast<int>(b.cols());
    // Views: neither side is copied, and the problem must forget them before
    // they go.
    Epetra_MultiVector right(View, map, b.data(), lead, n_sides);
    Epetra_MultiVector left(View, map, x.data(), lead, n_sides);
    own.problem.SetRHS(&right);
    own.problem.SetLHS(&left);
    const int error = own.solver->Solve();
    own.problem.SetRHS(nullptr);
    own.problem.SetLHS(nullptr);
    if (error != 0)
      throw std::runtime_error("Amesos gives up with its error " +
                               std::to_string(error) + ".");
    return x;
  }
} // namespace conetact::condensed
