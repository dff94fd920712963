// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_stiffness_form_h
#define conetact_solvers_stiffness_form_h

#include "conetact/solvers/contact_problem.h"

namespace conetact
{
  /**
   * The stiffness form of a system in compliance form, for methods that know
   * no other: with @f$Y = W^{-1}@f$ and the motions eliminated by their balance,
   * @f[ K = Y - Y G (G^T Y G + C)^{-1} G^T Y,\quad
   *     f = K q + Y G (G^T Y G + C)^{-1} b . @f]
   * K G = 0 holds but for rounding where C = 0: results are to be corrected in
   * the compliance form. W may be singular along the motions G_0 that C does not
   * resist: their balance lets @f$\gamma G_0 G_0^T@f$ be added to it.
   */
  class StiffnessForm
  {
  public:
    /** Systems in stiffness form stay as they are. */
    explicit StiffnessForm(std::shared_ptr<const ContactSystem> given);

    const std::shared_ptr<const ContactSystem> &
    system() const
    {
      return stiff;
    }
    /** False if W is not positive definite. */
    bool
    exists() const
    {
      return stiff != nullptr;
    }
    /** f from (q, -b). */
    Eigen::VectorXd
    load(const Eigen::VectorXd &given) const;
    /** The motions a that go with displacements v under the load (q, -b). */
    Eigen::VectorXd
    motions(const Eigen::VectorXd &given, const Eigen::VectorXd &v) const;

  private:
    /** q with what the addition to W takes from it. */
    Eigen::VectorXd
    displacement(const Eigen::VectorXd &given) const;

    std::shared_ptr<const ContactSystem> dual, stiff;
    Eigen::MatrixXd YG, S; ///< S = (G^T Y G + C)^{-1}
    Eigen::MatrixXd free;  ///< motions that C does not resist
    Eigen::MatrixXd seen;  ///< gamma G_0
    double          gamma = 0;
  };
} // namespace conetact

#endif
