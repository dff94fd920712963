// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/exchange/fclib_arrays.h"

#include <algorithm>
#include <cmath>
#include <utility>
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



    /** What the group of a matrix says of it. */
    struct Sizes
    {
      int m, n, nz, nzmax;

      bool
      are_triplets() const
      {
        return nz >= 0;
      }
    };



    Sizes
    read_sizes(const Hdf5File &file, const std::string &folder)
    {
      return {file.integer(folder + "m"),
              file.integer(folder + "n"),
              file.integer(folder + "nz"),
              file.integer(folder + "nzmax")};
    }



    /** Triplets that there is no room for may be stored or not. */
    std::size_t
    stored(const Hdf5File &file, const std::string &name, const Sizes &sizes)
    {
      const auto most = static_cast<std::size_t>(sizes.nzmax);
      return sizes.are_triplets() && file.size(name) != most ?
               static_cast<std::size_t>(sizes.nz) :
               most;
    }



    std::vector<int>
    read_indices(const Hdf5File    &file,
                 const std::string &name,
                 const Sizes       &sizes)
    {
      std::vector<int> result = file.integers(name, stored(file, name, sizes));
      if (sizes.are_triplets())
        result.resize(static_cast<std::size_t>(sizes.nz));
      return result;
    }



    Triplets
    read_pattern(const Hdf5File    &file,
                 const std::string &folder,
                 const Sizes       &sizes,
                 const bool         columns_first)
    {
      Triplets result;
      if (sizes.are_triplets())
        {
          result.row    = read_indices(file, folder + "p", sizes);
          result.column = read_indices(file, folder + "i", sizes);
          if (columns_first)
            std::swap(result.row, result.column);
          return result;
        }
      const bool columns    = sizes.nz == -1;
      const int  n_pointers = (columns ? sizes.n : sizes.m) + 1;
      const auto pointer =
        file.integers(folder + "p", static_cast<std::size_t>(n_pointers));
      std::vector<int> along  = expand(file, folder, pointer, sizes.nzmax);
      std::vector<int> across = read_indices(file, folder + "i", sizes);
      across.resize(along.size());
      result.row    = columns ? across : along;
      result.column = columns ? along : across;
      return result;
    }



    void
    check_sizes(const Hdf5File    &file,
                const std::string &name,
                const Sizes       &sizes)
    {
      const auto [m, n, nz, nzmax] = sizes;
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



  bool
  has_columns_first(const Hdf5File &file, const std::string &folder)
  {
    const Sizes sizes = read_sizes(file, folder);
    if (!sizes.are_triplets() || sizes.nz == 0 || sizes.nzmax < sizes.nz)
      return false;
    const auto largest = [&](const std::string &name) {
      const std::vector<int> all = read_indices(file, folder + name, sizes);
      return *std::max_element(all.begin(), all.end());
    };
    const int p = largest("p"), i = largest("i");
    return (p >= sizes.m || i >= sizes.n) && p < sizes.n && i < sizes.m;
  }



  Eigen::SparseMatrix<double>
  read_matrix(const Hdf5File    &file,
              const std::string &folder,
              const std::string &name,
              const bool         columns_first)
  {
    const Sizes sizes = read_sizes(file, folder);
    check_sizes(file, name, sizes);
    const int m = sizes.m, n = sizes.n;
    // the values first: they confirm how many there are
    const VectorXd x =
      read_vector(file,
                  folder + "x",
                  static_cast<Index>(stored(file, folder + "x", sizes)));
    const Triplets at = read_pattern(file, folder, sizes, columns_first);
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
