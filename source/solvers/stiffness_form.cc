// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/stiffness_form.h"

#include <utility>

namespace conetact
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /** Null space of a small symmetric positive semidefinite matrix. */
    MatrixXd
    unresisted(const MatrixXd &C)
    {
      if (C.rows() == 0)
        return C;
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(C);
      const double limit = 1e-12 * eigen.eigenvalues().maxCoeff();
      Index        k     = 0;
      while (k < C.rows() && eigen.eigenvalues()[k] <= limit)
        ++k;
      return eigen.eigenvectors().leftCols(k);
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
    const Index n = dual->n_contact_unknowns(), k = dual->n_motions;
    const MatrixXd G = dual->matrix.topRightCorner(n, k);
    const MatrixXd C = dual->matrix.bottomRightCorner(k, k);
    free             = unresisted(C);
    const MatrixXd G0 = G * free;
    MatrixXd       W  = dual->matrix.topLeftCorner(n, n);
    gamma             = G0.squaredNorm() > 0 ? W.trace() / G0.squaredNorm() : 0.;
    W += gamma * G0 * G0.transpose();
    seen = gamma * G0;
    const Eigen::LLT<MatrixXd> cholesky(W);
    if (cholesky.info() != Eigen::Success)
      return;
    auto           system = std::make_shared<ContactSystem>(*dual);
    const MatrixXd Y      = cholesky.solve(MatrixXd::Identity(n, n));
    YG                    = cholesky.solve(G);
    // motions that no contact sees stay where they are
    S = (G.transpose() * YG + C)
          .completeOrthogonalDecomposition()
          .pseudoInverse();
    system->form      = Form::stiffness;
    system->n_motions = 0;
    system->first.resize(system->first.size() - static_cast<std::size_t>(k));
    system->matrix = Y - YG * S * YG.transpose();
    system->matrix = (.5 * (system->matrix + system->matrix.transpose())).eval();
    stiff          = system;
  }

  VectorXd
  StiffnessForm::displacement(const VectorXd &given) const
  {
    return given.head(dual->n_contact_unknowns()) -
           seen * (free.transpose() * given.tail(dual->n_motions));
  }

  VectorXd
  StiffnessForm::load(const VectorXd &given) const
  {
    if (dual->form == Form::stiffness)
      return given;
    return stiff->matrix * displacement(given) -
           YG * (S * given.tail(dual->n_motions));
  }

  VectorXd
  StiffnessForm::motions(const VectorXd &given, const VectorXd &v) const
  {
    return S * (YG.transpose() * (v - displacement(given)) -
                given.tail(dual->n_motions));
  }
} // namespace conetact
