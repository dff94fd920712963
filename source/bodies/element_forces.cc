// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/element_forces.h"

#include <deal.II/base/exceptions.h>

namespace conetact::bodies
{
  void
  multiply(const std::vector<unsigned int> &dofs,
           const double                    *matrix,
           const Eigen::VectorXd           &u,
           Eigen::VectorXd                 &local,
           Eigen::VectorXd                 &f)
  {
    AssertDimension(u.size(), f.size());
    const std::size_t n = dofs.size();
    local.setZero(static_cast<Eigen::Index>(n));
    double *const sum = local.data();
    for (std::size_t j = 0; j < n; ++j, matrix += n)
      {
        const double u_j = u[dofs[j]];
        for (std::size_t i = 0; i < n; ++i)
          sum[i] += matrix[i] * u_j;
      }
    for (std::size_t i = 0; i < n; ++i)
      f[dofs[i]] += sum[i];
  }



  void
  multiply_strained(const std::vector<unsigned int> &dofs,
                    const double                    *matrix,
                    const unsigned int               dim,
                    const Eigen::VectorXd           &u,
                    Eigen::VectorXd                 &local,
                    Eigen::VectorXd                 &f)
  {
    AssertDimension(u.size(), f.size());
    AssertDimension(dofs.size() % dim, 0);
    const auto       n = static_cast<Eigen::Index>(dofs.size());
    Eigen::VectorXd  strained(n);
    Eigen::MatrixX3d resistance = Eigen::MatrixX3d::Zero(n, 3);
    Eigen::Vector3d  base       = Eigen::Vector3d::Zero();
    const Eigen::Map<const Eigen::MatrixXd> k(matrix, n, n);
    for (Eigen::Index j = n; j-- > 0;)
      base[dofs[static_cast<std::size_t>(j)] % dim] =
        u[dofs[static_cast<std::size_t>(j)]];
    for (Eigen::Index j = 0; j < n; ++j)
      {
        const unsigned int dof = dofs[static_cast<std::size_t>(j)];
        strained[j]            = u[dof] - base[dof % dim];
        resistance.col(dof % dim) += k.col(j);
      }
    local.noalias() = k * strained;
    if (resistance.cwiseAbs().maxCoeff() > 1e-10 * k.cwiseAbs().maxCoeff())
      local += resistance * base;
    for (Eigen::Index i = 0; i < n; ++i)
      f[dofs[static_cast<std::size_t>(i)]] += local[i];
  }
} // namespace conetact::bodies
