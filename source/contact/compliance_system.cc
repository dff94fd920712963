// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/condensed_compliance.h"
#include "conetact/contact/unseen_motions.h"

#include <utility>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using SparseMatrix = Eigen::SparseMatrix<double>;
  } // namespace

  /* (W G; -G^T C) of all rows and of the bodies' own motions. */
  Eigen::MatrixXd
  CondensedCompliance::assemble_all() const
  {
    const SparseMatrix &H = rows.matrix();
    const Index         n = H.rows(), k = motions.own().cols();
    MatrixXd            all = MatrixXd::Zero(n + k, n + k);
    all.topLeftCorner(n, n) = rows.flexibility(bodies);
    free.add_to(H, all);
    if (motions.has_geometric())
      all.bottomRightCorner(k, k) += motions.geometric_of_own();
    // A rigid body has no unknowns that deform: its motions are all there is.
    for (Index j = free.first_rigid(); j < k; ++j)
      {
        const VectorXd v = rows.moved(motions.field(motions.own().col(j)));
        all.col(n + j).head(n) = v;
        all.row(n + j).head(n) = -v.transpose();
      }
    return all;
  }

  /* The relation that solvers see: (W G; -G^T C) of all, with what is bound
     eliminated, and zeros where contacts see motions by rounding only. */
  void
  CondensedCompliance::assemble_system()
  {
    auto system   = std::make_shared<solvers::ContactSystem>(points.layout());
    const Index k = motions.n_free();
    // Motions stand behind the contact unknowns, each as a node of one unknown:
    // what solvers find there are amounts a in the place of r.
    system->form      = solvers::Form::compliance;
    system->n_motions = k;
    for (Index j = 0; j < k; ++j)
      system->first.push_back(system->first.back() + 1);
    MatrixXd       all      = assemble_all();
    const VectorXd diagonal = all.diagonal().head(points.n_all_unknowns());
    system->matrix =
      eliminated.eliminate(std::move(all), elastic.bodies, coordinates);
    forget_unseen_motions(*system);
    // The check of existence asks for motions that not even foundations resist.
    system->null_space = motions.null_space();
    contact_system     = system;
    // 1 / mean W_ii: prescribed displacements times this compare with forces.
    stiffness_scale = diagonal.sum() > 0 ?
                        static_cast<double>(diagonal.size()) / diagonal.sum() :
                        1.;
  }

  /* Only motions that no foundation resists can be unseen: the rows and columns
     of these are written anew, without what is rounding. */
  void
  CondensedCompliance::forget_unseen_motions(solvers::ContactSystem &system)
  {
    const Index n = system.n_contact_unknowns(), k = system.n_motions;
    const auto &loose = motions.loose();
    MatrixXd    G     = system.matrix.topRightCorner(n, k)(Eigen::all, loose);
    unseen            = motions.unresisted() * forget_unseen(G);
    for (std::size_t j = 0; j < loose.size(); ++j)
      {
        const Index i = n + loose[j];
        system.matrix.col(i).setZero();
        system.matrix.row(i).setZero();
        system.matrix.col(i).head(n) = G.col(static_cast<Index>(j));
        system.matrix.row(i).head(n) = -G.col(static_cast<Index>(j));
      }
  }
} // namespace conetact::contact
