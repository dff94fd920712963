// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/solver_options.h"

#include "conetact/base/text.h"

namespace conetact
{
  namespace
  {
    /** Numbers of the smoothing method, [K] section 5 and Hayashi et al. */
    struct SmoothingRow
    {
      const char *name;
      double SmoothingOptions::*member;
      double                    upper; ///< all are positive
      const char               *text;
    };
    const std::vector<SmoothingRow> smoothing_table = {
      {"rho", &SmoothingOptions::rho, 1, "Step reduction of the line search."},
      {"sigma", &SmoothingOptions::sigma, .5, "Sufficient decrease."},
      {"kappa",
       &SmoothingOptions::kappa,
       1e300,
       "Bound of smoothing m and regularisation eps by the squared residual."},
      {"kappahat",
       &SmoothingOptions::kappahat,
       1e300,
       "Bound of m by the smallest eigenvalue."},
      {"eta", &SmoothingOptions::eta, 1, "Decrease of the bound beta."},
      {"etabar", &SmoothingOptions::etabar, 1, "Decrease of m and eps."},
      {"m0", &SmoothingOptions::m0, 1e300, "First smoothing."},
      {"eps0", &SmoothingOptions::eps0, 1e300, "First regularisation."},
      {"beta0", &SmoothingOptions::beta0, 1e300, "First bound beta."}};

    struct PathRow
    {
      const char          *name;
      PathSettings::Method method;
      const char          *description;
    };
    const std::vector<PathRow> path_table = {
      {"load path",
       PathSettings::Method::events,
       "follows the load through every change of contact state, one stage up "
       "to each of Times; finds limit loads (events.csv)"},
      {"lemke",
       PathSettings::Method::lemke,
       "the method of [P] with its table of pivots in log.txt, for "
       "reproduction only (2D)"}};

    /** Whether the methods are followers of paths, which need no solver. */
    PathSettings::Method
    path_method(const std::string &name)
    {
      for (const PathRow &row : path_table)
        if (name == row.name)
          return row.method;
      return PathSettings::Method::none;
    }

    void
    declare_condensation(dealii::ParameterHandler &prm)
    {
      std::vector<std::string> names, lines;
      for (const Condenser &row : condenser_table())
        {
          names.push_back(row.name);
          lines.push_back(std::string(row.name) + ": " + row.description);
        }
      prm.declare_entry("Condensation",
                        default_condenser().name,
                        dealii::Patterns::Selection(join(names, "|")),
                        "What condenses the stiffness of bodies to their "
                        "contact nodes. " +
                          join(lines, "; ") +
                          ". Results do not depend on it but for rounding; "
                          "the option --verify compares two of them.");
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
    const SolverOptions      defaults;
    std::vector<std::string> methods, lines;
    for (const SolverRow &row : solver_table())
      {
        methods.push_back(row.name);
        lines.push_back(std::string(row.name) + ": " + row.description);
      }
    for (const PathRow &row : path_table)
      {
        methods.push_back(row.name);
        lines.push_back(std::string(row.name) + ": " + row.description);
      }
    prm.declare_entry("Method",
                      defaults.method,
                      Selection(join(methods, "|")),
                      join(lines, "; ") + ".");
    prm.declare_entry("Tolerance",
                      full_text(defaults.tolerance),
                      Double(1e-15, 1),
                      "Largest accepted residual of contact and of "
                      "equilibrium, both free of units. [-]");
    declare_condensation(prm);
    prm.declare_entry("Scaling",
                      "automatic",
                      Selection("automatic|none"),
                      "smoothing: automatic makes the problem free of units, "
                      "none is the published form, whose iterations depend on "
                      "the units of the scene.");
    prm.declare_entry("Law",
                      "incremental",
                      Selection("incremental|holonomic"),
                      "load path: what friction opposes. incremental: the slip "
                      "as it happens, Coulomb's law as in the other methods; "
                      "holonomic: the total displacement since the start, the "
                      "law of [P] (2D).");
    prm.declare_entry("Tightening weight",
                      "1",
                      Double(1e-300),
                      "lemke: the artificial compression Fc of all contact "
                      "nodes; a prestress Fc and a cohesion (1 - mu) Fc. "
                      "[force]");
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

  SolverOptions
  create_solver_options(dealii::ParameterHandler &prm)
  {
    SolverOptions options;
    options.may_be_rigid = false;
    if (path_method(prm.get("Method")) == PathSettings::Method::none)
      options.method = prm.get("Method");
    options.tolerance        = prm.get_double("Tolerance");
    options.smoothing.scaled = prm.get("Scaling") == "automatic";
    prm.enter_subsection("Smoothing");
    for (const SmoothingRow &row : smoothing_table)
      options.smoothing.*row.member = prm.get_double(row.name);
    options.smoothing.max_iterations =
      static_cast<int>(prm.get_integer("Maximal iterations"));
    prm.leave_subsection();
    return options;
  }

  const Condenser &
  chosen_condenser(dealii::ParameterHandler &prm)
  {
    return condenser_named(prm.get("Condensation"));
  }

  PathSettings
  create_path_settings(dealii::ParameterHandler &prm)
  {
    PathSettings settings;
    settings.method = path_method(prm.get("Method"));
    settings.law =
      prm.get("Law") == "holonomic" ? PathLaw::holonomic : PathLaw::incremental;
    settings.weight = prm.get_double("Tightening weight");
    return settings;
  }
} // namespace conetact
