// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_element_forces_h
#define conetact_bodies_element_forces_h

#include <Eigen/Core>

#include <vector>

namespace conetact::bodies
{
  /** f += k u on the dofs of one element, k symmetric; `local` is room. */
  void
  multiply(const std::vector<unsigned int> &dofs,
           const double                    *matrix,
           const Eigen::VectorXd           &u,
           Eigen::VectorXd                 &local,
           Eigen::VectorXd                 &f);

  /**
   * The same where all dofs are translations: that of the first node is taken
   * out before k acts and put back only as far as k resists it. Forces of an
   * element that hardly strains then keep their digits and their sum of zero,
   * however far it moves.
   */
  void
  multiply_strained(const std::vector<unsigned int> &dofs,
                    const double                    *matrix,
                    const unsigned int               dim,
                    const Eigen::VectorXd           &u,
                    Eigen::VectorXd                 &local,
                    Eigen::VectorXd                 &f);
} // namespace conetact::bodies

#endif
