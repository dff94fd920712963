// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Files of FCLib: against FCLib's own functions, there and back, and damaged
// in every way the reader knows a sentence for.

#include "conetact/base/errors.h"
#include "conetact/exchange/fclib_file.h"
#include "conetact/solvers/solver_table.h"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "rigid_bodies.h"

// FCLib's header leaves this to its users.
extern "C"
{
#include <fclib.h>
}

using namespace conetact;
using namespace conetact::exchange;
using namespace conetact::solvers;
using Eigen::MatrixXd;
using Eigen::VectorXd;
namespace fs = std::filesystem;

namespace
{
  class Fclib : public ::testing::Test
  {
  protected:
    void
    SetUp() override
    {
      std::string pattern =
        (fs::temp_directory_path() / "conetact-fclib-XXXXXX").string();
      folder = mkdtemp(pattern.data());
      file   = (folder / "problem.hdf5").string();
    }
    void
    TearDown() override
    {
      fs::remove_all(folder);
    }
    /** Exit code of the tool; what it says goes to `said`. */
    int
    run(const std::string &arguments)
    {
      const fs::path    output  = folder / "said";
      const std::string command = std::string(CONETACT_FCLIB) + " " +
                                  arguments + " > " + output.string() + " 2>&1";
      const int     status = std::system(command.c_str());
      std::ifstream stream(output);
      said.assign(std::istreambuf_iterator<char>(stream), {});
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    /** The tool refuses the file in one sentence with this word. */
    void
    expect_refused(const std::string &word)
    {
      EXPECT_EQ(run("solve " + file), 1) << said;
      EXPECT_NE(said.find(word), std::string::npos) << said;
      EXPECT_EQ(said.find("HDF5-DIAG"), std::string::npos) << said;
    }

    fs::path    folder;
    std::string file, said;
  };

  ContactProblem
  make_problem(const Form form, const int dim, const int n_c)
  {
    std::srand(5);
    const Eigen::Index n      = dim * n_c;
    const MatrixXd     A      = MatrixXd::Random(n, n + 9);
    auto               system = std::make_shared<ContactSystem>();
    system->form              = form;
    // Half of the product twice: the other half may differ by rounding, with
    // some processors.
    const MatrixXd product = A * A.transpose();
    system->matrix         = product.selfadjointView<Eigen::Lower>();
    for (Eigen::Index i = dim; i <= n; i += dim)
      system->first.push_back(i);
    system->mu = VectorXd::LinSpaced(n_c, .1, .6);
    ContactProblem problem;
    problem.system = system;
    problem.load   = VectorXd::Random(n);
    problem.gap    = VectorXd::Zero(n_c);
    return problem;
  }

  ContactState
  solve(const ContactProblem &problem)
  {
    SolverOptions options;
    options.method    = "gauss-seidel";
    options.tolerance = 1e-12;
    ContactState state;
    state.v = state.r = VectorXd::Zero(problem.load.size());
    EXPECT_TRUE(make_solver(options)->solve(problem, state).converged);
    return state;
  }

  /** Replaces a dataset of the file by other numbers. */
  template <typename T>
  void
  replace(const std::string    &file,
          const std::string    &name,
          const std::vector<T> &values)
  {
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t type =
      std::is_same_v<T, int> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
    const hsize_t size  = values.size();
    const hid_t   space = H5Screate_simple(1, &size, nullptr);
    ASSERT_GE(H5Ldelete(id, name.c_str(), H5P_DEFAULT), 0) << name;
    const hid_t set = H5Dcreate2(
      id, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    H5Sclose(space);
    H5Fclose(id);
  }
} // namespace



TEST_F(Fclib, ThereAndBack)
{
  for (const int dim : {2, 3})
    {
      const ContactProblem problem = make_problem(Form::compliance, dim, 7);
      const ContactState   state   = solve(problem);
      const ContactState   guess   = {2 * state.v, 3 * state.r, {}};
      write_fclib(problem, file, &state, &guess);
      const ContactProblem back = read_fclib(file);
      EXPECT_EQ(back.system->matrix, problem.system->matrix);
      EXPECT_EQ(back.system->first, problem.system->first);
      EXPECT_EQ(back.system->mu, problem.system->mu);
      EXPECT_EQ(back.load, problem.load);
      const auto solution = read_fclib_solution(file, back);
      ASSERT_TRUE(solution);
      EXPECT_EQ(solution->r, state.r);
      EXPECT_EQ(solution->v, state.v);
      const auto first = read_fclib_guess(file, back);
      ASSERT_TRUE(first);
      EXPECT_EQ(first->r, guess.r);
    }
}



TEST_F(Fclib, FclibReadsOurFiles)
{
  for (const int dim : {2, 3})
    {
      const ContactProblem problem = make_problem(Form::compliance, dim, 4);
      const ContactState   state   = solve(problem);
      write_fclib(problem, file, &state);
      fclib_local    *local    = fclib_read_local(file.c_str());
      fclib_solution *solution = fclib_read_solution(file.c_str());
      ASSERT_TRUE(local && solution);
      EXPECT_EQ(local->spacedim, dim);
      EXPECT_EQ(local->W->m, 4 * dim);
      // the normal comes first
      EXPECT_EQ(local->q[0], problem.load[dim - 1]);
      EXPECT_EQ(local->q[1], problem.load[0]);
      EXPECT_EQ(solution->r[0], state.r[dim - 1]);
      // FCLib's own measure, which the solution must satisfy
      if (dim == 3)
        {
          EXPECT_LT(fclib_merit_local(local, MERIT_1, solution), 1e-8);
        }
      fclib_delete_local(local);
      fclib_delete_solutions(solution, 1);
      std::free(local);
    }
}



TEST_F(Fclib, AllMatrixStoragesOfFclib)
{
  const ContactProblem problem = make_problem(Form::compliance, 3, 3);
  // the same matrix in FCLib's order, written by FCLib three times
  const int           there[] = {2, 0, 1, 5, 3, 4, 8, 6, 7};
  const int           n       = 9;
  std::vector<double> x, q(9),
    mu(problem.system->mu.data(), problem.system->mu.data() + 3);
  std::vector<int> row, column, pointer;
  for (int j = 0; j < n; ++j)
    {
      q[static_cast<std::size_t>(j)] = problem.load[there[j]];
      pointer.push_back(n * j);
      for (int i = 0; i < n; ++i)
        {
          x.push_back(problem.system->matrix(there[i], there[j]));
          row.push_back(i);
          column.push_back(j);
        }
    }
  pointer.push_back(n * n);
  for (const int nz : {n * n, -1, -2})
    {
      fs::remove(file);
      fclib_matrix W     = {n * n,
                            n,
                            n,
                        nz > 0 ? row.data() : pointer.data(),
                        nz > 0 ? column.data() : row.data(),
                        x.data(),
                            nz,
                            nullptr};
      fclib_local  local = {
         &W, nullptr, nullptr, mu.data(), q.data(), nullptr, 3, nullptr};
      ASSERT_EQ(fclib_write_local(&local, file.c_str()), 1);
      const ContactProblem back = read_fclib(file);
      EXPECT_LT((back.system->matrix - problem.system->matrix).norm(), 1e-14);
      EXPECT_EQ(back.load, problem.load);
      EXPECT_FALSE(read_fclib_solution(file, back));
    }
}



TEST_F(Fclib, StiffnessIsTurnedIntoCompliance)
{
  for (const int dim : {2, 3})
    {
      const ContactProblem problem = make_problem(Form::stiffness, dim, 6);
      write_fclib(problem, file);
      const ContactProblem back = read_fclib(file);
      EXPECT_EQ(back.system->form, Form::compliance);
      const ContactState ours = solve(problem), theirs = solve(back);
      EXPECT_LT((ours.r - theirs.r).norm(), 1e-9 * ours.r.norm());
      EXPECT_LT((ours.v - theirs.v).norm(), 1e-9 * ours.v.norm());
    }
}



TEST_F(Fclib, WhatCannotBeWritten)
{
  ContactProblem problem = make_problem(Form::stiffness, 3, 3);
  auto           system  = std::make_shared<ContactSystem>(*problem.system);
  const MatrixXd A       = MatrixXd::Random(9, 5);
  system->matrix         = A * A.transpose();
  problem.system         = system;
  EXPECT_THROW(write_fclib(problem, file), InputError);
  EXPECT_FALSE(fs::exists(file));

  system->matrix = MatrixXd::Identity(9, 9);
  EXPECT_NO_THROW(write_fclib(problem, file));
  EXPECT_NO_THROW(write_fclib(problem, file)); // replaces the old one
  EXPECT_THROW(write_fclib(problem, folder / "no" / "x.hdf5"), WriteError);
  EXPECT_THROW(write_fclib(problem, folder), WriteError);
  system->first = {0, 3, 5, 9};
  EXPECT_THROW(write_fclib(problem, file), InputError);
  EXPECT_TRUE(fs::is_directory(folder));
}



TEST_F(Fclib, TheToolSolvesAndStores)
{
  for (const int dim : {2, 3})
    {
      const ContactProblem problem = make_problem(Form::compliance, dim, 8);
      const ContactState   state   = solve(problem);
      write_fclib(problem, file);
      ASSERT_EQ(run("solve " + file + " --solver gauss-seidel"), 0) << said;
      for (const char *word : {"contacts   8", "gauss-seidel", "residual"})
        EXPECT_NE(said.find(word), std::string::npos) << said;
      EXPECT_FALSE(read_fclib_solution(file, problem));

      const std::string other = (folder / "solved.hdf5").string();
      ASSERT_EQ(run("solve --tolerance 1e-11 " + file + " --output " + other),
                0)
        << said;
      auto solution = read_fclib_solution(other, read_fclib(other));
      ASSERT_TRUE(solution);
      EXPECT_LT((solution->r - state.r).norm(), 1e-8 * state.r.norm());
      ASSERT_EQ(run("solve " + file + " --store"), 0) << said;
      ASSERT_EQ(run("solve " + file + " --store"), 0) << said; // again
      solution = read_fclib_solution(file, problem);
      ASSERT_TRUE(solution);
      EXPECT_LT((solution->r - state.r).norm(), 1e-8 * state.r.norm());
      EXPECT_EQ(run("solve " + file + " --output " +
                    (folder / "no" / "x.hdf5").string()),
                3)
        << said;
      EXPECT_EQ(run("solve " + file + " --guess"), 1) << said;
    }
}



TEST_F(Fclib, TheToolSaysWhenNothingConverges)
{
  // two frictionless contacts that press against each other
  ContactProblem problem = make_problem(Form::compliance, 2, 2);
  auto           system  = std::make_shared<ContactSystem>(*problem.system);
  system->matrix         = MatrixXd::Zero(4, 4);
  system->matrix(1, 1) = system->matrix(3, 3) = 1;
  system->matrix(1, 3) = system->matrix(3, 1) = -1;
  system->mu.setZero();
  problem.system = system;
  problem.load << 0, -1, 0, -1;
  write_fclib(problem, file);
  EXPECT_EQ(run("solve " + file + " --store --solver gauss-seidel"), 2) << said;
  EXPECT_FALSE(read_fclib_solution(file, problem));
}



TEST_F(Fclib, UnsymmetricProblemsAreTakenAsTheyAre)
{
  for (const double skew : {1e-5, 2e-3, 1e-1})
    {
      ContactProblem problem = make_problem(Form::compliance, 3, 20);
      auto           system  = std::make_shared<ContactSystem>(*problem.system);
      const MatrixXd B       = MatrixXd::Random(60, 60);
      system->matrix += skew * (B - B.transpose());
      problem.system = system;
      write_fclib(problem, file);
      EXPECT_EQ(read_fclib(file).system->matrix, system->matrix);
      ASSERT_EQ(run("solve " + file + " --store"), 0) << said;
      const auto solution = read_fclib_solution(file, problem);
      ASSERT_TRUE(solution);
      EXPECT_LE(contact_residual(problem, *solution), 1e-10);
      // Not the problem of the symmetric part.
      system->matrix =
        (.5 * (system->matrix + system->matrix.transpose())).eval();
      EXPECT_GT(contact_residual(problem, *solution), 1e-8);
    }
}



TEST_F(Fclib, SpinningBodies)
{
  RigidBodies bodies = wall(3, 3, 3);
  shake(bodies, .05, 1);
  const ContactProblem problem = bodies.problem();
  EXPECT_GT((problem.system->matrix - problem.system->matrix.transpose())
              .cwiseAbs()
              .maxCoeff(),
            1e-5 * problem.system->matrix.cwiseAbs().maxCoeff());
  write_fclib(problem, file);
  ASSERT_EQ(run("solve " + file + " --store"), 0) << said;
  EXPECT_LE(contact_residual(problem, *read_fclib_solution(file, problem)),
            1e-10);
}



namespace
{
  /** A matrix in the storage that FCLib wants. */
  struct FclibMatrix
  {
    explicit FclibMatrix(const Eigen::SparseMatrix<double> &A)
      : p(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1)
      , i(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros())
      , x(A.valuePtr(), A.valuePtr() + A.nonZeros())
      , view{static_cast<int>(A.nonZeros()),
             static_cast<int>(A.rows()),
             static_cast<int>(A.cols()),
             p.data(),
             i.data(),
             x.data(),
             -1,
             nullptr}
    {}
    std::vector<int>    p, i;
    std::vector<double> x;
    fclib_matrix        view;
  };

  /** A global problem; the last body is moved by bilateral constraints. */
  struct GlobalProblem
  {
    explicit GlobalProblem(const RigidBodies &bodies)
      : dim(bodies.dim)
      , M(bodies.mass())
      , H(bodies.n_dofs(), bodies.directions().cols())
      , G(bodies.n_dofs(), 2)
      , f(bodies.load())
      , w(VectorXd::Zero(H.cols()))
      , b(2)
      , mu(VectorXd::Constant(H.cols() / dim, bodies.mu))
    {
      const Eigen::SparseMatrix<double> ours = bodies.directions();
      for (Eigen::Index i = 0; i < H.cols(); i += dim)
        for (Eigen::Index k = 0; k < dim; ++k)
          H.col(i + k) = ours.col(i + (k + dim - 1) % dim);
      const Eigen::Index last = bodies.n_dofs() - (dim == 3 ? 6 : 3);
      G.insert(last, 0)       = 2;
      G.insert(last + 2, 1)   = 1;
      b << -.02, 0;
      H.makeCompressed();
      G.makeCompressed();
    }
    int
    write(const std::string &file)
    {
      FclibMatrix  m(M), h(H), g(G);
      fclib_global global = {&m.view,
                             &h.view,
                             &g.view,
                             mu.data(),
                             f.data(),
                             b.data(),
                             w.data(),
                             dim,
                             nullptr};
      return fclib_write_global(&global, file.c_str());
    }
    int                         dim;
    Eigen::SparseMatrix<double> M, H, G;
    VectorXd                    f, w, b, mu;
  };
} // namespace



TEST_F(Fclib, GlobalProblems)
{
  for (const int dim : {2, 3})
    {
      RigidBodies bodies = wall(dim, 3, 3);
      shake(bodies, .05, 1);
      GlobalProblem global(bodies);
      global.w.setConstant(1e-3);
      fs::remove(file);
      ASSERT_EQ(global.write(file), 1);
      ASSERT_EQ(run("solve " + file + " --store"), 0) << said;
      ASSERT_EQ(run("solve " + file + " --store"), 0) << said; // again

      const ContactProblem problem = read_fclib(file);
      EXPECT_LE(contact_residual(problem, *read_fclib_solution(file, problem)),
                1e-10);
      fclib_solution *s = fclib_read_solution(file.c_str());
      ASSERT_TRUE(s && s->v && s->l);
      const Eigen::Map<VectorXd> v(s->v, global.M.rows()), l(s->l, 2),
        u(s->u, global.H.cols()), r(s->r, global.H.cols());
      EXPECT_LT((global.M * v - global.H * r - global.G * l - global.f).norm(),
                1e-9 * global.f.norm());
      EXPECT_LT((global.G.transpose() * v + global.b).norm(), 1e-12);
      EXPECT_LT((global.H.transpose() * v + global.w - u).norm(),
                1e-9 * v.norm());
      EXPECT_NEAR(v(global.M.rows() - (dim == 3 ? 6 : 3)), .01, 1e-14);
      fclib_delete_solutions(s, 1);
    }
}



TEST_F(Fclib, TripletsOfOtherPrograms)
{
  GlobalProblem global(tower(3, 2));
  ASSERT_EQ(global.write(file), 1);
  const MatrixXd      expected = read_fclib(file).system->matrix;
  std::vector<int>    row, column;
  std::vector<double> x;
  for (Eigen::Index j = 0; j < global.H.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator e(global.H, j); e; ++e)
      {
        row.push_back(static_cast<int>(e.row()));
        column.push_back(static_cast<int>(e.col()));
        x.push_back(e.value());
      }
  const int         n = static_cast<int>(x.size());
  const std::string H = "/fclib_global/H/";
  for (const bool columns_first : {false, true})
    for (const int room : {0, 7})
      {
        fs::remove(file);
        ASSERT_EQ(global.write(file), 1);
        replace(file, H + "nz", std::vector<int>{n});
        replace(file, H + "nzmax", std::vector<int>{n + room});
        replace(file, H + "p", columns_first ? column : row);
        replace(file, H + "i", columns_first ? row : column);
        replace(file, H + "x", x);
        EXPECT_LT((read_fclib(file).system->matrix - expected).norm(),
                  1e-12 * expected.norm());
        // values that there is room for
        std::vector<double> more = x;
        more.resize(static_cast<std::size_t>(n + room), 1e300);
        replace(file, H + "x", more);
        EXPECT_LT((read_fclib(file).system->matrix - expected).norm(),
                  1e-12 * expected.norm());
      }
}



TEST_F(Fclib, BadGlobalProblems)
{
  const RigidBodies bodies = tower(2, 2);
  const auto        refuse = [&](const std::string &word, const auto &spoil) {
    GlobalProblem global(bodies);
    fs::remove(file);
    spoil(global);
    expect_refused(word);
  };
  refuse("singular", [&](GlobalProblem &g) {
    g.M.coeffRef(5, 5) = 0;
    g.write(file);
  });
  refuse("constraints", [&](GlobalProblem &g) {
    g.G.col(1) = 3 * g.G.col(0);
    g.G.makeCompressed();
    g.write(file);
  });
  refuse("negative", [&](GlobalProblem &g) {
    g.mu[1] = -1;
    g.write(file);
  });
  const std::string root = "/fclib_global/";
  refuse("entries instead of", [&](GlobalProblem &g) {
    g.write(file);
    replace(file, root + "vectors/f", std::vector<double>{1, 2});
  });
  refuse("H has 12 rows", [&](GlobalProblem &g) {
    g.write(file);
    replace(file, root + "H/m", std::vector<int>{12});
  });
  refuse("M is not square", [&](GlobalProblem &g) {
    g.write(file);
    replace(file, root + "M/m", std::vector<int>{12});
  });
  refuse("dimension", [&](GlobalProblem &g) {
    g.write(file);
    replace(file, root + "spacedim", std::vector<int>{1});
  });
}



TEST_F(Fclib, TimeLimit)
{
  RigidBodies bodies = wall(3, 3, 3);
  shake(bodies, 1, 5);
  write_fclib(bodies.problem(), file);
  for (const char *solver :
       {"automatic", "active set", "smoothing", "gauss-seidel"})
    {
      ASSERT_EQ(run("solve " + file + " --time-limit 1e-9 --store --solver '" +
                    solver + "'"),
                2)
        << solver << said;
      EXPECT_NE(said.find("limit of time"), std::string::npos)
        << solver << said;
      EXPECT_NE(said.find("residual"), std::string::npos) << said;
      EXPECT_FALSE(read_fclib_solution(file, read_fclib(file)));
    }
  EXPECT_EQ(run("solve " + file + " --time-limit 0 --tolerance 1e-2"), 0)
    << said;
}



TEST_F(Fclib, WrongArguments)
{
  write_fclib(make_problem(Form::compliance, 2, 2), file);
  for (const char *arguments : {"",
                                "solve",
                                "other x",
                                "solve x y",
                                "solve x --solver none",
                                "solve x --solver",
                                "solve x --tolerance -1",
                                "solve x --tolerance nan",
                                "solve x --tolerance 1e-8x",
                                "solve x --time-limit",
                                "solve x --time-limit -1",
                                "solve x --time-limit soon",
                                "solve x --store --output y",
                                "solve x --fast"})
    EXPECT_EQ(run(arguments), 1) << arguments;
  EXPECT_EQ(run("--help"), 0);
}



TEST_F(Fclib, BadFiles)
{
  expect_refused("no such file");
  std::ofstream(file) << "a text\n";
  expect_refused("not an HDF5 file");
  std::ofstream(file, std::ios::trunc).flush();
  expect_refused("not an HDF5 file");
  fs::remove(file);
  fs::create_directory(file);
  expect_refused("folder");
  fs::remove(file);
  H5Fclose(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_refused("no problem of FCLib");
}



TEST_F(Fclib, TruncatedFiles)
{
  write_fclib(make_problem(Form::compliance, 3, 4), file);
  const auto        size = fs::file_size(file);
  const std::string good = file + ".good";
  fs::copy_file(file, good);
  for (int i = 1; i < 20; ++i)
    {
      fs::copy_file(good, file, fs::copy_options::overwrite_existing);
      fs::resize_file(file, size * static_cast<std::uintmax_t>(i) / 20);
      expect_refused("File");
    }
}



TEST_F(Fclib, InconsistentFiles)
{
  const double        nan      = std::numeric_limits<double>::quiet_NaN();
  const double        infinity = std::numeric_limits<double>::infinity();
  const std::string   root     = "/fclib_local/";
  std::vector<double> x(36, 0.);
  const auto          fresh = [&] {
    write_fclib(make_problem(Form::compliance, 2, 3), file);
  };
  const auto numbers = [&](const std::string         &name,
                           const std::vector<double> &values,
                           const std::string         &word) {
    fresh();
    replace(file, root + name, values);
    expect_refused(word);
  };
  const auto integers = [&](const std::string      &name,
                            const std::vector<int> &values,
                            const std::string      &word) {
    fresh();
    replace(file, root + name, values);
    expect_refused(word);
  };
  numbers("vectors/mu", {.1, -.2, .3}, "negative");
  numbers("vectors/mu", {.1, nan, .3}, "finite");
  numbers("vectors/mu", {.1, .3}, "entries instead of");
  numbers("vectors/q", {1, 2, 3, 4, 5, infinity}, "finite");
  numbers("vectors/q", {1, 2, 3}, "entries instead of");
  numbers("W/x", std::vector<double>(35, 1.), "entries instead of");
  numbers("W/m", {6.}, "integers");
  x[1] = nan;
  numbers("W/x", x, "finite");
  x[1] = 1;
  numbers("W/x", x, "symmetric");
  x[1] = 0;
  x[0] = -1;
  numbers("W/x", x, "negative");
  integers("spacedim", {4}, "dimension");
  integers("spacedim", {2, 2}, "entries instead of");
  integers("W/m", {7}, "not square");
  integers("W/m", {-6}, "rows");
  integers("W/nz", {-3}, "storage");
  integers("W/nz", {1000}, "storage");
  integers("W/nzmax", {-1}, "storage");
  integers("W/nzmax", {1000000000}, "entries instead of");
  integers("W/p", {0, 6, 12, 18, 24, 30, 1000}, "do not fit");
  integers("W/p", {0, 6, 3, 18, 24, 30, 36}, "decrease");
  std::vector<int> index(36, 0);
  index[7] = 6;
  integers("W/i", index, "outside");
  index[7] = -1;
  integers("W/i", index, "outside");
  for (const std::string name :
       {"W/x", "W", "vectors/mu", "vectors", "spacedim"})
    {
      fresh();
      const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      H5Ldelete(id, (root + name).c_str(), H5P_DEFAULT);
      H5Fclose(id);
      expect_refused("missing");
    }
}
