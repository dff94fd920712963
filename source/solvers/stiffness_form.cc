// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/stiffness_form.h"

#include <utility>

namespace conetact
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  StiffnessForm::StiffnessForm(std::shared_ptr<const ContactSystem> given)
    : dual(std::move(given))
  {
    if (dual->form == Form::stiffness)
      {
        stiff = dual;
        return;
      }
    const Index n = dual->n_contact_unknowns(), k = dual->n_motions;
    const Eigen::LLT<MatrixXd> cholesky(dual->matrix.topLeftCorner(n, n));
    if (cholesky.info() != Eigen::Success)
      return;
    auto           system = std::make_shared<ContactSystem>(*dual);
    const MatrixXd Y      = cholesky.solve(MatrixXd::Identity(n, n));
    const MatrixXd G      = dual->matrix.topRightCorner(n, k);
    YG                    = cholesky.solve(G);
    // motions that no contact sees stay where they are
    S = (G.transpose() * YG + dual->matrix.bottomRightCorner(k, k))
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
  StiffnessForm::load(const VectorXd &given) const
  {
    if (dual->form == Form::stiffness)
      return given;
    const Index n = dual->n_contact_unknowns();
    return stiff->matrix * given.head(n) -
           YG * (S * given.tail(dual->n_motions));
  }

  VectorXd
  StiffnessForm::motions(const VectorXd &given, const VectorXd &v) const
  {
    const Index n = dual->n_contact_unknowns();
    return S * (YG.transpose() * (v - given.head(n)) -
                given.tail(dual->n_motions));
  }
} // namespace conetact
