// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/load_path/load_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::load_path
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Residual of the laws of contact and friction, as forces. */
    VectorXd
    law_residual(const solvers::ContactSystem &system,
                 const PathOptions            &options,
                 const PathPoint              &before,
                 const PathPoint              &point,
                 const double                  rho)
    {
      VectorXd result(system.n_unknowns());
      for (Index i = 0; i < system.n_nodes(); ++i)
        {
          const Index  first = system.first[i], nt = system.n_tangents(i);
          const Index  n  = system.normal(i);
          const double rn = point.r(n);
          // g >= 0, r_n >= 0, g r_n = 0 as one equation.
          result(n) = rn - std::max(0., rn - rho * point.v(n));

          VectorXd slip = point.v.segment(first, nt);
          if (options.law == PathLaw::incremental)
            slip -= before.v.segment(first, nt);
          const double c =
            options.cohesion.size() > 0 ? options.cohesion(i) : 0.;
          // Radius of the disc that r_t must lie in; open nodes keep the
          // cohesion.
          const double   bound = system.mu(i) * std::max(0., rn) + c;
          const VectorXd r     = point.r.segment(first, nt);
          VectorXd       trial = r - rho * slip;
          if (trial.norm() > bound)
            trial *= bound / trial.norm();
          result.segment(first, nt) = r - trial;
        }
      return result;
    }
  } // namespace



  double
  path_residual(const solvers::ContactSystem &system,
                const PathOptions            &options,
                const VectorXd               &load,
                const PathPoint              &before,
                const PathPoint              &point)
  {
    eigen_assert(system.form == solvers::Form::stiffness);
    eigen_assert(load.size() == system.n_unknowns());
    eigen_assert(point.v.size() == load.size());
    eigen_assert(point.r.size() == load.size());
    eigen_assert(options.cohesion.size() == 0 ||
                 options.cohesion.size() == system.n_nodes());
    if (system.n_unknowns() == 0)
      return 0;
    if (!point.v.allFinite() || !point.r.allFinite())
      return std::numeric_limits<double>::infinity();
    // One stiffness for all nodes turns displacements into forces.
    const double mean =
      system.matrix.trace() / static_cast<double>(system.n_unknowns());
    const double rho = mean > 0 ? mean : 1.;
    const double error =
      std::max((system.matrix * point.v - point.r - load).norm(),
               law_residual(system, options, before, point, rho).norm());
    // No displacements: a scale that grows with the error hides it.
    const double scale = std::max(point.r.norm(), load.norm());
    return error == 0 ? 0. : error / scale;
  }
} // namespace conetact::load_path
