// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_dual_functions_h
#define conetact_pairing_dual_functions_h

#include <Eigen/Core>

#include <vector>

namespace conetact::pairing
{
  /**
   * Dual functions of a face on the part of it that is covered,
   * @f$\psi_j = \sum_k A_{jk} N_k@f$ with @f$\int \psi_j N_k = \delta_{jk}
   * \int N_j@f$: from `mass`, @f$\int N_j N_k@f$, and `areas`, @f$\int
   * N_j@f$, follows @f$A = \mathrm{diag}(areas)\,mass^{-1}@f$; they sum to 1.
   * On a part so small or thin that they would reach far beyond it, the
   * functions N_j themselves: A = 1. (Wohlmuth, SIAM J. Numer. Anal. 38 (2000)
   * 989-1012; covered parts: Cichosz, Bischoff, CMAME 200 (2011) 1317-1332.)
   *
   * Only the nodes that are `kept` get a function. The shape functions of the
   * others are added to theirs, in shares of their integrals: so the kept ones
   * still sum to 1, and each is biorthogonal to the shape functions of the
   * other kept nodes. Rows of A that belong to no kept node are 0.
   */
  Eigen::MatrixXd
  dual_functions(const Eigen::MatrixXd           &mass,
                 const Eigen::VectorXd           &areas,
                 const std::vector<Eigen::Index> &kept);

  /**
   * Functions @f$\varphi_j@f$ of the corners of a face of second degree, rows
   * in terms of its shape functions @f$N_k@f$: dual to the linear functions
   * @f$\lambda_k@f$ of the corners, @f$\int \varphi_j \lambda_k = \delta_{jk}
   * \int \lambda_j@f$, while nodes in the middle have what linear pressures
   * give them, @f$\int \varphi_j N_m = \int \lambda_j N_m@f$. So they sum to
   * 1, and a pressure that is linear reaches what the middles have of their
   * own exactly, which functions of the corners alone miss by their first
   * order. `mass`: of the shape functions,
   * `linear`: rows are the linear functions at the nodes.
   */
  Eigen::MatrixXd
  corner_functions(const Eigen::MatrixXd &mass, const Eigen::MatrixXd &linear);
  /** Of them @f$\int \varphi_j N_k@f$, which needs no more of the mass than
   * `of_linear`, @f$\int \lambda_j N_k@f$. */
  Eigen::MatrixXd
  corner_integrals(const Eigen::MatrixXd &of_linear,
                   const Eigen::MatrixXd &linear);
} // namespace conetact::pairing

#endif
