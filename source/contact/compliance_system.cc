// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/index.h"
#include "conetact/contact/condensed_compliance.h"
#include "conetact/contact/equal_bodies.h"
#include "conetact/contact/retained_unknowns.h"
#include "conetact/contact/unseen_motions.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using SparseMatrix = Eigen::SparseMatrix<double>;
    using Triplets     = std::vector<Eigen::Triplet<double>>;

    /** Appends the entries of direction . u of a node in own unknowns. */
    void
    append(const BodyCoordinates &own,
           const Index            row,
           const Index            dof,
           const unsigned int     dim,
           const Tensor<1, 3>    &direction,
           Triplets              &entries)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (direction[c] != 0)
          own.for_row(dof + c, [&](const Index unknown, const double factor) {
            entries.emplace_back(row, unknown, direction[c] * factor);
          });
    }
  } // namespace

  /* The rows of a point: the dual directions at all of its sides, in the frame
     of each body. */
  void
  CondensedCompliance::write_row(const ContactPoint &point,
                                 Index              &row,
                                 Triplets           &entries) const
  {
    for (const Tensor<1, 3> &dual : point.dual)
      {
        pairing::for_each_side(*point.node,
                               [&](const unsigned int body,
                                   const unsigned int number,
                                   const double       weight) {
                                 append(own,
                                        row,
                                        coordinates.dof(body, number),
                                        elastic.bodies.dim,
                                        elastic.bodies.in_frame(body,
                                                                weight * dual),
                                        entries);
                               });
        ++row;
      }
  }

  /* W = sum of H_b P_b H_b^T: compliances add, and contrasts are harmless.
     In a stiffness of all bodies a stiff one would swallow the digits of a
     soft one. */
  Eigen::MatrixXd
  CondensedCompliance::flexibility() const
  {
    MatrixXd W = MatrixXd::Zero(H.rows(), H.rows());
    for (const CondensedBodies::Part &part : bodies.parts())
      for (const unsigned int body : part.bodies)
        {
          // H P_b H^T needs P_b at the unknowns that contacts see, which are
          // retained: columns of H elsewhere are empty.
          const SparseMatrix all =
            H.middleCols(own.begin(body), bodies.n_own(body));
          Triplets entries;
          for (std::size_t k = 0; k < part.retained.size(); ++k)
            for (SparseMatrix::InnerIterator it(all, part.retained[k]); it;
                 ++it)
              entries.emplace_back(it.row(), static_cast<Index>(k), it.value());
          SparseMatrix rows(H.rows(), static_cast<Index>(part.retained.size()));
          rows.setFromTriplets(entries.begin(), entries.end());
          // Rows have few entries: H P costs as much as P has columns for each
          // of them, and the product with H^T no more.
          const MatrixXd half = rows * part.element->flexibility();
          W.noalias() += half * rows.transpose();
        }
    // Both triangles alike: the two products round differently.
    return .5 * (W + W.transpose());
  }

  /* (W G; -G^T C) of all rows and of the bodies' own motions. */
  Eigen::MatrixXd
  CondensedCompliance::assemble_all() const
  {
    const Index n = H.rows(), k = motions.own().cols();
    MatrixXd    all         = MatrixXd::Zero(n + k, n + k);
    all.topLeftCorner(n, n) = flexibility();
    free.add_to(H, all);
    // A rigid body has no unknowns that deform: its motions are all there is.
    for (Index j = free.first_rigid(); j < k; ++j)
      {
        const VectorXd v = moved_rows(motions.field(motions.own().col(j)));
        all.col(n + j).head(n) = v;
        all.row(n + j).head(n) = -v.transpose();
      }
    return all;
  }

  /* H u from the definition, of displacements of all dofs: rigid bodies have no
     own unknowns that H could be asked of. */
  Eigen::VectorXd
  CondensedCompliance::moved_rows(const VectorXd &u) const
  {
    AssertDimension(u.size(), coordinates.n_dofs());
    VectorXd   v(H.rows());
    Index      row = 0;
    const auto add = [&](const ContactPoint &point) {
      const Tensor<1, 3> d = difference_of_sides(
        *point.node, [&](const unsigned int body, const unsigned int node) {
          return coordinates.at_node(u, body, node);
        });
      for (const Tensor<1, 3> &dual : point.dual)
        v[row++] = d * dual;
    };
    for (const ContactPoint &point : points.all())
      add(point);
    return v;
  }

  /* The relation that solvers see: (W G; -G^T C) of all, with what is bound
     eliminated, and zeros where contacts see motions by rounding only. */
  void
  CondensedCompliance::assemble_system()
  {
    auto system   = std::make_shared<solvers::ContactSystem>(points.layout());
    const Index n = n_contact(), n_bound = points.n_bound_unknowns();
    const Index k = motions.n_free();
    // Motions stand behind the contact unknowns, each as a node of one unknown:
    // what solvers find there are amounts a in the place of r.
    system->form      = solvers::Form::compliance;
    system->n_motions = k;
    for (Index j = 0; j < k; ++j)
      system->first.push_back(system->first.back() + 1);
    MatrixXd       all      = assemble_all();
    const VectorXd diagonal = all.diagonal().head(H.rows());
    if (n_bound == 0)
      system->matrix = std::move(all);
    else
      {
        bound = BoundUnknowns(
          all,
          n,
          n_bound,
          motions.free_of_own(),
          motions.tied_of_own(),
          motions.loose(),
          find_redundant_rows(elastic.bodies, points, coordinates, motions));
        system->matrix = bound.matrix();
        // 1 / W_ii is the stiffness along a row. Where supports hold both sides
        // nothing gives way, and 1e-14 of the mean is its rounding: the
        // stiffness is that of the mean then.
        const double mean  = diagonal.mean();
        stiffness_of_bound = diagonal.tail(n_bound).unaryExpr(
          [mean](const double w) { return 1 / (w > 1e-14 * mean ? w : mean); });
      }
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
