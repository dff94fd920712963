// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/errors.h"
#include "conetact/fclib/fclib_file.h"
#include "conetact/fclib/hdf5_file.h"
#include "conetact/fclib/order.h"

#include <cmath>
#include <string>
#include <vector>

namespace conetact
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    const std::string root = "/fclib_local/";

    /** Larger problems than this do not fit as dense matrices. */
    constexpr int max_size = 20000;



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
                 const int          n,
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
        file.integers(name + "p", static_cast<std::size_t>(n) + 1);
      std::vector<int> along  = expand(file, name, pointer, nzmax);
      std::vector<int> across = file.integers(name + "i", entries);
      across.resize(along.size());
      const bool columns = nz == -1;
      result.row         = columns ? across : along;
      result.column      = columns ? along : across;
      return result;
    }



    MatrixXd
    read_matrix(const Hdf5File &file, const std::string &name)
    {
      const int n = file.integer(name + "m"), nz = file.integer(name + "nz");
      const int nzmax = file.integer(name + "nzmax");
      if (n != file.integer(name + "n"))
        file.fail("the matrix W is not square");
      if (n <= 0 || n > max_size)
        file.fail("the matrix W has " + std::to_string(n) + " rows; 1 to " +
                  std::to_string(max_size) + " can be treated");
      if (nz < -2 || nzmax < nz || nzmax < 0)
        file.fail(
          "the storage of the matrix W is unknown (nz = " + std::to_string(nz) +
          ", nzmax = " + std::to_string(nzmax) + ")");
      // the values first: they confirm nzmax
      const VectorXd x  = read_vector(file, name + "x", nzmax);
      const Triplets at = read_pattern(file, name, n, nz, nzmax);
      MatrixXd       W  = MatrixXd::Zero(n, n);
      for (std::size_t k = 0; k < at.row.size(); ++k)
        {
          const int i = at.row[k], j = at.column[k];
          if (i < 0 || i >= n || j < 0 || j >= n)
            file.fail("an entry of the matrix W stands outside of it (row " +
                      std::to_string(i) + ", column " + std::to_string(j) +
                      ")");
          W(i, j) += x[static_cast<Index>(k)];
        }
      return W;
    }



    void
    check_matrix(const Hdf5File &file, const MatrixXd &W)
    {
      const double size = W.cwiseAbs().maxCoeff();
      if ((W - W.transpose()).cwiseAbs().maxCoeff() > 1e-8 * size)
        file.fail("the matrix W is not symmetric");
      Index where = 0;
      if (W.diagonal().minCoeff(&where) < -1e-12 * size)
        file.fail("the matrix W is not positive semidefinite: entry " +
                  std::to_string(where) + " of its diagonal is negative");
    }



    std::optional<ContactState>
    read_state(const std::string    &path,
               const std::string    &group,
               const ContactProblem &problem)
    {
      const Hdf5File file(path);
      if (!file.has(group + "/r"))
        return {};
      const FclibOrder order(*problem.system);
      const Index      n = problem.system->n_unknowns();
      ContactState     state;
      state.r = order.from_file(read_vector(file, group + "/r", n));
      state.v = file.has(group + "/u") ?
                  order.from_file(read_vector(file, group + "/u", n)) :
                  VectorXd(problem.system->matrix * state.r + problem.load);
      return state;
    }
  } // namespace



  ContactProblem
  read_fclib(const std::string &path)
  {
    const Hdf5File file(path);
    if (!file.has("/fclib_local"))
      file.fail(file.has("/fclib_global") ?
                  "it holds a global problem; only local ones are treated" :
                  "it holds no problem of FCLib");
    if (file.has(root + "V") || file.has(root + "R"))
      file.fail("the problem has equality constraints (V, R), which are not "
                "treated");
    const int dim = file.integer(root + "spacedim");
    if (dim != 2 && dim != 3)
      file.fail("the space dimension is " + std::to_string(dim) +
                " instead of 2 or 3");

    MatrixXd    W = read_matrix(file, root + "W/");
    const Index n = W.rows();
    check_matrix(file, W);
    if (n % dim != 0)
      file.fail("the size of W, " + std::to_string(n) +
                ", is not a multiple of the space dimension");

    auto system  = std::make_shared<ContactSystem>();
    system->form = Form::compliance;
    for (Index i = dim; i <= n; i += dim)
      system->first.push_back(i);
    system->mu  = read_vector(file, root + "vectors/mu", n / dim);
    Index where = 0;
    if (system->mu.minCoeff(&where) < 0)
      file.fail("the friction coefficient of contact " + std::to_string(where) +
                " is negative");

    const FclibOrder order(*system);
    system->matrix = order.from_file(MatrixXd(.5 * (W + W.transpose())));
    ContactProblem problem;
    problem.load   = order.from_file(read_vector(file, root + "vectors/q", n));
    problem.gap    = VectorXd::Zero(n / dim);
    problem.system = system;
    return problem;
  }



  std::optional<ContactState>
  read_fclib_solution(const std::string &file, const ContactProblem &problem)
  {
    return read_state(file, "/solution", problem);
  }



  std::optional<ContactState>
  read_fclib_guess(const std::string &file, const ContactProblem &problem)
  {
    return read_state(file, "/guesses/1", problem);
  }
} // namespace conetact
