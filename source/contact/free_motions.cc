// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/free_motions.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace conetact::contact
{
  FreeMotions::FreeMotions(const ElasticSystem   &e,
                           const RigidMotions    &m,
                           const BodyCoordinates &o)
    : elastic(e)
    , motions(m)
    , own(o)
  {
    find();
  }

  /* R of each body in its own unknowns, and the forces K_s R by which
     foundations resist. */
  void
  FreeMotions::find()
  {
    const auto &of_body = motions.body_of_own();
    all.resize(elastic.bodies.names.size());
    n_of_elastic =
      std::count_if(of_body.begin(), of_body.end(), [&](const unsigned int b) {
        return !elastic.bodies.is_rigid(b);
      });
    for (unsigned int body = 0; body < all.size(); ++body)
      {
        OfBody     &own_motions = all[body];
        const Index n           = own.end(body) - own.begin(body);
        const auto  begin = std::find(of_body.begin(), of_body.end(), body);
        const Index k     = std::count(of_body.begin(), of_body.end(), body);
        own_motions.first = begin - of_body.begin();
        // Rigid bodies have no own unknowns: R has no rows, and add_to() leaves
        // them to CondensedCompliance::assemble_all().
        own_motions.R.resize(n, k);
        own_motions.spring_forces.setZero(n, k);
        own_motions.Y = own_motions.spring_forces;
        for (Index j = 0; j < k; ++j)
          {
            const VectorXd u =
              motions.field(motions.own().col(own_motions.first + j));
            own_motions.R.col(j) = own.values(u).segment(own.begin(body), n);
            own_motions.spring_forces.col(j) =
              own.restrict(elastic.spring_forces(u))
                .segment(own.begin(body), n);
          }
      }
  }

  /* Foundations push back against a motion, and the body deforms under that: Y
     = -P K_s R. */
  void
  FreeMotions::respond(const CondensedBodies &bodies)
  {
    for (const CondensedBodies::Part &part : bodies.parts())
      for (const unsigned int body : part.bodies)
        {
          OfBody &m = all[body];
          m.Y       = m.spring_forces.isZero(0) ?
                        MatrixXd(MatrixXd::Zero(m.R.rows(), m.R.cols())) :
                        MatrixXd(part.element->deform(-m.spring_forces));
        }
  }

  /* G = H (R + Y) and C = R^T K_s (R + Y): a motion of amount a moves contacts
     by R a, and by Y a, what foundations K_s deform the body by as they
     resist. */
  void
  FreeMotions::add_to(const Eigen::SparseMatrix<double> &H,
                      MatrixXd                          &relation) const
  {
    const Index n = H.rows();
    AssertDimension(relation.rows(), n + motions.own().cols());
    for (unsigned int body = 0; body < all.size(); ++body)
      {
        const OfBody &m     = all[body];
        const Index   first = n + m.first, size = m.R.cols();
        if (m.R.size() == 0)
          continue;
        const MatrixXd G =
          H.middleCols(own.begin(body), m.R.rows()) * (m.R + m.Y);
        relation.block(0, first, n, size) = G;
        relation.block(first, 0, size, n) = -G.transpose();
        // R^T K_s R + R^T K_s Y, as Y^T K_s R = -R^T K_s P K_s R is symmetric.
        const MatrixXd C = (m.R + m.Y).transpose() * m.spring_forces;
        // Foundations hold each body by itself: C has a block for each.
        relation.block(first, first, size, size) = .5 * (C + C.transpose());
      }
  }

  template <typename Value>
  Eigen::VectorXd
  FreeMotions::against(const VectorXd &forces, const Value &value) const
  {
    AssertDimension(forces.size(), own.n_unknowns());
    VectorXd result = VectorXd::Zero(motions.own().cols());
    for (unsigned int body = 0; body < all.size(); ++body)
      if (const OfBody &m = all[body]; m.R.size() > 0)
        result.segment(m.first, m.R.cols()) =
          value(m, forces.segment(own.begin(body), m.R.rows()));
    return result;
  }

  /* -(R + Y)^T f: forces f drive motions, and by Y^T f = -R^T K_s P f by what
     they press into the foundations. */
  Eigen::VectorXd
  FreeMotions::imbalance(const VectorXd &forces) const
  {
    return against(forces, [](const OfBody &m, const auto &f) -> VectorXd {
      return -(m.R + m.Y).transpose() * f;
    });
  }

  /* What imbalance() sums up, in magnitudes: the rounding of that sum is a part
     of this one. */
  Eigen::VectorXd
  FreeMotions::size_of_terms(const VectorXd &forces) const
  {
    return against(forces, [](const OfBody &m, const auto &f) -> VectorXd {
      return (m.R + m.Y).cwiseAbs().transpose() * f.cwiseAbs();
    });
  }

  /* R^T f without Y: by rigid motions alone, where nothing may be carried by
     foundations. */
  Eigen::VectorXd
  FreeMotions::resultants(const VectorXd &forces) const
  {
    return against(forces, [](const OfBody &m, const auto &f) -> VectorXd {
      return m.R.transpose() * f;
    });
  }

  /* Rigid bodies have no own unknowns: forces on all dofs are asked. */
  Eigen::VectorXd
  FreeMotions::rigid_imbalance(const VectorXd &forces) const
  {
    VectorXd    sum = VectorXd::Zero(motions.own().cols());
    const Index n   = motions.own().cols() - n_of_elastic;
    if (n > 0)
      sum.tail(n) =
        -motions.own().rightCols(n).transpose() * motions.resultants(forces);
    return sum;
  }

  /* K_s R a: by what foundations push back against motions a. */
  Eigen::VectorXd
  FreeMotions::resistance(const VectorXd &amounts) const
  {
    AssertDimension(amounts.size(), motions.own().cols());
    VectorXd forces = VectorXd::Zero(own.n_unknowns());
    for (unsigned int body = 0; body < all.size(); ++body)
      if (const OfBody &m = all[body]; m.R.size() > 0)
        forces.segment(own.begin(body), m.R.rows()) =
          m.spring_forces * amounts.segment(m.first, m.R.cols());
    return forces;
  }

  /* A body by itself, as if nothing joined it: its own motions that are nearest
     to w. */
  RigidMotions::Amounts
  motions_with(const RigidMotions    &motions,
               RigidMotions::Amounts  amounts,
               const Eigen::VectorXd &w)
  {
    const RigidMotions::Amounts products = motions.products(w);
    const auto                 &body_of  = motions.body_of_own();
    AssertDimension(amounts.size(), products.size());
    for (std::size_t first = 0, end = 0; first < body_of.size(); first = end)
      {
        const unsigned int body = body_of[first];
        while (end < body_of.size() && body_of[end] == body)
          ++end;
        const Eigen::MatrixXd squares = motions.squares(body);
        const Eigen::Index    n       = squares.rows();
        const Eigen::MatrixXd own =
          motions.own().block(body * n,
                              static_cast<Eigen::Index>(first),
                              n,
                              static_cast<Eigen::Index>(end - first));
        amounts.segment(body * n, n) +=
          own * (own.transpose() * squares * own)
                  .ldlt()
                  .solve(own.transpose() * products.segment(body * n, n));
      }
    return amounts;
  }
} // namespace conetact::contact
