// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/body_rows.h"

#include <deal.II/base/exceptions.h>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Triplets = std::vector<Eigen::Triplet<double>>;

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

  BodyRows::BodyRows(const model::Bodies   &b,
                     const ContactPoints   &p,
                     const Coordinates     &c,
                     const BodyCoordinates &o)
    : bodies(b)
    , points(p)
    , coordinates(c)
    , own(o)
  {
    find_again();
  }

  /* v = (u of the node) - (u of the obstacle) or - sum of weight (u of a
     master), in components along the dual directions, in the frame of each
     body. Motions of obstacles and supports are part of q. */
  void
  BodyRows::find_again()
  {
    Triplets entries;
    Index    row = 0;
    for (const ContactPoint &point : points.all())
      for (const Tensor<1, 3> &dual : point.dual)
        {
          pairing::for_each_side(*point.node,
                                 [&](const unsigned int body,
                                     const unsigned int number,
                                     const double       weight) {
                                   append(own,
                                          row,
                                          coordinates.dof(body, number),
                                          bodies.dim,
                                          bodies.in_frame(body, weight * dual),
                                          entries);
                                 });
          ++row;
        }
    AssertDimension(row, points.n_all_unknowns());
    H = Matrix(row, own.n_unknowns());
    H.setFromTriplets(entries.begin(), entries.end());
  }

  /* H u from the definition, of displacements of all dofs: rigid bodies have no
     own unknowns that H could be asked of. */
  Eigen::VectorXd
  BodyRows::moved(const VectorXd &u) const
  {
    AssertDimension(u.size(), coordinates.n_dofs());
    VectorXd v(H.rows());
    Index    row = 0;
    for (const ContactPoint &point : points.all())
      {
        const Tensor<1, 3> d = difference_of_sides(
          *point.node, [&](const unsigned int body, const unsigned int node) {
            return bodies.in_space(body, coordinates.at_node(u, body, node));
          });
        for (const Tensor<1, 3> &dual : point.dual)
          v[row++] = d * dual;
      }
    return v;
  }

  /* W = sum of H_b P_b H_b^T: compliances add, and contrasts are harmless.
     In a stiffness of all bodies a stiff one would swallow the digits of a
     soft one. */
  Eigen::MatrixXd
  BodyRows::flexibility(const CondensedBodies &condensed) const
  {
    MatrixXd W = MatrixXd::Zero(H.rows(), H.rows());
    for (const CondensedBodies::Part &part : condensed.parts())
      for (const unsigned int body : part.bodies)
        {
          // H P_b H^T needs P_b at the unknowns that contacts see, which are
          // retained: columns of H elsewhere are empty.
          const Matrix all =
            H.middleCols(own.begin(body), condensed.n_own(body));
          Triplets entries;
          for (std::size_t k = 0; k < part.retained.size(); ++k)
            for (Matrix::InnerIterator it(all, part.retained[k]); it; ++it)
              entries.emplace_back(it.row(), static_cast<Index>(k), it.value());
          Matrix rows(H.rows(), static_cast<Index>(part.retained.size()));
          rows.setFromTriplets(entries.begin(), entries.end());
          // Rows have few entries: H P costs as much as P has columns for each
          // of them, and the product with H^T no more.
          const MatrixXd half = rows * part.element->flexibility();
          W.noalias() += half * rows.transpose();
        }
    // Both triangles alike: the two products round differently.
    return .5 * (W + W.transpose());
  }
} // namespace conetact::contact
