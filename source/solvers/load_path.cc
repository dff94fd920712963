// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/load_path.h"

#include <algorithm>
#include <cmath>

namespace conetact
{
  double
  path_residual(const ContactSystem   &system,
                const PathOptions     &options,
                const Eigen::VectorXd &load,
                const PathPoint       &before,
                const PathPoint       &point)
  {
    const Eigen::Index n = system.n_unknowns();
    if (n == 0)
      return 0;
    const double rho = system.matrix.trace() / static_cast<double>(n);
    const double scale =
      std::max({point.r.norm(), rho * point.v.norm(), load.norm()});
    Eigen::VectorXd law = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < system.n_nodes(); ++i)
      {
        const Eigen::Index first = system.first[static_cast<std::size_t>(i)];
        const Eigen::Index t = system.n_tangents(i), k = system.normal(i);
        const double       pressure = std::max(point.r[k], 0.);
        const double       most =
          system.mu[i] * pressure +
          (options.cohesion.size() > 0 ? options.cohesion[i] : 0.);
        Eigen::VectorXd slip = point.v.segment(first, t);
        if (options.law == PathLaw::incremental)
          slip -= before.v.segment(first, t);
        Eigen::VectorXd trial = point.r.segment(first, t) - rho * slip;
        if (trial.norm() > most)
          trial *= most / trial.norm();
        law.segment(first, t) = point.r.segment(first, t) - trial;
        law[k] = point.r[k] - std::max(point.r[k] - rho * point.v[k], 0.);
      }
    const double error =
      std::max(law.norm(), (system.matrix * point.v - point.r - load).norm());
    return error == 0 ? 0. : error / scale;
  }
} // namespace conetact
