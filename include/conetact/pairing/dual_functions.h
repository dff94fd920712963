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
} // namespace conetact::pairing

#endif
