// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/large_motions.h"

#include "conetact/solvers/null_space.h"

#include <algorithm>

namespace conetact::contact
{
  using Eigen::VectorXd;

  namespace
  {
    /** The translation e or the rotation e x (p - c) of all unknowns, as each
     * body sees it in its frame, with the norm 1; rotating nodes turn by the
     * same angle. */
    VectorXd
    common_motion(const model::Bodies &bodies,
                  const Coordinates   &coordinates,
                  const Point<3>      &centre,
                  const Tensor<1, 3>  &axis,
                  const bool           turns)
    {
      const unsigned int dim = bodies.dim;
      VectorXd           u   = VectorXd::Zero(coordinates.n_dofs());
      for (unsigned int b = 0; b < bodies.n_elastic(); ++b)
        for (unsigned int i = 0; i < bodies.structures[b]->n_nodes(); ++i)
          {
            const bodies::Structure &structure = *bodies.structures[b];
            const Tensor<1, 3>       moved     = bodies.in_frame(
              b,
              turns ? cross_product_3d(axis, bodies.position(b, i) - centre) :
                                axis);
            const Eigen::Index first = coordinates.dof(b, i);
            for (unsigned int c = 0; c < dim; ++c)
              u[first + c] = moved[c];
            for (unsigned int c = dim; c < structure.n_components() && turns;
                 ++c)
              u[first + c] = axis[dim == 2 ? 2 : c - dim];
          }
      VectorXd mode = coordinates.values(u);
      // Levels orthogonalise modes against each other: of one size, none is
      // taken for rounding. Where nothing is free a mode is zero.
      mode /= std::max(mode.norm(), 1e-300);
      return mode;
    }
  } // namespace

  /* The near null space for aggregation: all bodies together, as if joined.
     About the mean of all nodes turns are nearly orthogonal to translations.
     Functions make them when asked, one at a time, for each is as long as all
     unknowns. */
  std::vector<std::function<VectorXd()>>
  common_motions(const model::Bodies &bodies, const Coordinates &coordinates)
  {
    const unsigned int dim = bodies.dim, n_turns = dim == 2 ? 1 : 3;
    Point<3>           centre;
    unsigned int       n = 0;
    for (unsigned int b = 0; b < bodies.n_elastic(); ++b)
      for (unsigned int i = 0; i < bodies.structures[b]->n_nodes(); ++i, ++n)
        centre += Tensor<1, 3>(bodies.position(b, i));
    centre /= std::max(n, 1u);
    std::vector<std::function<VectorXd()>> modes;
    for (unsigned int k = 0; k < dim + n_turns; ++k)
      {
        Tensor<1, 3> axis;
        axis[k < dim ? k : dim == 2 ? 2 : k - dim] = 1;
        modes.emplace_back([&bodies, &coordinates, centre, axis, k, dim] {
          return common_motion(bodies, coordinates, centre, axis, k >= dim);
        });
      }
    return modes;
  }

  Eigen::MatrixXd
  unresisted_fields(const RigidMotions &motions, const Coordinates &coordinates)
  {
    const Eigen::MatrixXd unseen = motions.unseen();
    Eigen::MatrixXd       fields(coordinates.n_dofs(), unseen.cols());
    for (Eigen::Index j = 0; j < unseen.cols(); ++j)
      fields.col(j) = motions.field(motions.of_free(unseen.col(j)));
    return solvers::orthonormal_basis(fields);
  }

  /* The unknown that all motions together move furthest is held, motions that
     are left do not move it, and of these the next one is chosen, as pivots
     are. */
  std::vector<Eigen::Index>
  find_pins(const Eigen::MatrixXd &fields, const Coordinates &coordinates)
  {
    std::vector<Eigen::Index> pins;
    Eigen::MatrixXd           moved(coordinates.n_unknowns(), fields.cols());
    for (Eigen::Index j = 0; j < fields.cols(); ++j)
      moved.col(j) = coordinates.values(fields.col(j));
    for (Eigen::Index j = 0; j < fields.cols(); ++j)
      {
        Eigen::Index furthest = 0;
        moved.rowwise().squaredNorm().maxCoeff(&furthest);
        pins.push_back(furthest);
        // The motions that are left with it held.
        const VectorXd row = moved.row(furthest).normalized();
        moved -= (moved * row).eval() * row.transpose();
      }
    return pins;
  }
} // namespace conetact::contact
