// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/exchange/fclib_global.h"

#include "conetact/exchange/fclib_arrays.h"

#include <algorithm>
#include <vector>

namespace conetact::exchange
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    const std::string root = "/fclib_global/";

    /** Columns of H that are solved for together. */
    constexpr Index chunk = 128;

    void
    add(const Eigen::SparseMatrix<double>   &A,
        const Index                          first_row,
        const Index                          first_column,
        std::vector<Eigen::Triplet<double>> &entries)
    {
      for (Index j = 0; j < A.outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator e(A, j); e; ++e)
          entries.emplace_back(static_cast<int>(first_row + e.row()),
                               static_cast<int>(first_column + e.col()),
                               e.value());
    }
  } // namespace



  FclibGlobal::FclibGlobal(const Hdf5File &file)
  {
    read(file);
    factorize(file);
  }



  void
  FclibGlobal::read(const Hdf5File &file)
  {
    // H has more rows than columns, or the like: it tells for all
    const bool columns_first = has_columns_first(file, root + "H/");
    M = read_matrix(file, root + "M/", "M", columns_first);
    H = read_matrix(file, root + "H/", "H", columns_first);
    if (M.rows() != M.cols())
      file.fail("the matrix M is not square");
    if (H.rows() != M.rows())
      file.fail("the matrix H has " + std::to_string(H.rows()) +
                " rows, but M has " + std::to_string(M.rows()));
    if (H.cols() > max_contact_unknowns)
      file.fail("the matrix H has " + std::to_string(H.cols()) +
                " columns; 1 to " + std::to_string(max_contact_unknowns) +
                " can be treated");
    G.resize(M.rows(), 0);
    if (file.has(root + "G"))
      G = read_matrix(file, root + "G/", "G", columns_first);
    if (G.rows() != M.rows())
      file.fail("the matrix G has " + std::to_string(G.rows()) +
                " rows, but M has " + std::to_string(M.rows()));
    f = read_vector(file, root + "vectors/f", M.rows());
    w = read_vector(file, root + "vectors/w", H.cols());
    b = G.cols() > 0 ? read_vector(file, root + "vectors/b", G.cols()) :
                       VectorXd();
  }



  /* A singular matrix may pass as a regular one with a tiny pivot: a random
     right-hand side tells. */
  void
  FclibGlobal::factorize(const Hdf5File &file)
  {
    const Index                         n = M.rows(), m = G.cols();
    std::vector<Eigen::Triplet<double>> entries;
    add(M, 0, 0, entries);
    add(-G, 0, n, entries);
    add(G.transpose(), n, 0, entries);
    Sparse A(n + m, n + m);
    A.setFromTriplets(entries.begin(), entries.end());
    lu.compute(A);
    bool regular = lu.info() == Eigen::Success;
    if (regular)
      {
        const VectorXd x    = VectorXd::LinSpaced(n + m, 1, 2);
        const VectorXd back = lu.solve(VectorXd(A * x));
        regular = back.allFinite() && (back - x).norm() < 1e-6 * x.norm();
      }
    if (!regular)
      file.fail(m > 0 ? "the matrix of the bodies and their bilateral "
                        "constraints, M with G, is singular: a body without "
                        "mass, or constraints that say the same twice; remove "
                        "them" :
                        "the matrix M is singular: a body without mass or "
                        "stiffness; give it some");
  }



  MatrixXd
  FclibGlobal::solve(const MatrixXd &forces, const VectorXd &right) const
  {
    MatrixXd rhs          = MatrixXd::Zero(M.rows() + G.cols(), forces.cols());
    rhs.topRows(M.rows()) = forces;
    if (right.size() > 0)
      rhs.bottomRows(G.cols()).colwise() = -right;
    return lu.solve(rhs);
  }



  MatrixXd
  FclibGlobal::compliance() const
  {
    MatrixXd     W(H.cols(), H.cols());
    const Sparse T = H.transpose();
    for (Index k = 0; k < H.cols(); k += chunk)
      {
        const Index    size = std::min(chunk, H.cols() - k);
        const MatrixXd X = solve(MatrixXd(H.middleCols(k, size)), VectorXd());
        W.middleCols(k, size) = T * X.topRows(M.rows());
      }
    return W;
  }



  VectorXd
  FclibGlobal::free_velocity() const
  {
    const VectorXd x = solve(f, b);
    return H.transpose() * x.head(M.rows()) + w;
  }



  FclibGlobal::Bodies
  FclibGlobal::bodies(const VectorXd &r) const
  {
    const VectorXd x = solve(VectorXd(H * r + f), b);
    return {x.head(M.rows()), x.tail(G.cols())};
  }
} // namespace conetact::exchange
