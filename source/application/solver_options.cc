// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/solver_options.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/iterative/preconditioner.h"
#include "conetact/solvers/solver_table.h"

namespace conetact::application
{
  namespace
  {
    /** Numbers of the smoothing method, [K] section 5 and Hayashi et al. */
    struct SmoothingRow
    {
      const char *name;
      double solvers::SmoothingOptions::*member;
      double                             upper; ///< all are positive
      const char                        *text;
    };
    const std::vector<SmoothingRow> smoothing_table = {
      {"rho",
       &solvers::SmoothingOptions::rho,
       1,
       "Step reduction of the line search."},
      {"sigma", &solvers::SmoothingOptions::sigma, .5, "Sufficient decrease."},
      {"kappa",
       &solvers::SmoothingOptions::kappa,
       1e300,
       "Bound of smoothing m and regularisation eps by the squared residual."},
      {"kappahat",
       &solvers::SmoothingOptions::kappahat,
       1e300,
       "Bound of m by the smallest eigenvalue."},
      {"eta",
       &solvers::SmoothingOptions::eta,
       1,
       "Decrease of the bound beta."},
      {"etabar",
       &solvers::SmoothingOptions::etabar,
       1,
       "Decrease of m and eps."},
      {"m0", &solvers::SmoothingOptions::m0, 1e300, "First smoothing."},
      {"eps0",
       &solvers::SmoothingOptions::eps0,
       1e300,
       "First regularisation."},
      {"beta0", &solvers::SmoothingOptions::beta0, 1e300, "First bound beta."}};

    const std::string load_path = "load path";
    const std::string load_path_text =
      "follows the load through every change of contact state, one stage up "
      "to each of Times; finds limit loads (events.csv). Where much friction "
      "lets the path turn: in 2D the holonomic law follows it with falling and "
      "growing load, the incremental law jumps to another equilibrium under "
      "the same load; in 3D loads only grow";

    const std::string all_solutions = "all solutions";
    const std::string all_solutions_text =
      "in the plane, for up to some 30 contact nodes: every solution of each "
      "increment, followed from every one of the increment before "
      "(solutions.csv); the tables are those of the first";

    void
    declare_condensation(dealii::ParameterHandler &prm)
    {
      std::vector<std::string> names, lines;
      for (const condensed::Condenser &row : condensed::condenser_table())
        {
          names.push_back(row.name);
          lines.push_back(std::string(row.name) + ": " + row.description);
        }
      prm.declare_entry("Condensation",
                        condensed::default_condenser().name,
                        dealii::Patterns::Selection(join(names, "|")),
                        "What condenses the stiffness of bodies to their "
                        "contact nodes. " +
                          join(lines, "; ") +
                          ". Results do not depend on it but for rounding; "
                          "the option --verify compares two of them.");
    }

    void
    declare_backend(dealii::ParameterHandler &prm)
    {
      std::string names, text;
      for (const auto &row : iterative::preconditioner_table())
        {
          names += (names.empty() ? "" : "|") + std::string(row.name);
          text += "; " + std::string(row.name) + ": " + row.description;
        }
      prm.declare_entry(
        "Preconditioner",
        iterative::preconditioner_table().front().name,
        dealii::Patterns::Selection(names),
        "Backend = iterative: coarse-grid correction for errors that the "
        "smoother cannot reduce" +
          text + ". Results depend on it by rounding only.");
      prm.declare_entry(
        "Backend",
        "automatic",
        dealii::Patterns::Selection("automatic|condensed|iterative"),
        "How bodies answer to forces on their contact nodes. condensed: by a "
        "dense matrix of the contact unknowns, made once by a direct solver; "
        "fast for some thousand contact nodes, memory grows with the square of "
        "their number. iterative: Newton's method on all unknowns, whose "
        "linear systems are solved by GMRES and multigrid; memory grows with "
        "the mesh only. It solves increments (Method = automatic); its linear "
        "systems are shared by all processes (option --processes, mpirun -n). "
        "Where it does not converge, bodies are condensed from there on, if "
        "that fits into memory. automatic: by numbers of operations and by "
        "memory, not by the clock; --dry-run says which.");
    }

    std::string
    full_text(const double value)
    {
      char text[40];
      std::snprintf(text, sizeof(text), "%.15g", value);
      return text;
    }
  } // namespace

  void
  declare_solver(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const solvers::SolverOptions defaults;
    std::vector<std::string>     methods, lines;
    for (const solvers::SolverRow &row : solvers::solver_table())
      {
        methods.push_back(row.name);
        lines.push_back(std::string(row.name) + ": " + row.description);
      }
    methods.push_back(load_path);
    lines.push_back(load_path + ": " + load_path_text);
    methods.push_back(all_solutions);
    lines.push_back(all_solutions + ": " + all_solutions_text);
    prm.declare_entry("Method",
                      defaults.method,
                      Selection(join(methods, "|")),
                      join(lines, "; ") + ".");
    prm.declare_entry("Tolerance",
                      full_text(defaults.tolerance),
                      Double(1e-15, 1),
                      "Largest accepted residual of contact and of "
                      "equilibrium, both free of units. [-]");
    declare_backend(prm);
    declare_condensation(prm);
    prm.declare_entry(
      "Law",
      "incremental",
      Selection("incremental|holonomic"),
      "load path: what friction opposes. incremental: the slip "
      "as it happens, Coulomb's law as in the other methods; "
      "holonomic: the total displacement since the start, the "
      "law of [P] (2D), whose paths go on through turning points, "
      "with falling and growing load.");
    prm.enter_subsection("Smoothing");
    for (const SmoothingRow &row : smoothing_table)
      prm.declare_entry(row.name,
                        full_text(defaults.smoothing.*row.member),
                        Double(1e-300, row.upper),
                        std::string(row.text) + " [-]");
    prm.declare_entry("Maximal iterations",
                      std::to_string(defaults.smoothing.max_iterations),
                      Integer(1),
                      "Linear solves of the smoothing method.");
    prm.leave_subsection();
  }

  solvers::SolverOptions
  create_solver_options(dealii::ParameterHandler &prm)
  {
    solvers::SolverOptions options;
    options.may_be_rigid = false;
    if (prm.get("Method") != load_path && !follows_branches(prm))
      options.method = prm.get("Method");
    options.tolerance = prm.get_double("Tolerance");
    prm.enter_subsection("Smoothing");
    for (const SmoothingRow &row : smoothing_table)
      options.smoothing.*row.member = prm.get_double(row.name);
    options.smoothing.max_iterations =
      static_cast<int>(prm.get_integer("Maximal iterations"));
    prm.leave_subsection();
    return options;
  }

  bool
  follows_branches(const dealii::ParameterHandler &prm)
  {
    return prm.get("Method") == all_solutions;
  }

  const condensed::Condenser &
  chosen_condenser(dealii::ParameterHandler &prm)
  {
    return condensed::condenser_named(prm.get("Condensation"));
  }

  Backend
  chosen_backend(dealii::ParameterHandler &prm, const std::string &wants_matrix)
  {
    const std::string name   = prm.get("Backend");
    std::string       reason = wants_matrix;
    if (prm.get("Condensation") != condensed::default_condenser().name)
      reason = "Solver, Condensation = " + prm.get("Condensation");
    if (prm.get("Method") != solvers::SolverOptions().method)
      reason = "Solver, Method = " + prm.get("Method");
    if (name == "condensed" || (name == "automatic" && !reason.empty()))
      return Backend::condensed;
    if (name == "automatic")
      return Backend::automatic;
    if (!reason.empty())
      throw InputError("Solver, Backend = iterative does not go with " +
                       reason +
                       ", which needs the matrix of contact unknowns. Set "
                       "Backend = condensed, or automatic.");
    return Backend::iterative;
  }

  PathSettings
  create_path_settings(dealii::ParameterHandler &prm)
  {
    PathSettings settings;
    settings.follows = prm.get("Method") == load_path;
    settings.law     = prm.get("Law") == "holonomic" ?
                         load_path::PathLaw::holonomic :
                         load_path::PathLaw::incremental;
    return settings;
  }
} // namespace conetact::application
