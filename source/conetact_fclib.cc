// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// conetact-fclib: solves contact problems in files of FCLib.

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/exchange/fclib_file.h"
#include "conetact/solvers/solver_table.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <new>
#include <string>

// Null where another BLAS is linked.
extern "C" void
openblas_set_num_threads(int) __attribute__((weak));

namespace
{
  using namespace conetact;

  /** Threads cost small problems far more than they gain. */
  void
  use_one_thread_by_default()
  {
    if (openblas_set_num_threads != nullptr &&
        std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
      openblas_set_num_threads(1);
  }

  struct CommandLine
  {
    std::string            file, output;
    solvers::SolverOptions options;
    double                 time_limit = 50; ///< seconds; 0: none
    bool                   guess      = false;
    bool                   help       = false;
  };

  std::string
  usage()
  {
    std::string text =
      "usage: conetact-fclib solve FILE.hdf5 [options]\n"
      "Solves the frictional contact problem of an FCLib file, local or "
      "global.\n"
      "  --solver NAME      one of the methods below, automatic by default\n"
      "  --tolerance T      on the residual, without units; 1e-10 by default\n"
      "  --time-limit S     gives up after S seconds with a report; 50 by "
      "default, 0: never\n"
      "  --guess            start from the first guess in the file\n"
      "  --store            store the solution in FILE.hdf5\n"
      "  --output FILE      store problem and solution in another file\n"
      "One thread is used unless OPENBLAS_NUM_THREADS says otherwise.\n"
      "Exit codes: 0 solved, 1 wrong arguments or file, 2 not converged, "
      "3 cannot write.\n"
      "Methods:\n";
    for (const solvers::SolverRow &row : solvers::solver_table())
      text += "  " + std::string(row.name) + ": " + row.description + "\n";
    return text;
  }

  /** A number, or nan. */
  double
  to_number(const std::string &text)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return text.empty() || *end != 0 ? std::nan("") : value;
  }

  double
  read_time_limit(const std::string &text)
  {
    const double value = to_number(text);
    if (!(value >= 0))
      throw InputError("--time-limit needs a number of seconds, 0 for no "
                       "limit, not '" +
                       text + "'.");
    return value;
  }

  double
  read_tolerance(const std::string &text)
  {
    const double value = to_number(text);
    if (!(value > 0) || !(value < 1))
      throw InputError("--tolerance needs a number between 0 and 1, not '" +
                       text + "'.");
    return value;
  }

  void
  check_solver(const std::string &name)
  {
    std::string names;
    for (const solvers::SolverRow &row : solvers::solver_table())
      {
        if (name == row.name)
          return;
        names += std::string(names.empty() ? "" : ", ") + row.name;
      }
    throw InputError("There is no solver '" + name +
                     "'; choose one of: " + names + ".");
  }

  CommandLine
  read_arguments(const int argc, char **argv)
  {
    CommandLine              line;
    std::vector<std::string> words(argv + 1, argv + argc);
    bool                     store = false;
    for (std::size_t i = 0; i < words.size(); ++i)
      {
        const auto value = [&]() -> const std::string & {
          if (i + 1 >= words.size())
            throw InputError("The option " + words[i] + " needs a value.");
          return words[++i];
        };
        const std::string word = words[i];
        if (word == "--help" || word == "-h")
          line.help = true;
        else if (word == "--solver")
          line.options.method = value();
        else if (word == "--tolerance")
          line.options.tolerance = read_tolerance(value());
        else if (word == "--time-limit")
          line.time_limit = read_time_limit(value());
        else if (word == "--output")
          line.output = value();
        else if (word == "--store")
          store = true;
        else if (word == "--guess")
          line.guess = true;
        else if (word.size() > 1 && word[0] == '-')
          throw InputError("There is no option '" + word + "'.");
        else if (i > 0 && line.file.empty())
          line.file = word;
        else if (i > 0 || word != "solve")
          throw InputError("'" + word + "' is not understood here.");
      }
    if (line.help)
      return line;
    if (words.empty() || words[0] != "solve")
      throw InputError("The first argument must be the command 'solve'.");
    if (line.file.empty())
      throw InputError("Which file is to be solved?");
    if (store && !line.output.empty())
      throw InputError("--store and --output exclude each other.");
    check_solver(line.options.method);
    if (store)
      line.output = line.file;
    return line;
  }

  /**
   * The law in a file is no increment of a path: parts of it would be solved
   * for another law, and are not tried.
   */
  solvers::SolverOptions
  options_of(const CommandLine &line)
  {
    using Clock                    = std::chrono::steady_clock;
    solvers::SolverOptions options = line.options;
    options.max_substeps           = 1;
    if (line.time_limit > 0)
      options.stop = [start = Clock::now(), limit = line.time_limit] {
        return std::chrono::duration<double>(Clock::now() - start).count() >
               limit;
      };
    return options;
  }

  std::string
  why_not(const CommandLine &line, const solvers::SolverReport &report)
  {
    if (report.reason.empty())
      return "the residual is too large.";
    if (report.reason.find("limit of time") == std::string::npos)
      return report.reason + '.';
    return report.reason + "; --time-limit " +
           std::to_string(static_cast<long>(10 * line.time_limit) + 1) +
           " gives it more.";
  }

  int
  solve(const CommandLine &line)
  {
    const solvers::SolverOptions  options = options_of(line);
    const solvers::ContactProblem problem = exchange::read_fclib(line.file);
    const Eigen::Index            n       = problem.system->n_unknowns();
    const Eigen::Index            n_c     = problem.system->n_nodes();
    solvers::ContactState         state;
    state.v = state.r = Eigen::VectorXd::Zero(n);
    if (line.guess)
      {
        const auto guess = exchange::read_fclib_guess(line.file, problem);
        if (!guess)
          throw InputError("The file '" + line.file + "' holds no guess.");
        state = *guess;
      }

    const auto                  start     = std::chrono::steady_clock::now();
    const std::clock_t          cpu_start = std::clock();
    const solvers::SolverReport report =
      solvers::make_solver(options)->solve(problem, state);
    const std::chrono::duration<double> time =
      std::chrono::steady_clock::now() - start;
    const double cpu_time =
      static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    const double residual = solvers::contact_residual(problem, state);
    const bool solved = report.converged && residual <= line.options.tolerance;

    std::cout << "contacts   " << n_c << " (" << n / n_c << "D)\n"
              << "solver     "
              << (report.solver.empty() ? line.options.method : report.solver)
              << "\niterations " << report.iterations << "\ntime       "
              << time.count() << " s\nCPU time   " << cpu_time
              << " s\nresidual   " << residual << '\n';
    if (!solved)
      {
        std::cerr << "Not converged: " << why_not(line, report) << '\n';
        return 2;
      }
    if (!line.output.empty())
      {
        exchange::store_fclib_solution(problem, state, line.file, line.output);
        std::cout << "solution in " << line.output << '\n';
      }
    return 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  bool has_understood = false;
  try
    {
      use_one_thread_by_default();
      take_size_limits_as_errors();
      const CommandLine line = read_arguments(argc, argv);
      if (line.help)
        {
          std::cout << usage();
          return 0;
        }
      has_understood = true;
      return solve(line);
    }
  catch (const WriteError &error)
    {
      std::cerr << error.what() << '\n';
      return 3;
    }
  catch (const std::bad_alloc &)
    {
      std::cerr << "The problem is too large for the memory of this machine.\n";
      return 1;
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      if (!has_understood)
        std::cerr << "conetact-fclib --help explains the use.\n";
      return 1;
    }
}
