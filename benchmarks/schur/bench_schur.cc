// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Cost of the condensation beside that of CHOLMOD, on blocks of n x n x n
// cubes with all unknowns of the bottom as Schur unknowns and the top fixed:
//   bench-schur [--threads N] [n ...]
// Prints CPU seconds (wall seconds with several threads). CHOLMOD factorises
// the stiffness of the eliminated unknowns alone, in the same order.

#include "conetact/base/process.h"
#include "conetact/condensed/elimination_order.h"
#include "conetact/condensed/mumps_schur.h"

#ifdef CONETACT_WITH_CHOLMOD
#  include <cholmod.h>
#endif

#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using SparseMatrix = Eigen::SparseMatrix<double>;

  double
  seconds()
  {
    if (conetact::ProcessSession::n_threads() == 1)
      return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  // Corner c of the unit cube.
  Eigen::Vector3d
  corner(const int c)
  {
    return {double(c & 1), double(c >> 1 & 1), double(c >> 2)};
  }

  // Stiffness of the trilinear unit cube, Young's modulus 1.
  Eigen::Matrix<double, 24, 24>
  cell_stiffness(const double nu)
  {
    const double                lambda = nu / ((1. + nu) * (1. - 2. * nu));
    const double                shear  = .5 / (1. + nu);
    Eigen::Matrix<double, 6, 6> C      = Eigen::Matrix<double, 6, 6>::Zero();
    C.topLeftCorner<3, 3>().setConstant(lambda);
    C.diagonal() << lambda + 2. * shear, lambda + 2. * shear,
      lambda + 2. * shear, shear, shear, shear;
    Eigen::Matrix<double, 24, 24> K = Eigen::Matrix<double, 24, 24>::Zero();
    for (int q = 0; q < 8; ++q)
      {
        const Eigen::Vector3d x =
          Eigen::Vector3d::Constant(.5) +
          (corner(q) - Eigen::Vector3d::Constant(.5)) / std::sqrt(3.);
        Eigen::Matrix<double, 6, 24> B = Eigen::Matrix<double, 6, 24>::Zero();
        for (int c = 0; c < 8; ++c)
          {
            Eigen::Vector3d value, slope, g;
            for (int d = 0; d < 3; ++d)
              {
                slope[d] = corner(c)[d] > 0. ? 1. : -1.;
                value[d] = corner(c)[d] > 0. ? x[d] : 1. - x[d];
              }
            g << slope[0] * value[1] * value[2], value[0] * slope[1] * value[2],
              value[0] * value[1] * slope[2];
            B.middleCols<3>(3 * c) << g[0], 0, 0, 0, g[1], 0, 0, 0, g[2], g[1],
              g[0], 0, 0, g[2], g[1], g[2], 0, g[0];
          }
        K += B.transpose() * C * B / 8.;
      }
    return K;
  }

  struct Block
  {
    SparseMatrix              upper;
    Index                     n_schur;
    std::vector<unsigned int> node_of;
  };

  // Node (i, j, k) has the number i + m j + m m k, m = n + 1; k counts
  // downwards from the first plane below the fixed top, so that the bottom
  // comes last.
  Block
  assemble(const int n)
  {
    const Eigen::Matrix<double, 24, 24> K = cell_stiffness(.3);
    const int                           m = n + 1, n_nodes = m * m * n;
    Block                               block;
    block.n_schur = 3 * m * m;
    block.upper.resize(3 * n_nodes, 3 * n_nodes);
    block.upper.reserve(Eigen::VectorXi::Constant(3 * n_nodes, 42));
    for (int node = 0; node < n_nodes; ++node)
      {
        const std::array<int, 3> x = {{node % m, node / m % m, node / (m * m)}};
        std::array<Eigen::Matrix3d, 27> stencil;
        stencil.fill(Eigen::Matrix3d::Zero());
        for (int own = 0; own < 8; ++own) // corner of the cell that is `node`
          {
            const int cx = x[0] - (own & 1), cy = x[1] - (own >> 1 & 1),
                      cz = x[2] - (own >> 2);
            if (cx < 0 || cx >= n || cy < 0 || cy >= n || cz < -1 ||
                cz >= n - 1)
              continue;
            for (int other = 0; other < 8; ++other)
              stencil[13 + (other & 1) - (own & 1) +
                      3 * ((other >> 1 & 1) - (own >> 1 & 1)) +
                      9 * ((other >> 2) - (own >> 2))] +=
                K.block<3, 3>(3 * other, 3 * own);
          }
        for (int column = 0; column < 3; ++column)
          for (int s = 0; s <= 13; ++s) // neighbors with smaller numbers
            {
              const int dx = s % 3 - 1, dy = s / 3 % 3 - 1, dz = s / 9 - 1;
              if (x[0] + dx < 0 || x[0] + dx >= m || x[1] + dy < 0 ||
                  x[1] + dy >= m || x[2] + dz < 0)
                continue;
              const int neighbor = node + dx + m * dy + m * m * dz;
              for (int row = 0; row < (s == 13 ? column + 1 : 3); ++row)
                block.upper.insert(3 * neighbor + row, 3 * node + column) =
                  stencil[s](row, column);
            }
        block.node_of.insert(block.node_of.end(), 3, node);
      }
    block.upper.makeCompressed();
    return block;
  }

#ifdef CONETACT_WITH_CHOLMOD
  // Seconds of the analysis in the given order, and of the factorisation.
  std::array<double, 2>
  time_cholmod(const Block &block, const std::vector<int> &places)
  {
    const int        n = static_cast<int>(block.upper.cols() - block.n_schur);
    SparseMatrix     A = block.upper.topLeftCorner(n, n);
    std::vector<int> order(n);
    for (int i = 0; i < n; ++i)
      order[places[i]] = i;

    cholmod_common common;
    cholmod_start(&common);
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.supernodal         = CHOLMOD_SUPERNODAL;
    cholmod_sparse matrix{};
    matrix.nrow = matrix.ncol = n;
    matrix.nzmax              = A.nonZeros();
    matrix.p                  = A.outerIndexPtr();
    matrix.i                  = A.innerIndexPtr();
    matrix.x                  = A.valuePtr();
    matrix.stype              = 1;
    matrix.xtype              = CHOLMOD_REAL;
    matrix.sorted = matrix.packed = 1;

    const double    t0 = seconds();
    cholmod_factor *L =
      cholmod_analyze_p(&matrix, order.data(), nullptr, 0, &common);
    const double t1 = seconds();
    cholmod_factorize(&matrix, L, &common);
    const double t2 = seconds();
    if (common.status != CHOLMOD_OK)
      std::fprintf(stderr, "CHOLMOD: status %d\n", common.status);
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
    return {{t1 - t0, t2 - t1}};
  }
#else
  std::array<double, 2>
  time_cholmod(const Block &, const std::vector<int> &)
  {
    return {{0., 0.}};
  }
#endif

  void
  run(const int n)
  {
    const Block  block = assemble(n);
    const double t0    = seconds();
    const auto   places =
      conetact::condensed::elimination_order(block.upper,
                                             block.upper.cols() - block.n_schur,
                                             block.node_of);
    const double                    t1 = seconds();
    conetact::condensed::MumpsSchur solver(block.upper,
                                           block.n_schur,
                                           block.node_of);
    const MatrixXd                  S  = solver.take_schur_complement();
    const double                    t2 = seconds();
    const MatrixXd                  b  = MatrixXd::Ones(block.upper.cols(), 11);
    const MatrixXd                  r  = solver.reduce(b);
    const double                    t3 = seconds();
    solver.expand(b, r);
    const double t4 = seconds();

    const auto   cholmod = time_cholmod(block, places);
    const double ours = t2 - t1, theirs = cholmod[0] + cholmod[1];
    std::printf("| %d | %td | %td | %.3f | %.3f | %.3f | %.3f | %.2f | %.3f "
                "| %.3f | %.2f | %.2f |\n",
                n,
                block.upper.cols(),
                block.n_schur,
                t1 - t0,
                ours,
                t3 - t2,
                t4 - t3,
                1e-9 * solver.factor_bytes(),
                cholmod[0],
                cholmod[1],
                ours / theirs,
                ours / cholmod[1]);
    std::fflush(stdout);
  }
} // namespace

int
main(int argc, char **argv)
{
  // CHOLMOD asks for four threads wherever it may, and they spin.
  if (std::getenv("OMP_THREAD_LIMIT") == nullptr)
    {
      setenv("OMP_THREAD_LIMIT", "1", 1);
      execv("/proc/self/exe", argv);
    }
  std::vector<int> sizes;
  unsigned int     n_threads = 1;
  for (int i = 1; i < argc; ++i)
    if (argv[i] == std::string("--threads") && i + 1 < argc)
      n_threads = static_cast<unsigned int>(std::atoi(argv[++i]));
    else
      sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty())
    sizes = {20, 24, 30, 40};

  const conetact::ProcessSession session(n_threads);
  const Block                    tiny = assemble(2); // starts MPI
  conetact::condensed::MumpsSchur(tiny.upper, tiny.n_schur, tiny.node_of);
  std::printf("%s seconds; factor in GB; 11 right-hand sides; ratios to "
              "CHOLMOD with and without its analysis\n\n"
              "| n | unknowns | Schur | METIS | METIS and S | reduce | expand "
              "| factor | CHOLMOD analysis | CHOLMOD | ratio | without |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
              conetact::ProcessSession::n_threads() == 1 ? "CPU" : "Wall");
  for (const int n : sizes)
    run(n);
}
