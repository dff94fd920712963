// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/refinement.h"

#include "conetact/bodies/continuum/discretization.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/error_estimator.h>

namespace conetact::bodies
{
  template <int dim>
  std::vector<double>
  squared_jumps(const Discretization<dim> &body, const Eigen::VectorXd &u)
  {
    dealii::DoFHandler<dim> of_vertices(*body.triangulation);
    const bool              has_dofs = body.dof_handler.has_active_dofs();
    if (!has_dofs)
      of_vertices.distribute_dofs(body.fe);
    const dealii::Vector<double> displacements(u.data(), u.data() + u.size());
    dealii::Vector<float>        jumps(body.triangulation->n_active_cells());
    dealii::KellyErrorEstimator<dim>::estimate(
      body.mapping,
      has_dofs ? body.dof_handler : of_vertices,
      dealii::QGauss<dim - 1>(body.fe.degree + 1),
      {},
      displacements,
      jumps);
    std::vector<double> squares;
    for (const double jump : jumps)
      squares.push_back(jump * jump);
    return squares;
  }

  template std::vector<double>
  squared_jumps<2>(const Discretization<2> &, const Eigen::VectorXd &);
  template std::vector<double>
  squared_jumps<3>(const Discretization<3> &, const Eigen::VectorXd &);
} // namespace conetact::bodies
