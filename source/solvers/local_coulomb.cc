// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/local_coulomb.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conetact::solvers
{
  namespace
  {
    /** Part of a block's trace that rounding may have left of a zero. */
    constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
  } // namespace



  LocalCoulomb::LocalCoulomb(const Form    which,
                             const Matrix &matrix,
                             const double  friction,
                             const double  scale)
    : form(which)
    , block(matrix)
    , mu(friction)
    , n_tangents(matrix.rows() - 1)
  {
    eigen_assert(block.rows() == block.cols() && block.rows() >= 1);
    eigen_assert(mu >= 0);
    const double floor = round_off * std::max(block.trace(), round_off * scale);
    if (form == Form::compliance)
      set_up_compliance(floor);
    else
      set_up_stiffness(floor);
  }



  /* Eigenvectors into `basis`, returns the eigenvalues. What is below `floor`
     is lifted to it, also in the block. */
  LocalCoulomb::Tangent
  LocalCoulomb::lift(const TangentMatrix &tangential, const double floor)
  {
    Tangent found = tangential.diagonal();
    basis.setIdentity(n_tangents, n_tangents);
    if (n_tangents == 2)
      {
        const Eigen::Matrix2d                                fixed = tangential;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(fixed);
        found = eigen.eigenvalues();
        basis = eigen.eigenvectors();
      }
    const Tangent values = found.cwiseMax(floor);
    block.topLeftCorner(n_tangents, n_tangents) +=
      basis * (values - found).asDiagonal() * basis.transpose();
    return values;
  }



  /* u_t = S r_t + c with S = W_tt - W_tn W_nt / W_nn, once r_n is eliminated
     by the closed gap. */
  void
  LocalCoulomb::set_up_compliance(const double floor)
  {
    const Eigen::Index n = n_tangents;

    block(n, n) = std::max(block(n, n), floor);
    // The closed gap: 0 = W_nt r_t + W_nn r_n + q_n.
    pivot       = block(n, n);
    elimination = block.col(n).head(n) / pivot;
    const TangentMatrix schur =
      block.topLeftCorner(n, n) - elimination * block.row(n).head(n);

    stick_weight = lift(.5 * (schur + schur.transpose()), floor);
    // The skew part cannot be diagonalised; turned to the basis it only takes
    // the sign of its determinant.
    if (n == 2)
      skew = .5 * (schur(1, 0) - schur(0, 1)) * basis.determinant();
    sigma       = n > 0 ? stick_weight.maxCoeff() : 1.;
    slip_weight = Tangent::Constant(n, sigma);
    normal_of_reaction =
      -basis.transpose() * (block.row(n).head(n).transpose() / pivot);
    normal_of_slip = Tangent::Zero(n);
  }



  /* r_t = K_tt u_t - q_t with closed gap. */
  void
  LocalCoulomb::set_up_stiffness(const double floor)
  {
    const Eigen::Index n = n_tangents;

    const Tangent values = lift(block.topLeftCorner(n, n), floor);
    normal_of_slip       = basis.transpose() * block.col(n).head(n);
    elimination          = basis * normal_of_slip.cwiseQuotient(values);

    // K_nn of a node that slides without friction.
    const double schur = block(n, n) - elimination.dot(block.col(n).head(n));
    pivot              = std::max(schur, floor);
    block(n, n) += pivot - schur;

    sigma              = n > 0 ? 1 / values.maxCoeff() : 1.;
    stick_weight       = Tangent::Ones(n);
    slip_weight        = values * sigma;
    normal_of_reaction = Tangent::Zero(n);
  }



  /* The diagonal matrix with this skew part, inverse, times x. */
  LocalCoulomb::Tangent
  LocalCoulomb::divide(const Tangent &x,
                       const Tangent &denominator,
                       const double   w) const
  {
    if (w == 0)
      return x.cwiseQuotient(denominator);
    const double determinant = denominator(0) * denominator(1) + w * w;
    Tangent      result(2);
    result << (denominator(1) * x(0) + w * x(1)) / determinant,
      (denominator(0) * x(1) - w * x(0)) / determinant;
    return result;
  }



  void
  LocalCoulomb::evaluate(const double theta, Slide &slide) const
  {
    // u_t = -alpha r_t turns u_t = S r_t + c, or r_t = K_tt u_t - q_t, into an
    // equation for r_t. Multiplied by 1 - theta its denominator stays regular
    // from stick to sliding.
    const Tangent denominator =
      (1 - theta) * stick_weight + theta * slip_weight;
    const double  w     = (1 - theta) * skew;
    const Tangent ratio = divide(slide.load, denominator, w);

    slide.r_t = -(1 - theta) * ratio;
    slide.u_t = sigma * theta * ratio;
    slide.r_n = slide.normal + normal_of_reaction.dot(slide.r_t) +
                normal_of_slip.dot(slide.u_t);
    const double length = slide.r_t.norm();
    slide.mismatch      = length - mu * slide.r_n;

    // Both derivatives: the terms with theta itself cancel.
    Tangent stick = ratio.cwiseProduct(stick_weight);
    if (skew != 0)
      stick += skew * Tangent(Eigen::Vector2d(-ratio(1), ratio(0)));
    const Tangent dr_t =
      divide(ratio.cwiseProduct(slip_weight), denominator, w);
    const Tangent du_t    = sigma * divide(stick, denominator, w);
    const double  dlength = length > 0 ? slide.r_t.dot(dr_t) / length : 0.;
    slide.slope =
      dlength - mu * (normal_of_reaction.dot(dr_t) + normal_of_slip.dot(du_t));
  }



  /* Newton's method within a bracket that is halved whenever it fails to
     shrink. With one tangent the mismatch times its denominator is linear. */
  void
  LocalCoulomb::find_root(Slide &slide) const
  {
    double low = 0, high = 1;
    double first = slide.mismatch;
    if (mu == 0)
      return evaluate(1, slide);
    double theta = .5;
    if (n_tangents == 1)
      {
        const double at_0 = first * stick_weight[0];
        evaluate(1, slide);
        const double at_1 = slide.mismatch * slip_weight[0];
        theta             = at_0 / (at_0 - at_1);
        return evaluate(theta, slide);
      }
    for (unsigned int i = 0; i < 100; ++i)
      {
        evaluate(theta, slide);
        // Stick demands more friction than there is, sliding less.
        (slide.mismatch > 0 ? low : high) = theta;
        const double step                 = slide.mismatch / slide.slope;
        const double next                 = theta - step;
        if (std::abs(step) <= 1e-16 * theta || slide.mismatch == 0)
          break;
        const double old = theta;
        theta = (next > low && next < high) ? next : .5 * (low + high);
        if (theta == old || high - low <= 1e-16 * high)
          break;
      }
  }



  void
  LocalCoulomb::solve(const Vector &q, Vector &v, Vector &r) const
  {
    eigen_assert(q.size() == n_tangents + 1);
    const Eigen::Index n = n_tangents;
    // Its sign is that of the gap without any reaction.
    const double normal_load =
      form == Form::compliance ? q[n] : q[n] - elimination.dot(q.head(n));
    if (normal_load >= 0) // the node is open
      {
        r.setZero(n + 1);
        v = q;
        if (form == Form::stiffness)
          {
            v[n] = normal_load / pivot;
            v.head(n) =
              basis *
              (basis.transpose() * q.head(n)).cwiseQuotient(slip_weight) *
              sigma;
            v.head(n) -= elimination * v[n];
          }
        return;
      }

    Slide slide;
    if (form == Form::compliance)
      {
        slide.load   = basis.transpose() * (q.head(n) - elimination * q[n]);
        slide.normal = -q[n] / pivot;
      }
    else
      {
        slide.load   = basis.transpose() * q.head(n);
        slide.normal = -q[n];
      }
    // theta = 0 is stick; it holds if its reaction lies in the cone.
    evaluate(0, slide);
    if (slide.mismatch > 0)
      find_root(slide);

    v.resize(n + 1);
    r.resize(n + 1);
    v << basis * slide.u_t, 0;
    r << basis * slide.r_t, std::max(slide.r_n, 0.);
  }
} // namespace conetact::solvers
