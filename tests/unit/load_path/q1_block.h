// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_q1_block_h
#define conetact_tests_q1_block_h

#include "conetact/solvers/contact_problem.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

/**
 * An elastic block, 0 .. b by 0 .. h, of nx by ny bilinear elements in plane
 * strain, free but for its bottom, which stands on a rough floor: small enough
 * to be condensed by dense algebra.
 */
namespace conetact
{
  using namespace solvers;

  class Q1Block
  {
  public:
    using Index = Eigen::Index;

    Q1Block(const double width,
            const double height,
            const Index  columns,
            const Index  rows,
            const double young   = 1e6,
            const double poisson = .3)
      : b(width)
      , h(height)
      , nx(columns)
      , ny(rows)
      , stiffness(Eigen::MatrixXd::Zero(n_dofs(), n_dofs()))
    {
      const Eigen::Matrix<double, 8, 8> cell = cell_stiffness(young, poisson);
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i)
          {
            const std::vector<Index> dofs = cell_dofs(i, j);
            for (Index r = 0; r < 8; ++r)
              for (Index c = 0; c < 8; ++c)
                stiffness(dofs[static_cast<std::size_t>(r)],
                          dofs[static_cast<std::size_t>(c)]) += cell(r, c);
          }
      const Index nc = 2 * (nx + 1), nf = n_dofs() - nc;
      // contact dofs come first: the bottom row
      inner = stiffness.bottomRightCorner(nf, nf).llt();
    }

    /** The bottom nodes, (u_x, u_y) each, as a contact system. */
    std::shared_ptr<const ContactSystem>
    system(const double mu) const
    {
      const Index nc = 2 * (nx + 1), nf = n_dofs() - nc;
      auto        s = std::make_shared<ContactSystem>();
      s->matrix     = stiffness.topLeftCorner(nc, nc) -
                  stiffness.topRightCorner(nc, nf) *
                    inner.solve(stiffness.bottomLeftCorner(nf, nc));
      s->matrix = .5 * (s->matrix + s->matrix.transpose()).eval();
      for (Index i = 0; i <= nx; ++i)
        s->first.push_back(2 * (i + 1));
      s->mu         = Eigen::VectorXd::Constant(nx + 1, mu);
      s->null_space = Eigen::MatrixXd::Zero(nc, 3);
      for (Index i = 0; i <= nx; ++i)
        {
          s->null_space(2 * i, 0)     = 1;
          s->null_space(2 * i + 1, 1) = 1;
          s->null_space(2 * i + 1, 2) = x(i);
        }
      return s;
    }

    Eigen::VectorXd
    condensed(const Eigen::VectorXd &load) const
    {
      const Index nc = 2 * (nx + 1), nf = n_dofs() - nc;
      return load.head(nc) -
             stiffness.topRightCorner(nc, nf) * inner.solve(load.tail(nf));
    }

    Eigen::VectorXd
    weight(const double total) const
    {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(n_dofs());
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i)
          for (const Index d : cell_dofs(i, j))
            if (d % 2 == 1)
              f(d) -= total / static_cast<double>(4 * nx * ny);
      return f;
    }

    /** A horizontal force at a height on the left side. */
    Eigen::VectorXd
    push(const double force, const double height) const
    {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(n_dofs());
      const double    s = height / h * static_cast<double>(ny);
      const Index     j = std::min(static_cast<Index>(s), ny - 1);
      const double    a = s - static_cast<double>(j);
      f(dof(0, j))      = (1 - a) * force;
      f(dof(0, j + 1))  = a * force;
      return f;
    }

    double
    x(const Index i) const
    {
      return b * static_cast<double>(i) / static_cast<double>(nx);
    }

  private:
    Index
    n_dofs() const
    {
      return 2 * (nx + 1) * (ny + 1);
    }
    Index
    dof(const Index i, const Index j) const
    {
      return 2 * (j * (nx + 1) + i);
    }
    std::vector<Index>
    cell_dofs(const Index i, const Index j) const
    {
      std::vector<Index> result;
      for (const Index node :
           {dof(i, j), dof(i + 1, j), dof(i + 1, j + 1), dof(i, j + 1)})
        {
          result.push_back(node);
          result.push_back(node + 1);
        }
      return result;
    }

    Eigen::Matrix<double, 8, 8>
    cell_stiffness(const double young, const double poisson) const
    {
      const double hx = b / static_cast<double>(nx),
                   hy = h / static_cast<double>(ny);
      Eigen::Matrix3d C;
      C << 1 - poisson, poisson, 0, poisson, 1 - poisson, 0, 0, 0, .5 - poisson;
      C *= young / ((1 + poisson) * (1 - 2 * poisson));
      Eigen::Matrix<double, 8, 8> K    = Eigen::Matrix<double, 8, 8>::Zero();
      const double                q    = 1 / std::sqrt(3.);
      const double                sx[] = {-1, 1, 1, -1}, sy[] = {-1, -1, 1, 1};
      for (const double xi : {-q, q})
        for (const double eta : {-q, q})
          {
            Eigen::Matrix<double, 3, 8> B;
            for (Index a = 0; a < 4; ++a)
              {
                const double dx = sx[a] * (1 + sy[a] * eta) / (2 * hx);
                const double dy = sy[a] * (1 + sx[a] * xi) / (2 * hy);
                B.col(2 * a) << dx, 0, dy;
                B.col(2 * a + 1) << 0, dy, dx;
              }
            K += B.transpose() * C * B * (hx * hy / 4);
          }
      return K;
    }

    double                      b, h;
    Index                       nx, ny;
    Eigen::MatrixXd             stiffness;
    Eigen::LLT<Eigen::MatrixXd> inner;
  };
} // namespace conetact

#endif
