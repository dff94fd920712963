// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_local_coulomb_h
#define conetact_solvers_local_coulomb_h

#include "conetact/solvers/contact_problem.h"

#include <Eigen/Dense>

namespace conetact::solvers
{
  /**
   * The Coulomb problem of one single contact node, solved exactly: find
   * v = (slip, gap) and r = (r_t, r_n) with @f$v = W r + q@f$ or
   * @f$K v = r + q@f$ (W or K of size one to three) that obey the law.
   *
   * Open and stick are tried first. What is left slips along
   * @f$u_t = -\alpha r_t@f$. With @f$\alpha = \sigma\theta/(1-\theta)@f$ both
   * are explicit functions of theta in [0, 1], from stick to frictionless
   * sliding, and @f$|r_t| - \mu r_n@f$ changes its sign in between: a root is
   * always found. (Jourdan, Alart, Jean 1998 take it from a quartic in alpha,
   * which loses digits for large mu.) Where the law has several solutions it
   * returns one of them. W need not be symmetric (gyroscopic terms): in the
   * basis that diagonalises the symmetric part the skew part stays what it is.
   */
  class LocalCoulomb
  {
  public:
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
    using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

    /**
     * Pivots below round-off of their block are lifted to it (of `scale`, a
     * typical diagonal entry, if the whole block vanishes).
     */
    LocalCoulomb(const Form    which,
                 const Matrix &matrix,
                 const double  friction,
                 const double  scale);

    /** Writes v and r for the right-hand side q. */
    void
    solve(const Vector &q, Vector &v, Vector &r) const;

    /** The block as it was used, lifted where it was singular. */
    const Matrix &
    matrix() const
    {
      return block;
    }

  private:
    using Tangent = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;
    using TangentMatrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;

    /** A point of the sliding family, in components of the eigenvectors. */
    struct Slide
    {
      Tangent load;       ///< c of r_t = -(1 - theta) c / denominator
      double  normal = 0; ///< part of r_n that does not depend on theta
      Tangent r_t, u_t;
      double  r_n      = 0;
      double  mismatch = 0; ///< |r_t| - mu r_n
      double  slope    = 0; ///< its derivative in theta
    };
    void
    evaluate(const double theta, Slide &slide) const;
    void
    find_root(Slide &slide) const;
    Tangent
    divide(const Tangent &x, const Tangent &denominator, const double w) const;
    Tangent
    lift(const TangentMatrix &tangential, const double floor);
    void
    set_up_compliance(const double floor);
    void
    set_up_stiffness(const double floor);

    Form          form;
    Matrix        block;
    double        mu;
    Eigen::Index  n_tangents;
    double        pivot;       ///< of the normal: W_nn, or K_nn without u_t
    Tangent       elimination; ///< W_tn / W_nn, or K_tt^-1 K_tn
    TangentMatrix basis;       ///< eigenvectors of the tangential matrix
    Tangent       stick_weight, slip_weight; ///< denominator (1-theta), theta
    double        sigma;    ///< slip over reaction at theta = 1/2
    double        skew = 0; ///< w of the skew part [0 -w; w 0]
    Tangent normal_of_reaction, normal_of_slip; ///< r_n from r_t and from u_t
  };
} // namespace conetact::solvers

#endif
