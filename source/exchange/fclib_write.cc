// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/exchange/fclib_file.h"
#include "conetact/exchange/fclib_global.h"
#include "conetact/exchange/hdf5_file.h"
#include "conetact/exchange/order.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

// FCLib's header leaves this to its users.
extern "C"
{
#include <fclib.h>
}

namespace conetact::exchange
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  namespace fs = std::filesystem;

  namespace
  {
    [[noreturn]] void
    fail(const fs::path &file, const std::string &why)
    {
      throw WriteError("Cannot write " + file.string() + ": " + why + ".");
    }



    /* FCLib ends the process when HDF5 fails to write. What it could stumble
       over is tried beforehand: the folder, the rights, the space. */
    void
    check_target(const fs::path      &file,
                 const fs::path      &temporary,
                 const std::uintmax_t bytes)
    {
      std::error_code error;
      if (fs::exists(file, error) && !fs::is_regular_file(file, error))
        fail(file, "there is something of this name that is not a file");
      if (!std::ofstream(temporary))
        fail(file, "the folder does not exist or is not writable");
      const fs::space_info space =
        fs::space(fs::absolute(temporary).parent_path(), error);
      if (!error && space.available < bytes)
        fail(file, "there is not enough space on the disk");
      fs::remove(temporary, error);
    }



    int
    space_dimension(const solvers::ContactSystem &system)
    {
      const Index tangents = system.n_nodes() > 0 ? system.n_tangents(0) : 0;
      for (Index i = 0; i < system.n_nodes(); ++i)
        if (system.n_tangents(i) != tangents || tangents == 0)
          throw InputError(
            "FCLib needs contacts of one kind, all with one tangent (2D) or "
            "all with two (3D); contact " +
            std::to_string(i) + " has " + std::to_string(system.n_tangents(i)) +
            ".");
      if (tangents == 0)
        throw InputError("There are no contacts to write to an FCLib file.");
      return static_cast<int>(tangents) + 1;
    }



    /** Arrays of a solution or guess in the order of the file. */
    struct Arrays
    {
      Arrays(const FclibOrder &order, const solvers::ContactState &state)
        : u(order.to_file(state.v))
        , r(order.to_file(state.r))
      {}
      fclib_solution
      view()
      {
        return {v.size() > 0 ? v.data() : nullptr,
                u.data(),
                r.data(),
                l.size() > 0 ? l.data() : nullptr};
      }
      VectorXd u, r;
      VectorXd v, l; ///< of the bodies, in files of global problems
    };



    void
    write_problem(const solvers::ContactProblem &problem,
                  const int                      dim,
                  const std::string             &title,
                  const fs::path                &file)
    {
      const FclibOrder order(*problem.system);
      MatrixXd         W  = order.to_file(problem.system->matrix);
      VectorXd         q  = order.to_file(problem.load);
      VectorXd         mu = problem.system->mu;
      const int        n  = static_cast<int>(W.rows());

      // all entries by columns
      std::vector<int> pointer(static_cast<std::size_t>(n) + 1);
      std::vector<int> index(static_cast<std::size_t>(n) *
                             static_cast<std::size_t>(n));
      for (int j = 0; j <= n; ++j)
        pointer[static_cast<std::size_t>(j)] = n * j;
      for (std::size_t k = 0; k < index.size(); ++k)
        index[k] = static_cast<int>(k) % n;
      fclib_matrix matrix = {
        n * n, n, n, pointer.data(), index.data(), W.data(), -1, nullptr};

      std::string text = title, description = "written by Conetact",
                  math  = "u = W r + q, quasi-static: u = (gap, slip)";
      fclib_info  info  = {text.data(), description.data(), math.data()};
      fclib_local local = {
        &matrix, nullptr, nullptr, mu.data(), q.data(), nullptr, dim, &info};
      if (fclib_write_local(&local, file.c_str()) != 1)
        fail(file, "FCLib refused the problem");
    }



    void
    write_solution(const FclibOrder            &order,
                   const solvers::ContactState &solution,
                   const fs::path              &file)
    {
      Arrays arrays(order, solution);
      if (const Hdf5File old(file); old.has("/fclib_global"))
        {
          const FclibGlobal::Bodies bodies = FclibGlobal(old).bodies(arrays.r);
          arrays.v                         = bodies.v;
          arrays.l                         = bodies.lambda;
        }
      fclib_solution view = arrays.view();
      if (fclib_write_solution(&view, file.c_str()) != 1)
        fail(file, "FCLib refused the solution");
    }



    /* Removes what FCLib would refuse to overwrite. */
    void
    drop_solution(const fs::path &file)
    {
      const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      if (id < 0)
        fail(file, "HDF5 cannot open it for writing");
      H5Ldelete(id, "/solution", H5P_DEFAULT);
      if (H5Fclose(id) < 0)
        fail(file, "HDF5 cannot write to it");
    }
  } // namespace



  /**
   * Motions that foundations resist follow from the reactions,
   * a = C^{-1} (G^T r + b), and add to the compliance.
   */
  solvers::ContactProblem
  without_motions(const solvers::ContactProblem &problem)
  {
    const solvers::ContactSystem &given = *problem.system;
    const Eigen::Index n = given.n_contact_unknowns(), k = given.n_motions;
    if (k == 0)
      return problem;
    const Eigen::LLT<MatrixXd> C(given.matrix.bottomRightCorner(k, k));
    if (given.null_space.cols() > 0 || C.info() != Eigen::Success)
      throw InputError(
        "A body of the scene is held by contact alone: its compliance is not "
        "finite, and FCLib knows no other form.");
    const MatrixXd G      = given.matrix.topRightCorner(n, k);
    auto           system = std::make_shared<solvers::ContactSystem>(given);
    system->n_motions     = 0;
    system->first.resize(system->first.size() - static_cast<std::size_t>(k));
    const MatrixXd W =
      given.matrix.topLeftCorner(n, n) + G * C.solve(MatrixXd(G.transpose()));
    system->matrix                 = .5 * (W + W.transpose());
    solvers::ContactProblem result = problem;
    result.system                  = system;
    result.load = problem.load.head(n) - G * C.solve(problem.load.tail(k));
    return result;
  }



  solvers::ContactProblem
  compliance_form(const solvers::ContactProblem &problem)
  {
    if (problem.system->form == solvers::Form::compliance)
      return without_motions(problem);
    const MatrixXd &K     = problem.system->matrix;
    const VectorXd  scale = K.diagonal().unaryExpr(
      [](const double d) { return d > 0 ? 1 / std::sqrt(d) : 1.; });
    const Eigen::LLT<MatrixXd> llt(scale.asDiagonal() * K * scale.asDiagonal());
    if (problem.system->null_space.cols() > 0 || llt.info() != Eigen::Success ||
        !(llt.rcond() > 1e-13))
      throw InputError(
        "The stiffness of the contact nodes is singular (a body that contact "
        "alone holds): it has no inverse, and FCLib knows no other form.");
    auto system = std::make_shared<solvers::ContactSystem>(*problem.system);
    const MatrixXd W =
      scale.asDiagonal() * llt.solve(MatrixXd(scale.asDiagonal()));
    system->form       = solvers::Form::compliance;
    system->matrix     = .5 * (W + W.transpose());
    system->null_space = MatrixXd();

    solvers::ContactProblem result = problem;
    result.load =
      scale.asDiagonal() * llt.solve(scale.asDiagonal() * problem.load);
    if (problem.offset.size() > 0)
      result.load += problem.offset;
    result.offset = VectorXd();
    result.system = system;
    return result;
  }



  void
  write_fclib(const solvers::ContactProblem &given,
              const std::string             &file,
              const solvers::ContactState   *solution,
              const solvers::ContactState   *guess,
              const std::string             &title)
  {
    const int                     dim     = space_dimension(*given.system);
    const solvers::ContactProblem problem = compliance_form(given);
    const FclibOrder              order(*problem.system);
    const auto      n = static_cast<std::uintmax_t>(problem.load.size());
    const QuietHdf5 quiet;
    write_atomically(file, [&](const fs::path &temporary) {
      check_target(file, temporary, 13 * n * n + 1000000);
      write_problem(problem, dim, title, temporary);
      if (solution)
        write_solution(order, *solution, temporary);
      if (guess)
        {
          Arrays         arrays(order, *guess);
          fclib_solution view = arrays.view();
          if (fclib_write_guesses(1, &view, temporary.c_str()) != 1)
            fail(file, "FCLib refused the guess");
        }
    });
  }



  void
  store_fclib_solution(const solvers::ContactProblem &problem,
                       const solvers::ContactState   &solution,
                       const std::string             &from,
                       const std::string             &to)
  {
    const QuietHdf5 quiet;
    write_atomically(to, [&](const fs::path &temporary) {
      std::error_code error;
      const auto      size = fs::file_size(from, error);
      check_target(to, temporary, (error ? 0 : size) + 1000000);
      if (!fs::copy_file(from, temporary, error) || error)
        fail(to, error.message());
      fs::permissions(temporary,
                      fs::perms::owner_write,
                      fs::perm_options::add,
                      error);
      drop_solution(temporary);
      write_solution(FclibOrder(*problem.system), solution, temporary);
    });
  }
} // namespace conetact::exchange
