// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/exchange/fclib_arrays.h"

#include <cmath>
#include <vector>

namespace conetact::exchange
{
  using Eigen::Index;
  using Eigen::VectorXd;

  namespace
  {
    /** Rows or columns beyond this are taken for damage. */
    constexpr int max_rows = 10000000;



    /** Row and column of every stored entry, whatever the storage. */
    struct Triplets
    {
      std::vector<int> row, column;
    };



    /* Compressed storage: pointers along one direction, indices along the
       other one. */
    std::vector<int>
    expand(const Hdf5File         &file,
           const std::string      &name,
           const std::vector<int> &pointer,
           const int               n_entries)
    {
      std::vector<int> result(static_cast<std::size_t>(n_entries));
      if (pointer.front() != 0 || pointer.back() > n_entries)
        file.fail("the pointers '" + name + "p' of the matrix do not fit it");
      for (std::size_t j = 0; j + 1 < pointer.size(); ++j)
        {
          if (pointer[j + 1] < pointer[j])
            file.fail("the pointers '" + name + "p' of the matrix decrease");
          for (int k = pointer[j]; k < pointer[j + 1]; ++k)
            result[static_cast<std::size_t>(k)] = static_cast<int>(j);
        }
      result.resize(static_cast<std::size_t>(pointer.back()));
      return result;
    }



    Triplets
    read_pattern(const Hdf5File    &file,
                 const std::string &name,
                 const int          n_pointers,
                 const int          nz,
                 const int          nzmax)
    {
      Triplets   result;
      const auto entries = static_cast<std::size_t>(nz >= 0 ? nz : nzmax);
      if (nz >= 0)
        {
          result.row    = file.integers(name + "p", entries);
          result.column = file.integers(name + "i", entries);
          return result;
        }
      const auto pointer =
        file.integers(name + "p", static_cast<std::size_t>(n_pointers) + 1);
      std::vector<int> along  = expand(file, name, pointer, nzmax);
      std::vector<int> across = file.integers(name + "i", entries);
      across.resize(along.size());
      const bool columns = nz == -1;
      result.row         = columns ? across : along;
      result.column      = columns ? along : across;
      return result;
    }



    void
    check_sizes(const Hdf5File    &file,
                const std::string &name,
                const int          m,
                const int          n,
                const int          nz,
                const int          nzmax)
    {
      if (m <= 0 || n <= 0 || m > max_rows || n > max_rows)
        file.fail("the matrix " + name + " has " + std::to_string(m) +
                  " rows and " + std::to_string(n) + " columns; 1 to " +
                  std::to_string(max_rows) + " can be treated");
      if (nz < -2 || nzmax < nz || nzmax < 0)
        file.fail("the storage of the matrix " + name +
                  " is unknown (nz = " + std::to_string(nz) +
                  ", nzmax = " + std::to_string(nzmax) + ")");
    }
  } // namespace



  VectorXd
  read_vector(const Hdf5File &file, const std::string &name, const Index size)
  {
    const std::vector<double> values =
      file.numbers(name, static_cast<std::size_t>(size));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        file.fail("entry " + std::to_string(i) + " of '" + name +
                  "' is not a finite number");
    return Eigen::Map<const VectorXd>(values.data(), size);
  }



  Eigen::SparseMatrix<double>
  read_matrix(const Hdf5File    &file,
              const std::string &folder,
              const std::string &name)
  {
    const int m = file.integer(folder + "m"), n = file.integer(folder + "n");
    const int nz    = file.integer(folder + "nz");
    const int nzmax = file.integer(folder + "nzmax");
    check_sizes(file, name, m, n, nz, nzmax);
    // the values first: they confirm nzmax
    const VectorXd x  = read_vector(file, folder + "x", nzmax);
    const Triplets at = read_pattern(file, folder, nz == -2 ? m : n, nz, nzmax);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < at.row.size(); ++k)
      {
        const int i = at.row[k], j = at.column[k];
        if (i < 0 || i >= m || j < 0 || j >= n)
          file.fail("an entry of the matrix " + name +
                    " stands outside of it (row " + std::to_string(i) +
                    ", column " + std::to_string(j) + ")");
        entries.emplace_back(i, j, x[static_cast<Index>(k)]);
      }
    Eigen::SparseMatrix<double> result(m, n);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }
} // namespace conetact::exchange
