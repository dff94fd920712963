// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// conetact-reproductions: the methods of [K] and [P] as they are printed, on
// condensed problems that conetact writes.

#include "conetact/reproductions/lemke.h"
#include "conetact/reproductions/published_smoothing.h"
#include "conetact/solvers/problem_text.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

// Null where another BLAS is linked.
extern "C" void
openblas_set_num_threads(int) __attribute__((weak));

namespace
{
  using namespace conetact;

  constexpr const char *usage =
    "usage: conetact-reproductions METHOD PROBLEM.txt... [options]\n"
    "Reproduces tables of two papers and is for nothing else. The problems are "
    "files that\n"
    "conetact writes with the entry Output/Text increments = all.\n"
    "Methods:\n"
    "  lemke      the table of pivots of [P], holonomic law, in the plane, "
    "with its end by\n"
    "             criterion 1 or 2; problems are stages of Solver/Method = "
    "load path\n"
    "    --weight F     tightening weight Fc [force]; 1 by default\n"
    "  smoothing  iterations of the published, unscaled smoothing method of "
    "[K] with the\n"
    "             parameter sets A and B; problems are increments\n"
    "    --tolerance T  on its natural residual, in mixed units; 1e-8 by "
    "default\n"
    "Exit codes: 0 done, 1 wrong arguments or file, 2 a method gave up.\n";

  struct CommandLine
  {
    std::string              method;
    std::vector<std::string> files;
    double                   weight    = 1;
    double                   tolerance = 1e-8;
    bool                     help      = false;
  };

  double
  positive(const std::string &option, const std::string &text)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != 0 || !(value > 0) || value > 1e300)
      throw std::invalid_argument(option + " needs a positive number, not '" +
                                  text + "'.");
    return value;
  }

  CommandLine
  read_arguments(const std::vector<std::string> &words)
  {
    CommandLine line;
    for (std::size_t i = 0; i < words.size(); ++i)
      {
        const std::string &word   = words[i];
        const bool         number = word == "--weight" || word == "--tolerance";
        if (number && i + 1 >= words.size())
          throw std::invalid_argument("The option " + word + " needs a value.");
        if (number)
          (word == "--weight" ? line.weight : line.tolerance) =
            positive(word, words[++i]);
        else if (word == "--help" || word == "-h")
          line.help = true;
        else if (word.size() > 1 && word[0] == '-')
          throw std::invalid_argument("There is no option '" + word + "'.");
        else if (line.method.empty())
          line.method = word;
        else
          line.files.push_back(word);
      }
    return line;
  }

  solvers::StoredProblem
  read_file(const std::string &name, const bool stage)
  {
    std::ifstream file(name);
    if (!file)
      throw std::invalid_argument("The file " + name + " cannot be read.");
    try
      {
        solvers::StoredProblem stored = solvers::read_problem_text(file);
        if (stored.is_stage() != stage)
          throw std::invalid_argument(
            stage ? "It is an increment. Lemke's method needs the stages that "
                    "Solver/Method = load path writes." :
                    "It is a stage of a load path. The smoothing method needs "
                    "increments: choose another Solver/Method.");
        return stored;
      }
    catch (const std::invalid_argument &error)
      {
        throw std::invalid_argument(name + ": " + error.what());
      }
  }

  const char *
  name_of(const load_path::PathOutcome outcome)
  {
    return outcome == load_path::PathOutcome::target_reached ?
             "target reached" :
           outcome == load_path::PathOutcome::no_further_change ?
             "no further change" :
           outcome == load_path::PathOutcome::limit_load ? "mechanism" :
                                                           "not converged";
  }

  void
  print_end(const solvers::ContactSystem &system,
            const load_path::PathPoint   &end)
  {
    std::printf("%-6s%16s%16s%16s%16s\n", "node", "u_t", "g", "r_t", "r_n");
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      {
        const Eigen::Index n = system.normal(i), t = system.first[i];
        const bool         slides = system.n_tangents(i) > 0;
        std::printf("%-6ld%16.9g%16.9g%16.9g%16.9g\n",
                    static_cast<long>(i + 1),
                    slides ? end.v(t) : 0.,
                    end.v(n),
                    slides ? end.r(t) : 0.,
                    end.r(n));
      }
    std::printf("residual without the tightening: %.3g\n", end.residual);
  }

  int
  run_lemke(const CommandLine &line, const std::string &file)
  {
    const solvers::StoredProblem stored = read_file(file, true);
    load_path::PathOptions       path;
    path.law      = load_path::PathLaw::holonomic;
    path.cohesion = stored.cohesion;
    reproductions::LemkeOptions options;
    options.weight = line.weight;
    options.log    = [](const std::string &text) { std::puts(text.c_str()); };
    std::printf("# %s: p from %g to %g\n",
                file.c_str(),
                stored.begin,
                stored.end);
    const auto follower =
      reproductions::make_lemke_follower(stored.problem.system, path, options);
    std::size_t                 n_pivots = 0;
    const load_path::PathResult result   = follower->follow(
      {stored.problem.load, stored.rate, stored.begin, stored.end},
      [&](const load_path::PathPoint &point) {
        if (!point.changes.empty())
          ++n_pivots;
        else
          print_end(*stored.problem.system, point);
      });
    std::printf("%s at p = %.15g after %zu pivots. %s\n",
                name_of(result.outcome),
                result.parameter,
                n_pivots,
                result.reason.c_str());
    return result.outcome == load_path::PathOutcome::not_converged ? 2 : 0;
  }

  int
  run_smoothing(const CommandLine &line, const std::string &file)
  {
    const solvers::ContactProblem problem = read_file(file, false).problem;
    int                           code    = 0;
    for (const reproductions::PublishedSet &set :
         reproductions::published_sets())
      {
        const reproductions::PublishedRun run =
          reproductions::solve_as_published(problem, set, line.tolerance);
        std::printf("%-4s%12u%18.1e%10.0e%10.0e%10.0e  %s%s\n",
                    set.name,
                    run.iterations,
                    run.natural,
                    run.errors.err1,
                    run.errors.err2,
                    run.residual,
                    file.c_str(),
                    run.failure.empty() ? "" : (": " + run.failure).c_str());
        if (!run.failure.empty())
          code = 2;
      }
    return code;
  }

  void
  check(const CommandLine &line)
  {
    if (line.method != "lemke" && line.method != "smoothing")
      throw std::invalid_argument("There is no method '" + line.method +
                                  "', but lemke and smoothing.");
    if (line.files.empty())
      throw std::invalid_argument("Which problem files are to be read?");
  }

  int
  run(const CommandLine &line)
  {
    const bool lemke = line.method == "lemke";
    if (!lemke)
      std::printf("%-4s%12s%18s%10s%10s%10s  %s\n",
                  "set",
                  "iterations",
                  "natural residual",
                  "err1",
                  "err2",
                  "residual",
                  "file");
    int code = 0;
    for (const std::string &file : line.files)
      code =
        std::max(code,
                 lemke ? run_lemke(line, file) : run_smoothing(line, file));
    return code;
  }
} // namespace

int
main(int argc, char **argv)
{
  // Threads cost small problems far more than they gain.
  if (openblas_set_num_threads != nullptr &&
      std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
    openblas_set_num_threads(1);
  bool has_understood = false;
  try
    {
      const CommandLine line = read_arguments({argv + 1, argv + argc});
      if (line.help)
        {
          std::cout << usage;
          return 0;
        }
      check(line);
      has_understood = true;
      return run(line);
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << '\n';
      if (!has_understood)
        std::cerr << "conetact-reproductions --help explains the use.\n";
      return 1;
    }
}
