// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef tests_unit_core_lattice_h
#define tests_unit_core_lattice_h

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <functional>
#include <numeric>
#include <vector>

namespace conetact
{

  struct System
  {
    Eigen::SparseMatrix<double> upper;
    std::vector<unsigned int>   node_of;
  };

  // Springs between neighbors, their diagonals too, of a grid of nodes: each
  // carries stretch and, weakly, transverse motion as well (`shear` = 0: a
  // truss). Nodes are numbered with the last direction slowest and from the
  // top, so that the bottom plane comes last, as contact nodes do; the top
  // plane hangs on springs of stiffness `support`. Null vectors of A without
  // supports and with shear = 0: rigid motions.
  struct Lattice
  {
    std::vector<Eigen::Index> n;
    double                    shear     = .1;
    double                    support   = 1.;
    double                    contrast  = 1.; // stiffness of the lower half
    double                    stiffness = 1.;

    Eigen::Index
    dim() const
    {
      return static_cast<Eigen::Index>(n.size());
    }

    Eigen::Index
    n_nodes() const
    {
      return std::accumulate(n.begin(),
                             n.end(),
                             Eigen::Index(1),
                             std::multiplies<Eigen::Index>());
    }

    Eigen::VectorXd
    point(Eigen::Index node) const
    {
      Eigen::VectorXd x(dim());
      for (Eigen::Index d = 0; d < dim(); ++d)
        {
          x[d] = static_cast<double>(node % n[d]);
          node /= n[d];
        }
      return x;
    }

    System
    assemble() const;
  };

  inline System
  Lattice::assemble() const
  {
    std::vector<Eigen::Triplet<double>> entries;
    const auto                          add = [&](const Eigen::Index     i,
                         const Eigen::Index     j,
                         const Eigen::MatrixXd &block) {
      for (Eigen::Index a = 0; a < dim(); ++a)
        for (Eigen::Index b = 0; b < dim(); ++b)
          if (i * dim() + a <= j * dim() + b)
            entries.emplace_back(i * dim() + a, j * dim() + b, block(a, b));
    };
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(dim(), dim());
    for (Eigen::Index i = 0; i < n_nodes(); ++i)
      {
        for (Eigen::Index j = i + 1; j < n_nodes(); ++j)
          {
            const Eigen::VectorXd x = point(j) - point(i);
            if (x.cwiseAbs().maxCoeff() > 1.)
              continue;
            const Eigen::VectorXd t = x.normalized();
            const bool            lower =
              2 * point(i)[dim() - 1] > point(n_nodes() - 1)[dim() - 1];
            const Eigen::MatrixXd k = stiffness * (lower ? contrast : 1.) *
                                      (t * t.transpose() + shear * identity);
            add(i, i, k);
            add(j, j, k);
            add(i, j, -k);
          }
        if (point(i)[dim() - 1] == 0.)
          add(i, i, stiffness * support * identity);
      }
    System system;
    system.upper.resize(n_nodes() * dim(), n_nodes() * dim());
    system.upper.setFromTriplets(entries.begin(), entries.end());
    for (Eigen::Index i = 0; i < system.upper.cols(); ++i)
      system.node_of.push_back(static_cast<unsigned int>(i / dim()));
    return system;
  }

} // namespace conetact

#endif
