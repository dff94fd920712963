// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/stiffness_form.h"

#include <utility>

namespace conetact::solvers
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /** Whether what is left of a diagonal entry of W is its rounding, which
     * may as well be above zero. */
    bool
    is_singular(const MatrixXd &W, const Eigen::LLT<MatrixXd> &cholesky)
    {
      constexpr double rounding = 1e-12;
      const VectorXd   pivots   = cholesky.matrixLLT().diagonal();
      return (pivots.array().square() <= rounding * W.diagonal().array()).any();
    }
  } // namespace

  StiffnessForm::StiffnessForm(std::shared_ptr<const ContactSystem> given)
    : dual(std::move(given))
  {
    if (dual->form == Form::stiffness)
      {
        stiff = dual;
        return;
      }
    const Index    n = dual->n_contact_unknowns(), k = dual->n_motions;
    const MatrixXd G = dual->matrix.topRightCorner(n, k);
    MatrixXd       W = dual->matrix.topLeftCorner(n, n);
    // Balance of motions a that nothing resists, or little, gives
    // G_0^T r = c a - b_0, so gamma G_0 G_0^T r is known but for a: W may have
    // it if q and a give it back. Then W is regular where only motions made it
    // singular. gamma makes both parts of one size.
    const double gamma = G.squaredNorm() > 0 ? W.trace() / G.squaredNorm() : 0.;
    split_motions(dual->matrix.bottomRightCorner(k, k), gamma);
    // Motions that foundations resist follow from the reactions, C a = G_r^T r
    // + b, and add their compliance.
    G_r = G * resisted;
    W += G_r * stiffness.cwiseInverse().asDiagonal() * G_r.transpose();
    const MatrixXd G_0 = G * free;
    W += gamma * G_0 * G_0.transpose();
    added = gamma * G_0 * free.transpose();
    if (G_r.cols() > 0)
      added +=
        G_r * stiffness.cwiseInverse().asDiagonal() * resisted.transpose();
    const Eigen::LLT<MatrixXd> cholesky(W);
    if (cholesky.info() != Eigen::Success || is_singular(W, cholesky))
      return;
    auto           system = std::make_shared<ContactSystem>(*dual);
    const MatrixXd Y      = cholesky.solve(MatrixXd::Identity(n, n));
    YG                    = cholesky.solve(G_0);
    // Motions that no contact sees stay where they are.
    S = MatrixXd(free.cols(), free.cols());
    if (S.size() > 0)
      {
        S = G_0.transpose() * YG;
        S.diagonal() += soft.cwiseQuotient(part);
        S = S.completeOrthogonalDecomposition().pseudoInverse().eval();
      }
    system->form      = Form::stiffness;
    system->n_motions = 0;
    system->first.resize(system->first.size() - static_cast<std::size_t>(k));
    // Y less its part along the motions, so that K G_0 = 0. Symmetric to the
    // last bit: of this form one triangle is read.
    system->matrix = Y - YG * S * YG.transpose();
    system->matrix =
      (.5 * (system->matrix + system->matrix.transpose())).eval();
    stiff = system;
  }

  /* Supports by springs resist some motions of a body and leave others free: C
     is split by its eigenvectors, with zeros up to rounding. Compliances of
     soft springs are so large that W would lose the digits of what is elastic:
     such motions are treated as free ones, but for their stiffness. */
  void
  StiffnessForm::split_motions(const MatrixXd &C, const double gamma)
  {
    eigen_assert(C.rows() == C.cols());
    free = resisted = MatrixXd(C.rows(), 0);
    if (C.rows() == 0)
      return;
    constexpr double few = .1; // of the stiffness that is about W's inverse
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(C);
    const double zero = 1e-12 * eigen.eigenvalues().maxCoeff();
    const Index  k    = (eigen.eigenvalues().array() <= zero ||
                     gamma * eigen.eigenvalues().array() <= few)
                      .count();
    free     = eigen.eigenvectors().leftCols(k);
    resisted = eigen.eigenvectors().rightCols(C.rows() - k);
    soft     = (eigen.eigenvalues().head(k).array() <= zero)
             .select(0., eigen.eigenvalues().head(k));
    part      = (1 - gamma * soft.array()).matrix();
    stiffness = eigen.eigenvalues().tail(C.rows() - k);
  }

  /* q + gamma G_0 b_0 + G_r C^-1 b_r, so that v = W r + q stays the same with
     what was added to W. */
  VectorXd
  StiffnessForm::displacement(const VectorXd &given) const
  {
    eigen_assert(given.size() == dual->n_unknowns());
    if (dual->n_motions == 0)
      return given;
    return given.head(dual->n_contact_unknowns()) -
           added * given.tail(dual->n_motions);
  }

  VectorXd
  StiffnessForm::load(const VectorXd &given) const
  {
    if (dual->form == Form::stiffness)
      return given;
    VectorXd f = stiff->matrix * displacement(given);
    if (free.cols() > 0) // BLAS does not take matrices of size 0
      f -= YG * (S * (free.transpose() * given.tail(dual->n_motions)));
    return f;
  }

  /* The free ones from r = Y (v - G_0 a_0 - q) and their balance, the others
     from C a = G_r^T r + b. */
  VectorXd
  StiffnessForm::motions(const VectorXd &given,
                         const VectorXd &v,
                         const VectorXd &r) const
  {
    eigen_assert(given.size() == dual->n_unknowns());
    eigen_assert(v.size() == dual->n_contact_unknowns());
    eigen_assert(r.size() == dual->n_contact_unknowns());
    const VectorXd b = -given.tail(dual->n_motions);
    VectorXd       a = VectorXd::Zero(b.size());
    if (free.cols() > 0)
      a += free * (S * (YG.transpose() * (v - displacement(given)) +
                        free.transpose() * b))
                    .cwiseQuotient(part);
    if (resisted.cols() > 0)
      a += resisted * (G_r.transpose() * r + resisted.transpose() * b)
                        .cwiseQuotient(stiffness);
    return a;
  }

  ContactProblem
  StiffnessForm::eliminate(const ContactProblem &problem) const
  {
    eigen_assert(problem.system == dual);
    ContactProblem result = problem;
    result.system         = stiff;
    result.load           = load(problem.load);
    return result;
  }

  ContactState
  StiffnessForm::eliminate(const ContactState &state) const
  {
    eigen_assert(state.v.size() >= dual->n_contact_unknowns());
    eigen_assert(state.r.size() >= dual->n_contact_unknowns());
    const Index  n      = dual->n_contact_unknowns();
    ContactState result = state;
    result.v            = state.v.head(n);
    result.r            = state.r.head(n);
    return result;
  }

  ContactState
  StiffnessForm::expand(const ContactProblem &problem, ContactState end) const
  {
    const Index    n = dual->n_contact_unknowns(), k = dual->n_motions;
    const VectorXd a = motions(problem.load, end.v, end.r);
    end.v.conservativeResizeLike(VectorXd::Zero(n + k));
    end.r.conservativeResize(n + k);
    end.r.tail(k) = a;
    return end;
  }
} // namespace conetact::solvers
