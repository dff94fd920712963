// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_refinement_h
#define conetact_bodies_continuum_refinement_h

#include <Eigen/Core>

#include <vector>


namespace conetact::bodies
{
  template <int dim>
  struct Discretization;

  /**
   * How far gradients of the displacements u jump between cells,
   * @f$\eta_K^2 = \frac{h_K}{24} \int_{\partial K} |[\partial u /
   * \partial n]|^2\,ds@f$ for each active cell [length^dim]: the estimator of
   * Kelly, Gago, Zienkiewicz and Babuska (1983) without boundary terms.
   */
  template <int dim>
  std::vector<double>
  squared_jumps(const Discretization<dim> &body, const Eigen::VectorXd &u);
} // namespace conetact::bodies

#endif
