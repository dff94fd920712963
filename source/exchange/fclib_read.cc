// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/exchange/fclib_arrays.h"
#include "conetact/exchange/fclib_file.h"
#include "conetact/exchange/fclib_global.h"
#include "conetact/exchange/order.h"

#include <cmath>
#include <string>

namespace conetact::exchange
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /**
     * Gyroscopic terms make W unsymmetric by 1e-5 to 1e-2 of its largest
     * entry; more than this is no compliance.
     */
    constexpr double max_asymmetry = .5;

    /** W, q and mu in the order of the file. */
    struct Local
    {
      MatrixXd W;
      VectorXd q, mu;
      int      dim = 0;
    };



    void
    check_matrix(const Hdf5File &file, const MatrixXd &W)
    {
      const double size = W.cwiseAbs().maxCoeff();
      if ((W - W.transpose()).cwiseAbs().maxCoeff() > max_asymmetry * size)
        file.fail("the matrix W is far from symmetric: its entries and those "
                  "of its transpose differ by more than half of the largest "
                  "one");
      Index where = 0;
      if (W.diagonal().minCoeff(&where) < -1e-12 * size)
        file.fail("the matrix W is not positive semidefinite: entry " +
                  std::to_string(where) + " of its diagonal is negative");
    }



    int
    read_dimension(const Hdf5File &file, const std::string &root)
    {
      const int dim = file.integer(root + "spacedim");
      if (dim != 2 && dim != 3)
        file.fail("the space dimension is " + std::to_string(dim) +
                  " instead of 2 or 3");
      return dim;
    }



    Local
    read_local(const Hdf5File &file)
    {
      const std::string root = "/fclib_local/";
      if (file.has(root + "V") || file.has(root + "R"))
        file.fail("the problem has equality constraints (V, R), which are not "
                  "treated");
      Local local;
      local.dim    = read_dimension(file, root);
      const auto W = read_matrix(file, root + "W/", "W");
      if (W.rows() != W.cols())
        file.fail("the matrix W is not square");
      if (W.rows() > max_contact_unknowns)
        file.fail("the matrix W has " + std::to_string(W.rows()) +
                  " rows; 1 to " + std::to_string(max_contact_unknowns) +
                  " can be treated");
      local.W = W;
      local.q = read_vector(file, root + "vectors/q", W.rows());
      return local;
    }



    Local
    read_global(const Hdf5File &file)
    {
      Local local;
      local.dim = read_dimension(file, "/fclib_global/");
      const FclibGlobal global(file);
      local.W = global.compliance();
      local.q = global.free_velocity();
      return local;
    }



    /** The part that both kinds have in common. */
    void
    read_friction(const Hdf5File &file, const std::string &root, Local &local)
    {
      const Index n = local.W.rows();
      if (n % local.dim != 0)
        file.fail("the number of contact unknowns, " + std::to_string(n) +
                  ", is not a multiple of the space dimension");
      local.mu    = read_vector(file, root + "vectors/mu", n / local.dim);
      Index where = 0;
      if (local.mu.minCoeff(&where) < 0)
        file.fail("the friction coefficient of contact " +
                  std::to_string(where) + " is negative");
    }



    std::optional<solvers::ContactState>
    read_state(const std::string             &path,
               const std::string             &group,
               const solvers::ContactProblem &problem)
    {
      const Hdf5File file(path);
      if (!file.has(group + "/r"))
        return {};
      const FclibOrder      order(*problem.system);
      const Index           n = problem.system->n_unknowns();
      solvers::ContactState state;
      state.r = order.from_file(read_vector(file, group + "/r", n));
      state.v = file.has(group + "/u") ?
                  order.from_file(read_vector(file, group + "/u", n)) :
                  VectorXd(problem.system->matrix * state.r + problem.load);
      return state;
    }
  } // namespace



  solvers::ContactProblem
  read_fclib(const std::string &path)
  {
    const Hdf5File file(path);
    const bool     is_global = file.has("/fclib_global");
    if (!is_global && !file.has("/fclib_local"))
      file.fail("it holds no problem of FCLib");
    Local local = is_global ? read_global(file) : read_local(file);
    check_matrix(file, local.W);
    read_friction(file, is_global ? "/fclib_global/" : "/fclib_local/", local);

    auto system  = std::make_shared<solvers::ContactSystem>();
    system->form = solvers::Form::compliance;
    for (Index i = local.dim; i <= local.W.rows(); i += local.dim)
      system->first.push_back(i);
    system->mu = local.mu;
    const FclibOrder order(*system);
    system->matrix = order.from_file(local.W);
    solvers::ContactProblem problem;
    problem.load   = order.from_file(local.q);
    problem.gap    = VectorXd::Zero(system->n_nodes());
    problem.system = system;
    return problem;
  }



  std::optional<solvers::ContactState>
  read_fclib_solution(const std::string             &file,
                      const solvers::ContactProblem &problem)
  {
    return read_state(file, "/solution", problem);
  }



  std::optional<solvers::ContactState>
  read_fclib_guess(const std::string             &file,
                   const solvers::ContactProblem &problem)
  {
    return read_state(file, "/guesses/1", problem);
  }
} // namespace conetact::exchange
