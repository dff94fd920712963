// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_condensed_elimination_order_h
#define conetact_condensed_elimination_order_h

#include <Eigen/SparseCore>

#include <vector>

namespace conetact::condensed
{
  /**
   * A fill-reducing order of the first `n_eliminated` unknowns of the
   * symmetric matrix of which `upper` is the upper triangle: nested dissection
   * (METIS) of the graph of the nodes, the unknowns of a node one after the
   * other. Ordering nodes instead of unknowns is faster and fills less.
   * Returns the place of each unknown of the matrix in the elimination,
   * counted from 0; those not eliminated keep their last places.
   */
  std::vector<int>
  elimination_order(const Eigen::SparseMatrix<double> &upper,
                    const Eigen::Index                 n_eliminated,
                    const std::vector<unsigned int>   &node_of);
} // namespace conetact::condensed

#endif
