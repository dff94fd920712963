// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/condensed/mumps_schur.h"

#include "conetact/condensed/elimination_order.h"
#include "conetact/condensed/free_motion.h"
#include "conetact/condensed/mumps.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace conetact::condensed
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
    using SparseMatrix = Eigen::SparseMatrix<double>;

    // MUMPS gives a number that does not fit in millions, with a minus.
    double
    in_full(const int number)
    {
      return number < 0 ? -1e6 * number : number;
    }

    // Right-hand sides that MUMPS treats together: enough for matrix-matrix
    // products, few enough to need little memory beside the factor.
    constexpr Index columns_at_once = 64;

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



  struct MumpsSchur::Implementation
  {
    Implementation(const SparseMatrix &upper, const Index n_schur);

    const Index            n, n_schur, n_eliminated;
    MatrixXd               schur;
    std::vector<int>       schur_unknowns;
    std::vector<double>    scale; // in use as long as MUMPS
    std::unique_ptr<Mumps> mumps; // none where nothing is eliminated
    SchurWork              work;

    // Leaves MUMPS with pointers to the matrix.
    void
    analyse(const SparseMatrix              &upper,
            const std::vector<unsigned int> &node_of);
    void
    factorize(const SparseMatrix              &upper,
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

    // Leaves the forward elimination of b = 0 inside MUMPS at no cost: it is
    // given sparse right-hand sides with a single entry, a zero of an unknown
    // C.
    void
    reduce_nothing(Eigen::Ref<MatrixXd> b, MatrixXd &reduced);

  private:
    std::vector<int> rows, columns, order; // counted from 1
  };



  MumpsSchur::Implementation::Implementation(const SparseMatrix &upper,
                                             const Index n_schur_unknowns)
    : n(upper.cols())
    , n_schur(n_schur_unknowns)
    , n_eliminated(n - n_schur)
  {}



  /* Triplets of the upper triangle: with a symmetric matrix MUMPS takes either
     one. Values stay where they are, as MUMPS copies them when it
     factorises. */
  void
  MumpsSchur::Implementation::analyse(const SparseMatrix              &upper,
                                      const std::vector<unsigned int> &node_of)
  {
    const std::size_t n_entries = static_cast<std::size_t>(upper.nonZeros());
    rows.resize(n_entries);
    columns.resize(n_entries);
    for (Index k = 0, column = 0; column < n; ++column)
      for (SparseMatrix::InnerIterator entry(upper, column); entry; ++entry)
        {
          rows[k]      = static_cast<int>(entry.row()) + 1;
          columns[k++] = static_cast<int>(column) + 1;
        }
    order = elimination_order(upper, n_eliminated, node_of);
    for (int &place : order)
      ++place;

    mumps                = std::make_unique<Mumps>();
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
        // The Schur complement comes dense and on this process; its unknowns
        // are the last ones of the order that is given.
        mumps->control(19) = 1;
        data.size_schur    = static_cast<int>(n_schur);
        data.listvar_schur = schur_unknowns.data();
      }
    mumps->analyse();
  }



  void
  MumpsSchur::Implementation::factorize(
    const SparseMatrix              &upper,
    const std::vector<unsigned int> &node_of)
  {
    if (n_eliminated == 0)
      {
        schur = MatrixXd(upper);
        mirror_upper_triangle(schur);
        return;
      }
    const VectorXd diagonal = upper.diagonal();
    // Cheap, and it names the node; MUMPS would only say that a pivot is zero.
    refuse_empty_diagonal(diagonal.head(n_eliminated), node_of);
    analyse(upper, node_of);
    DMUMPS_STRUC_C &data = mumps->data;
    if (n_schur > 0)
      {
        // Row by row the lower triangle: column by column the upper one.
        schur.resize(n_schur, n_schur);
        data.schur = schur.data();
      }
    scale       = uneven_scale(n_eliminated, n);
    data.rowsca = scale.data();
    data.colsca = scale.data();
    mumps->factorize();
    ++work.factorizations;
    work.condensations += n_schur > 0;
    // MUMPS has its own copy now, and the caller may drop the matrix.
    data.irn = data.jcn = data.perm_in = nullptr;
    data.a                             = nullptr;
    rows = columns = order = std::vector<int>();
    mirror_upper_triangle(schur);

    // A factor without zero pivots is no proof: see free_motion.h.
    MatrixXd v = MatrixXd::Zero(n, 1), none = MatrixXd::Zero(n_schur, 1);
    v.topRows(n_eliminated) = probe_load(diagonal.head(n_eliminated));
    solve(eliminated_only, v, none);
    refuse_free_motion(upper, v.topRows(n_eliminated), node_of);
  }



  /* MUMPS overwrites b by its answer. A plain solve goes through the factor
     forwards and backwards, a reduction only forwards, an expansion only
     backwards. */
  void
  MumpsSchur::Implementation::solve(const Phase          phase,
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
    mumps->solve();
    const auto n_columns = static_cast<unsigned int>(b.cols());
    work.triangular_solves += (phase == eliminated_only ? 2 : 1) * n_columns;
  }



  void
  MumpsSchur::Implementation::reduce_nothing(Eigen::Ref<MatrixXd> b,
                                             MatrixXd            &reduced)
  {
    const auto          count = static_cast<int>(b.cols());
    std::vector<int>    first(b.cols() + 1), row(b.cols(), static_cast<int>(n));
    std::vector<double> value(b.cols(), 0.);
    std::iota(first.begin(), first.end(), 1);
    DMUMPS_STRUC_C &data = mumps->data;
    data.nz_rhs          = count;
    data.irhs_ptr        = first.data();
    data.irhs_sparse     = row.data();
    data.rhs_sparse      = value.data();
    // Sparse right-hand sides, for this call only.
    mumps->control(20) = 1;
    solve(reduction, b, reduced);
    mumps->control(20) = 0;
    work.triangular_solves -= static_cast<unsigned int>(count);
  }



  MumpsSchur::MumpsSchur(const SparseMatrix              &upper,
                         const Index                      n_schur,
                         const std::vector<unsigned int> &node_of)
  {
    check_schur_input(upper, n_schur, node_of);
    implementation = std::make_unique<Implementation>(upper, n_schur);
    if (upper.isCompressed())
      implementation->factorize(upper, node_of);
    else
      {
        SparseMatrix compressed = upper;
        compressed.makeCompressed();
        implementation->factorize(compressed, node_of);
      }
  }



  FactorEstimate
  MumpsSchur::estimate(const SparseMatrix              &upper,
                       const Index                      n_schur,
                       const std::vector<unsigned int> &node_of)
  {
    check_schur_input(upper, n_schur, node_of);
    if (upper.cols() == n_schur)
      return {};
    Implementation solver(upper, n_schur);
    solver.analyse(upper, node_of);
    const Mumps &mumps = *solver.mumps;
    // The analysis estimates entries of the factor, INFOG(3), workspace in MB,
    // INFOG(17), and operations, RINFOG(1).
    return {sizeof(double) * in_full(mumps.info(3)),
            1e6 * mumps.info(17),
            mumps.data.rinfog[0],
            0};
  }



  MumpsSchur::~MumpsSchur() = default;



  MatrixXd
  MumpsSchur::take_schur_complement()
  {
    AssertDimension(implementation->schur.rows(), implementation->n_schur);
    return std::move(implementation->schur);
  }



  MatrixXd
  MumpsSchur::reduce(const MatrixXd &b) const
  {
    AssertDimension(b.rows(), implementation->n);
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
    solver.work.reductions += static_cast<unsigned int>(b.cols());
    return reduced;
  }



  MatrixXd
  MumpsSchur::expand(const MatrixXd &b, const MatrixXd &u_C) const
  {
    AssertDimension(b.rows(), implementation->n);
    AssertDimension(u_C.rows(), implementation->n_schur);
    AssertDimension(u_C.cols(), b.cols());
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
        // A_FF = L D L^T: the reduction leaves the forward elimination of b_F
        // inside MUMPS, the expansion takes u_C and solves backwards. One is no
        // use without the other. Prescribed displacements without loads need no
        // forward elimination.
        if (block.topRows(solver.n_eliminated).isZero(0.))
          solver.reduce_nothing(block, reduced);
        else
          solver.solve(Implementation::reduction, block, reduced);
        // One array for both: reduced loads go out, u_C comes in.
        reduced = u_C.middleCols(first, count);
        solver.solve(Implementation::expansion, block, reduced);
      }
    if (solver.n_eliminated > 0)
      solver.work.expansions += static_cast<unsigned int>(b.cols());
    u.bottomRows(solver.n_schur) = u_C;
    return u;
  }



  double
  MumpsSchur::factor_bytes() const
  {
    if (!implementation->mumps)
      return 0.;
    return sizeof(double) * in_full(implementation->mumps->info(29));
  }



  const SchurWork &
  MumpsSchur::work() const
  {
    return implementation->work;
  }
} // namespace conetact::condensed
