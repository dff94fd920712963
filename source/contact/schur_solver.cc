// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/schur_solver.h"

#include "conetact/base/process.h"
#include "conetact/contact/elimination_order.h"

#include <dmumps_c.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <random>
#include <string>

namespace conetact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;

    // Right-hand sides that MUMPS treats together: enough for matrix-matrix
    // products, few enough to need little memory beside the factor.
    constexpr Index columns_at_once = 64;

    // A strain energy below this part of the sum of its terms taken without
    // signs is rounding.
    constexpr double rounding = 1e-15;

    [[noreturn]] void
    throw_singular(const std::string &what)
    {
      throw SingularMatrix("With the contact unknowns held, " + what +
                           " can still move without resistance: the stiffness "
                           "is not positive definite. Too few supports or "
                           "contact nodes hold the body.");
    }



    // One instance of MUMPS. What it complains of becomes exceptions.
    class Mumps
    {
    public:
      Mumps()
      {
        data.sym          = 1; // positive definite
        data.par          = 1;
        data.comm_fortran = ProcessSession::require_mpi();
        run(-1);
        control(1) = control(2) = control(3) = -1; // silent
        control(4)                           = 0;
        control(7)                           = 1;  // the order is given
        control(8)                           = 0;  // scaling costs accuracy
        control(14)                          = 20; // spare workspace [%]
        control(28)                          = 1;  // sequential analysis
      }

      ~Mumps()
      {
        if (ProcessSession::mpi_is_running())
          call(-2);
      }

      Mumps(const Mumps &) = delete;
      Mumps &
      operator=(const Mumps &) = delete;

      // ICNTL and INFOG, counted from 1 as in the manual of MUMPS.
      int &
      control(const int i)
      {
        return data.icntl[i - 1];
      }

      int
      info(const int i) const
      {
        return data.infog[i - 1];
      }

      void
      run(const int job)
      {
        call(job);
        throw_errors();
      }

      // The workspace is estimated by the analysis, and may be short.
      void
      factorize()
      {
        for (call(2); (info(1) == -8 || info(1) == -9) && control(14) < 2000;
             call(2))
          control(14) *= 3;
        throw_errors();
        if (info(12) > 0) // negative pivots
          throw_singular("a part of the body");
      }

      DMUMPS_STRUC_C data{};

    private:
      void
      call(const int job)
      {
        data.job = job;
        dmumps_c(&data);
      }

      void
      throw_errors() const
      {
        if (info(1) == -5 || info(1) == -7 || info(1) == -13)
          throw std::bad_alloc();
        if (info(1) == -10)
          throw_singular("a part of the body");
        if (info(1) < 0)
          throw std::runtime_error("MUMPS gives up with its error " +
                                   std::to_string(info(1)) + " (" +
                                   std::to_string(info(2)) + ").");
      }
    };



    void
    check_input(const SparseMatrix              &upper,
                const Index                      n_schur,
                const std::vector<unsigned int> &node_of)
    {
      if (upper.rows() != upper.cols() || n_schur < 0 ||
          n_schur > upper.cols() ||
          node_of.size() != static_cast<std::size_t>(upper.cols()))
        throw std::invalid_argument("The sizes of a matrix, of its Schur "
                                    "complement and of its nodes disagree.");
    }

    // Copies the upper triangle to the lower one, by blocks that fit into the
    // cache.
    void
    mirror_upper_triangle(MatrixXd &matrix)
    {
      constexpr Index size = 64;
      const Index     n    = matrix.cols();
      for (Index j = 0; j < n; j += size)
        {
          const Index width = std::min(size, n - j);
          for (Index i = 0; i < j; i += size)
            matrix.block(j, i, width, size) =
              matrix.block(i, j, size, width).transpose();
          matrix.block(j, j, width, width)
            .triangularView<Eigen::StrictlyLower>() =
            MatrixXd(matrix.block(j, j, width, width)).transpose();
        }
    }
  } // namespace



  struct SchurSolver::Implementation
  {
    Implementation(const SparseMatrix              &upper,
                   const Index                      n_schur,
                   const std::vector<unsigned int> &node_of);

    const Index            n, n_schur, n_eliminated;
    MatrixXd               schur;
    std::vector<int>       schur_unknowns;
    std::unique_ptr<Mumps> mumps; // none where nothing is eliminated

    void
    factorize(const SparseMatrix &upper, std::vector<int> order);

    void
    refuse_free_motion(const SparseMatrix              &upper,
                       const std::vector<unsigned int> &node_of);

    // MUMPS' ways to treat the right-hand sides b, which it overwrites.
    enum Phase
    {
      eliminated_only = 0,
      reduction       = 1,
      expansion       = 2
    };

    void
    solve(const Phase phase, Eigen::Ref<MatrixXd> b, MatrixXd &reduced);
  };



  SchurSolver::Implementation::Implementation(
    const SparseMatrix              &upper,
    const Index                      n_schur_unknowns,
    const std::vector<unsigned int> &node_of)
    : n(upper.cols())
    , n_schur(n_schur_unknowns)
    , n_eliminated(n - n_schur)
  {
    if (n_eliminated == 0)
      {
        schur = MatrixXd(upper);
        mirror_upper_triangle(schur);
        return;
      }
    const VectorXd diagonal = upper.diagonal();
    for (Index i = 0; i < n_eliminated; ++i)
      if (!(diagonal[i] > 0.))
        throw_singular("node " + std::to_string(node_of[i]));

    mumps = std::make_unique<Mumps>();
    factorize(upper, elimination_order(upper, n_eliminated, node_of));
    mirror_upper_triangle(schur);
    refuse_free_motion(upper, node_of);
  }



  // The values are handed over as they are, the indices counted from 1.
  void
  SchurSolver::Implementation::factorize(const SparseMatrix &upper,
                                         std::vector<int>    order)
  {
    const std::size_t n_entries = static_cast<std::size_t>(upper.nonZeros());
    std::vector<int>  rows(n_entries), columns(n_entries);
    for (Index k = 0, column = 0; column < n; ++column)
      for (SparseMatrix::InnerIterator entry(upper, column); entry; ++entry)
        {
          rows[k]      = static_cast<int>(entry.row()) + 1;
          columns[k++] = static_cast<int>(column) + 1;
        }
    for (int &place : order)
      ++place;

    DMUMPS_STRUC_C &data = mumps->data;
    data.n               = static_cast<int>(n);
    data.nnz             = upper.nonZeros();
    data.irn             = rows.data();
    data.jcn             = columns.data();
    data.a               = const_cast<double *>(upper.valuePtr());
    data.perm_in         = order.data();
    if (n_schur > 0)
      {
        schur_unknowns.resize(n_schur);
        std::iota(schur_unknowns.begin(),
                  schur_unknowns.end(),
                  static_cast<int>(n_eliminated) + 1);
        // Row by row the lower triangle: column by column the upper one.
        schur.resize(n_schur, n_schur);
        mumps->control(19) = 1;
        data.size_schur    = static_cast<int>(n_schur);
        data.listvar_schur = schur_unknowns.data();
        data.schur         = schur.data();
      }
    mumps->run(1);
    mumps->factorize();
    data.irn = data.jcn = data.perm_in = nullptr;
    data.a                             = nullptr;
  }



  // The pivots of a singular matrix are small, positive and no smaller than
  // those of some slender beam. What a beam does not have is a displacement
  // whose strain energy is lost in rounding. One step of inverse iteration
  // finds it where it exists; scaled by the diagonal, it depends neither on
  // units nor on the contrast of stiffness.
  void
  SchurSolver::Implementation::refuse_free_motion(
    const SparseMatrix              &upper,
    const std::vector<unsigned int> &node_of)
  {
    const VectorXd   scale = upper.diagonal().head(n_eliminated).cwiseSqrt();
    std::minstd_rand random;
    constexpr double range = std::minstd_rand::max();
    MatrixXd         v     = MatrixXd::Zero(n, 1);
    for (Index i = 0; i < n_eliminated; ++i)
      v(i) = scale[i] * (2. * static_cast<double>(random()) / range - 1.);
    MatrixXd reduced = MatrixXd::Zero(n_schur, 1);
    solve(eliminated_only, v, reduced);

    long double energy = 0., without_signs = 0.;
    for (Index column = 0; column < n_eliminated; ++column)
      for (SparseMatrix::InnerIterator entry(upper, column); entry; ++entry)
        {
          const long double twice = entry.row() == column ? 1. : 2.;
          const long double term =
            twice * entry.value() * v(entry.row()) * v(column);
          energy += term;
          without_signs += std::abs(term);
        }
    if (energy > rounding * without_signs)
      return;
    Index where = 0;
    v.col(0).head(n_eliminated).cwiseProduct(scale).cwiseAbs().maxCoeff(&where);
    throw_singular("what surrounds node " + std::to_string(node_of[where]));
  }



  void
  SchurSolver::Implementation::solve(const Phase          phase,
                                     Eigen::Ref<MatrixXd> b,
                                     MatrixXd            &reduced)
  {
    DMUMPS_STRUC_C &data = mumps->data;
    data.rhs             = b.data();
    data.nrhs            = static_cast<int>(b.cols());
    data.lrhs            = static_cast<int>(n);
    data.redrhs          = reduced.data();
    data.lredrhs         = static_cast<int>(n_schur);
    mumps->control(26)   = phase;
    mumps->control(27)   = static_cast<int>(columns_at_once);
    mumps->run(3);
  }



  SchurSolver::SchurSolver(const SparseMatrix              &upper,
                           const Index                      n_schur,
                           const std::vector<unsigned int> &node_of)
  {
    check_input(upper, n_schur, node_of);
    if (upper.isCompressed())
      implementation =
        std::make_unique<Implementation>(upper, n_schur, node_of);
    else
      {
        SparseMatrix compressed = upper;
        compressed.makeCompressed();
        implementation =
          std::make_unique<Implementation>(compressed, n_schur, node_of);
      }
  }



  SchurSolver::~SchurSolver() = default;



  MatrixXd
  SchurSolver::take_schur_complement()
  {
    return std::move(implementation->schur);
  }



  MatrixXd
  SchurSolver::reduce(const MatrixXd &b) const
  {
    Implementation &solver  = *implementation;
    MatrixXd        reduced = b.bottomRows(solver.n_schur);
    if (reduced.size() == 0 || b.topRows(solver.n_eliminated).isZero(0.))
      return reduced;
    for (Index first = 0; first < b.cols(); first += columns_at_once)
      {
        const Index count = std::min(columns_at_once, b.cols() - first);
        MatrixXd    work  = b.middleCols(first, count);
        MatrixXd    result(solver.n_schur, count);
        solver.solve(Implementation::reduction, work, result);
        reduced.middleCols(first, count) = result;
      }
    return reduced;
  }



  MatrixXd
  SchurSolver::expand(const MatrixXd &b, const MatrixXd &u_C) const
  {
    Implementation &solver = *implementation;
    MatrixXd        u      = b;
    for (Index first = 0; first < b.cols() && solver.n_eliminated > 0;
         first += columns_at_once)
      {
        const Index count = std::min(columns_at_once, b.cols() - first);
        auto        block = u.middleCols(first, count);
        MatrixXd    reduced(solver.n_schur, count);
        if (solver.n_schur == 0)
          {
            solver.solve(Implementation::eliminated_only, block, reduced);
            continue;
          }
        // The forward elimination stays inside MUMPS for the expansion.
        solver.solve(Implementation::reduction, block, reduced);
        reduced = u_C.middleCols(first, count);
        solver.solve(Implementation::expansion, block, reduced);
      }
    u.bottomRows(solver.n_schur) = u_C;
    return u;
  }



  double
  SchurSolver::factor_bytes() const
  {
    if (!implementation->mumps)
      return 0.;
    // In millions where the number does not fit.
    const double n_entries = implementation->mumps->info(29);
    return sizeof(double) * (n_entries < 0. ? -1e6 * n_entries : n_entries);
  }
} // namespace conetact
