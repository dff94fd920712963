// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/refinement.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/error_estimator.h>

namespace conetact
{
  template <int dim>
  std::vector<double>
  squared_jumps(const dealii::Triangulation<dim> &mesh,
                const Eigen::VectorXd            &u)
  {
    const dealii::FESystem<dim> fe(dealii::FE_Q<dim>(1), dim);
    dealii::DoFHandler<dim>     dofs(mesh);
    dofs.distribute_dofs(fe);
    const dealii::Vector<double> displacements(u.data(), u.data() + u.size());
    dealii::Vector<float>        jumps(mesh.n_active_cells());
    dealii::KellyErrorEstimator<dim>::estimate(
      dealii::StaticMappingQ1<dim>::mapping,
      dofs,
      dealii::QGauss<dim - 1>(2),
      {},
      displacements,
      jumps);
    std::vector<double> squares;
    for (const double jump : jumps)
      squares.push_back(jump * jump);
    return squares;
  }

  template std::vector<double>
  squared_jumps<2>(const dealii::Triangulation<2> &, const Eigen::VectorXd &);
  template std::vector<double>
  squared_jumps<3>(const dealii::Triangulation<3> &, const Eigen::VectorXd &);
} // namespace conetact
