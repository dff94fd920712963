// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/interior_point.h"

#include <algorithm>
#include <cmath>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /** Share of the way to the boundary of the cones. */
    constexpr double stay_inside = .99;

    /** z_0^2 - |z_1|^2 without cancellation of squares. */
    double
    determinant(const SmallVector &z)
    {
      const double tail = z.tail(z.size() - 1).norm();
      return (z(0) - tail) * (z(0) + tail);
    }

    /**
     * The product of the cone's algebra: with x and z in the cone, x o z = 0
     * says that they are complementary.
     */
    SmallVector
    jordan_product(const SmallVector &a, const SmallVector &b)
    {
      SmallVector result = a(0) * b + b(0) * a;
      result(0)          = a.dot(b);
      return result;
    }

    /** y with a o y = b. */
    SmallVector
    jordan_quotient(const SmallVector &a, const SmallVector &b)
    {
      const Index       n = a.size() - 1;
      const SmallVector t = a.tail(n);
      SmallVector       y(n + 1);
      y(0)      = (a(0) * b(0) - t.dot(b.tail(n))) / determinant(a);
      y.tail(n) = (b.tail(n) - y(0) * t) / a(0);
      return y;
    }

    /** Largest step, or 2 if that is less, for which z + step dz stays in the
     * cone. */
    double
    longest_in_cone(const SmallVector &z, const SmallVector &dz)
    {
      const Index  n      = z.size() - 1;
      const double a      = determinant(dz);
      const double b      = z(0) * dz(0) - z.tail(n).dot(dz.tail(n));
      const double c      = std::max(determinant(z), 0.);
      double       result = 2;
      if (dz(0) < 0)
        result = -z(0) / dz(0);
      // The determinant of z + s dz vanishes where the ray meets the mantle.
      // c + 2 b s + a s^2 = 0
      const double d = b * b - a * c;
      if (n > 0 && d >= 0 && (b < 0 || a < 0))
        {
          const double root =
            // The smaller positive root has two forms: this one does not
            // cancel.
            b < 0 ? c / (-b + std::sqrt(d)) : (-b - std::sqrt(d)) / a;
          if (root >= 0)
            result = std::min(result, root);
        }
      return result;
    }
  } // namespace



  InteriorPoint::InteriorPoint(const SparseRelation &sparse_relation,
                               const bool            with_coupling)
    : relation(sparse_relation)
    , coupled(with_coupling)
  {
    collect();
    start();
    measure();
  }



  /* The normal comes first in a cone; contacts without friction have only
     this. W and q are scaled such that the cones are round. */
  void
  InteriorPoint::collect()
  {
    const ContactSystem &system = relation.relation.system();
    std::vector<double>  weights;
    for (Index i = 0; i < system.n_nodes(); ++i)
      {
        const double mu = system.mu(i);
        const Index  nt = mu > 0 ? system.n_tangents(i) : 0;
        Cone         cone;
        cone.first = static_cast<Index>(where.size());
        cone.size  = nt + 1;
        cones.push_back(cone);
        where.push_back(system.normal(i));
        weights.push_back(nt > 0 ? 1 / mu : 1.);
        for (Index k = 0; k < nt; ++k)
          {
            where.push_back(system.first[i] + k);
            weights.push_back(1);
          }
      }
    weight = Eigen::Map<const VectorXd>(weights.data(),
                                        static_cast<Index>(weights.size()));

    std::vector<Index> row(static_cast<std::size_t>(system.n_unknowns()), -1);
    for (std::size_t k = 0; k < where.size(); ++k)
      row[static_cast<std::size_t>(where[k])] = static_cast<Index>(k);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < where.size(); ++k)
      for (SparseRelation::Matrix::InnerIterator e(relation.M, where[k]); e;
           ++e)
        if (const Index i = row[static_cast<std::size_t>(e.row())]; i >= 0)
          entries.emplace_back(static_cast<int>(i),
                               static_cast<int>(k),
                               weight(i) * e.value() *
                                 weight(static_cast<Index>(k)));
    // Blocks of the cones always have their place.
    for (const Cone &cone : cones)
      for (Index i = 0; i < cone.size; ++i)
        for (Index j = 0; j < cone.size; ++j)
          entries.emplace_back(static_cast<int>(cone.first + i),
                               static_cast<int>(cone.first + j),
                               0.);
    W.resize(weight.size(), weight.size());
    W.setFromTriplets(entries.begin(), entries.end());
    q = weight.cwiseProduct(relation.relation.load()(where));
  }



  /* In the middle of the cones, off their boundary by the size of the data. The
     relation need not hold there: steps reduce its residual as well. */
  void
  InteriorPoint::start()
  {
    x = z             = Array::Zero(q.size());
    const double size = std::max(1., q.lpNorm<Eigen::Infinity>());
    for (const Cone &cone : cones)
      x(cone.first) = z(cone.first) = size;
  }



  InteriorPoint::Array
  InteriorPoint::reactions() const
  {
    Array r  = Array::Zero(relation.M.cols());
    r(where) = weight.cwiseProduct(x);
    return r;
  }



  /** |z_t| is rounded off near zero, less and less. */
  double
  InteriorPoint::smoothing() const
  {
    return std::sqrt(std::max(0., complementarity()));
  }



  void
  InteriorPoint::measure()
  {
    const double m = smoothing();
    // z - |z_t| e_n = W x + q, with t^2 / hypot(t, m) for |z_t|: its derivative
    // has no jump at stick.
    residual = W * x + q - z;
    for (const Cone &cone : cones)
      {
        const double t = z.segment(cone.first + 1, cone.size - 1).norm();
        if (t > 0)
          residual(cone.first) += t * t / std::hypot(t, m);
      }
  }



  void
  InteriorPoint::scale_cones()
  {
    const double m = smoothing();
    for (Cone &cone : cones)
      {
        const Index       n  = cone.size - 1;
        const SmallVector xc = x.segment(cone.first, cone.size),
                          zc = z.segment(cone.first, cone.size);
        const double dx      = std::sqrt(determinant(xc)),
                     dz      = std::sqrt(determinant(zc));
        // Nesterov and Todd: P is the symmetric map of the cone onto itself
        // with P x = z. With x and z of determinant 1 and J = diag(1, -1, -1)
        // it is 2 w w^T - J, w the middle between z and J x.
        SmallVector w = xc / dx;
        w.tail(n) *= -1;
        w += zc / dz;
        w /= std::sqrt(2 * (1 + xc.dot(zc) / (dx * dz)));
        const SmallVector t = w.tail(n);

        cone.P = 2 * w * w.transpose();
        cone.P.diagonal().array() += 1;
        cone.P(0, 0) -= 2;
        cone.P *= dz / dx;
        // The root of 2 w w^T - J in closed form.
        cone.root.setIdentity(n + 1, n + 1);
        cone.root.col(0) = w;
        cone.root.row(0) = w.transpose();
        cone.root.bottomRightCorner(n, n) += t * t.transpose() / (1 + w(0));
        cone.root *= std::sqrt(dz / dx);

        cone.coupling.setIdentity(n + 1, n + 1);
        if (coupled && n > 0)
          {
            const double u = zc.tail(n).norm(), l = std::hypot(u, m);
            // the derivative of u^2 / l, divided by u
            const double slope = (u * u + 2 * m * m) / (l * l * l);
            cone.coupling.topRightCorner(1, n) =
              -slope * zc.tail(n).transpose();
          }
      }
  }



  /* (I - e_n tau^T) dz = W dx + residual and dz = h - P dx: dz drops out cone
     by cone, and what is left has the pattern of W and its blocks. */
  bool
  InteriorPoint::factorize()
  {
    Eigen::SparseMatrix<double> J = W;
    for (const Cone &cone : cones)
      {
        const SmallMatrix block = cone.coupling * cone.P;
        for (Index j = 0; j < cone.size; ++j)
          for (Index i = 0; i < cone.size; ++i)
            J.coeffRef(cone.first + i, cone.first + j) += block(i, j);
      }
    return factor.factorize(J);
  }



  /* dz = h - P dx in the relation. */
  void
  InteriorPoint::direction(const Array &h,
                           const double share,
                           Array       &dx,
                           Array       &dz) const
  {
    eigen_assert(h.size() == q.size());
    eigen_assert(share >= 0);
    Array b = -share * residual;
    for (const Cone &cone : cones)
      b.segment(cone.first, cone.size) +=
        cone.coupling * h.segment(cone.first, cone.size);
    dx = factor.solve(b);
    dz = h;
    for (const Cone &cone : cones)
      dz.segment(cone.first, cone.size) -=
        cone.P * dx.segment(cone.first, cone.size);
  }



  /* h of x o z = sigma m e, to second order where dx and dz are given. */
  InteriorPoint::Array
  InteriorPoint::targets(const double sigma_m,
                         const Array &dx,
                         const Array &dz) const
  {
    eigen_assert(dx.size() == dz.size());
    eigen_assert(dx.size() == 0 || dx.size() == q.size());
    Array h(q.size());
    for (const Cone &cone : cones)
      {
        // In the scaled space x and z are the same point lambda.
        const SmallVector lambda = cone.root * x.segment(cone.first, cone.size);
        SmallVector       aim    = -jordan_product(lambda, lambda);
        aim(0) += sigma_m;
        if (dx.size() > 0)
          {
            const SmallVector a = cone.root * dx.segment(cone.first, cone.size),
                              b = cone.root.inverse() *
                                  dz.segment(cone.first, cone.size);
            aim -= jordan_product(a, b);
          }
        h.segment(cone.first, cone.size) =
          cone.root * jordan_quotient(lambda, aim);
      }
    return h;
  }



  double
  InteriorPoint::longest(const Array &dx, const Array &dz) const
  {
    eigen_assert(dx.size() == x.size());
    eigen_assert(dz.size() == z.size());
    double result = 1 / stay_inside;
    for (const Cone &cone : cones)
      result = std::min({result,
                         longest_in_cone(x.segment(cone.first, cone.size),
                                         dx.segment(cone.first, cone.size)),
                         longest_in_cone(z.segment(cone.first, cone.size),
                                         dz.segment(cone.first, cone.size))});
    return stay_inside * result;
  }



  bool
  InteriorPoint::step()
  {
    const double m = complementarity();
    scale_cones();
    if (!(m > 0) || !factorize())
      return false;
    Array dx, dz;
    direction(targets(0, Array(), Array()), 1, dx, dz);
    if (!dx.allFinite() || !dz.allFinite())
      return false;
    // Mehrotra: the more of the way the predictor can go, the less the
    // corrector has to return to the middle.
    const double tau   = longest(dx, dz);
    const double sigma = std::max(std::pow(1 - std::min(tau, 1.), 3), 1e-4);
    // Where little of a step is possible its second order is of no use.
    if (tau < .1)
      dx = dz = Array();
    direction(targets(sigma * m, dx, dz), 1 - sigma, dx, dz);
    if (!dx.allFinite() || !dz.allFinite())
      return false;
    const double length = longest(dx, dz);
    x += length * dx;
    z += length * dz;
    measure();
    return length > 1e-8;
  }
} // namespace conetact::solvers
