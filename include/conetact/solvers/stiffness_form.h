// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_stiffness_form_h
#define conetact_solvers_stiffness_form_h

#include "conetact/solvers/contact_problem.h"

namespace conetact::solvers
{
  /**
   * The stiffness form of a system in compliance form, for methods that know
   * no other. Motions G_r that C resists add to the compliance, the others,
   * G_0, are eliminated by their balance: with @f$Y = W^{-1}@f$,
   * @f[ K = Y - Y G_0 (G_0^T Y G_0)^{-1} G_0^T Y,\quad
   *     f = K q + Y G_0 (G_0^T Y G_0)^{-1} b . @f]
   * K G_0 = 0 holds but for rounding: results are to be corrected in the
   * compliance form. W may be singular along the motions G_0 that C does not
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
    /** Whether it was made of this system. */
    bool
    is_of(const std::shared_ptr<const ContactSystem> &given) const
    {
      return dual == given;
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
    /** The motions a that go with v and r under the load (q, -b). */
    Eigen::VectorXd
    motions(const Eigen::VectorXd &given,
            const Eigen::VectorXd &v,
            const Eigen::VectorXd &r) const;

    /** An increment without its motions, and where it starts. */
    ContactProblem
    eliminate(const ContactProblem &problem) const;
    ContactState
    eliminate(const ContactState &state) const;
    /** The end of the increment with its motions, from the one without. */
    ContactState
    expand(const ContactProblem &problem, ContactState end) const;

  private:
    void
    split_motions(const Eigen::MatrixXd &C, const double gamma);
    /** q with what the additions to W take from it. */
    Eigen::VectorXd
    displacement(const Eigen::VectorXd &given) const;

    std::shared_ptr<const ContactSystem> dual, stiff;
    Eigen::MatrixXd free;      ///< motions that C hardly resists
    Eigen::VectorXd soft;      ///< how much it does
    Eigen::VectorXd part;      ///< of them that W with additions leaves open
    Eigen::MatrixXd resisted;  ///< the others, eigenvectors of C
    Eigen::VectorXd stiffness; ///< their eigenvalues
    Eigen::MatrixXd G_r;       ///< resisted ones as contacts see them
    Eigen::MatrixXd added;     ///< to W, times -b
    Eigen::MatrixXd YG, S;     ///< S = (G_0^T Y G_0 + soft / part)^{-1}
  };
} // namespace conetact::solvers

#endif
