// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_exchange_fclib_arrays_h
#define conetact_exchange_fclib_arrays_h

#include "conetact/exchange/hdf5_file.h"

#include <Eigen/Sparse>

#include <string>

namespace conetact::exchange
{
  /** Larger contact problems than this do not fit as dense matrices. */
  constexpr int max_contact_unknowns = 20000;

  /** A dataset of `size` finite numbers. */
  Eigen::VectorXd
  read_vector(const Hdf5File    &file,
              const std::string &name,
              const Eigen::Index size);

  /**
   * A matrix in any storage of FCLib (triplets, compressed columns or rows) in
   * the group `folder`; `name` is what sentences call it. Of triplets `p` has
   * the rows, as FCLib says, or the columns, as CSparse does. All sizes and
   * indices are checked; throws InputError.
   */
  Eigen::SparseMatrix<double>
  read_matrix(const Hdf5File    &file,
              const std::string &folder,
              const std::string &name,
              const bool         columns_first = false);

  /** Whether triplets fit the matrix only if `p` has the columns: programs that
   * hand over matrices of CSparse write them like that. */
  bool
  has_columns_first(const Hdf5File &file, const std::string &folder);
} // namespace conetact::exchange

#endif
