// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/reach.h"

#include "conetact/solvers/column_groups.h"
#include "conetact/solvers/cone.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace conetact::solvers
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    /**
     * Projection on a friction cone and one element of its derivative. On the
     * mantle, with e = x_t / |x_t| and the ray (mu e, 1), the value is
     * h (mu e, 1), h = (mu |x_t| + x_n) / (1 + mu^2), and the derivative
     * ray ray^T / (1 + mu^2) + mu h / |x_t| (I - e e^T) in tangents.
     */
    void
    project_node(const SmallVector &x,
                 const double       mu,
                 SmallVector       &value,
                 SmallMatrix       &derivative)
    {
      const Index  t = x.size() - 1;
      const double a = x.head(t).norm(), n = x[t];
      derivative.setZero(t + 1, t + 1);
      value.setZero(t + 1);
      // A half space of reactions, or a half line.
      if (mu == no_slip_friction || mu == 0)
        {
          derivative.topLeftCorner(t, t).diagonal().setConstant(mu == 0 ? 0 :
                                                                          1);
          derivative(t, t) = n > 0 ? 1 : 0;
          value            = derivative * x;
        }
      else if (a <= mu * n)
        {
          derivative.setIdentity(t + 1, t + 1);
          value = x;
        }
      else if (mu * a > -n) // the mantle
        {
          const double      height = (mu * a + n) / (1 + mu * mu);
          const SmallVector e      = x.head(t) / a;
          SmallVector       ray(t + 1);
          ray << mu * e, 1;
          value      = height * ray;
          derivative = ray * ray.transpose() / (1 + mu * mu);
          derivative.topLeftCorner(t, t) +=
            mu * height / a * (SmallMatrix::Identity(t, t) - e * e.transpose());
        }
    }



    /** Projection on what a node bears, -pull <= r_n <= push and |r_t| <=
     * radius, and its derivative. */
    void
    project_on_cylinder(const SmallVector &x,
                        const Holding     &holding,
                        const Index        i,
                        SmallVector       &value,
                        SmallMatrix       &derivative)
    {
      const double radius = holding.friction[i];
      const Index  t      = x.size() - 1;
      const double a      = x.head(t).norm();
      derivative.setIdentity(t + 1, t + 1);
      value = x;
      if (a > radius)
        {
          const SmallVector e = x.head(t) / a;
          value.head(t)       = radius * e;
          derivative.topLeftCorner(t, t) =
            radius / a * (SmallMatrix::Identity(t, t) - e * e.transpose());
        }
      if (x[t] > -holding.pull[i] && x[t] < holding.push[i])
        return;
      derivative(t, t) = 0;
      value[t]         = std::clamp(x[t], -holding.pull[i], holding.push[i]);
    }

    /** Of a node's reaction, and its derivative. */
    using Projection = std::function<
      void(const SmallVector &, const Index, SmallVector &, SmallMatrix &)>;

    /**
     * One proximal step: z = c + R^T P(r - sigma R z), which says that the
     * gradient vanishes of
     * |z|^2 / 2 - c.z + |P(r - sigma R z)|^2 / (2 sigma), strongly convex in z.
     * Its semismooth Hessian is I + sigma R^T P' R, of the size of the motions.
     * Writes the new r = P(r - sigma R z).
     */
    class ProximalStep
    {
    public:
      ProximalStep(const ContactSystem &layout,
                   const MatrixXd      &null_space,
                   const VectorXd      &load,
                   const Projection    &on_set)
        : system(layout)
        , R(null_space)
        , c(load)
        , project(on_set)
        , groups(column_groups(R, nodes_of(layout)))
        , hessians(groups.size())
      {
        for (std::size_t g = 0; g < groups.size(); ++g)
          for (const Index i : groups[g].blocks)
            rows.push_back(
              R(Eigen::seq(system.first[i], system.first[i + 1] - 1),
                groups[g].columns));
      }

      void
      solve(const double sigma, VectorXd &z, VectorXd &r)
      {
        const VectorXd old = r;
        evaluate(sigma, old, z);
        for (unsigned int i = 0; i < 50; ++i)
          {
            const double size = gradient.norm();
            // c has the length one, and r is a sum with sigma R z.
            if (size <= 2e-15 * (1 + sigma * z.norm()))
              break;
            const VectorXd step  = newton_step();
            const double   slope = gradient.dot(step);
            const double   start = value;
            const VectorXd from  = z;
            for (double tau = 1; tau > 1e-12; tau *= .5)
              {
                z = from + tau * step;
                evaluate(sigma, old, z);
                // Near the end the value is round-off, the gradient is not.
                if (value <= start + 1e-4 * tau * slope ||
                    gradient.norm() <= .5 * size)
                  break;
              }
            if (-slope <= 1e-14 * start && gradient.norm() > .5 * size)
              break; // round-off
          }
        r = projected;
      }

    private:
      VectorXd
      newton_step() const
      {
        VectorXd step(gradient.size());
        for (std::size_t g = 0; g < groups.size(); ++g)
          step(groups[g].columns) =
            -hessians[g].ldlt().solve(gradient(groups[g].columns));
        return step;
      }

      /** Of each group of motions by itself: what does not meet has no part in
       * the Hessian of the other. */
      void
      evaluate(const double sigma, const VectorXd &r, const VectorXd &z)
      {
        VectorXd x = r;
        projected.setZero(x.size());
        gradient               = z - c;
        std::size_t       next = 0; // of `rows`
        std::vector<bool> done(static_cast<std::size_t>(system.n_nodes()));
        for (std::size_t g = 0; g < groups.size(); ++g)
          {
            const std::vector<Index> &columns = groups[g].columns;
            const VectorXd            own     = z(columns);
            VectorXd                  pushed  = VectorXd::Zero(own.size());
            // P' of a projection is semidefinite: I + sigma R^T P' R can be
            // inverted wherever z is.
            hessians[g] = MatrixXd::Identity(own.size(), own.size());
            for (const Index i : groups[g].blocks)
              {
                const MatrixXd &seen = rows[next++];
                x.segment(system.first[i], seen.rows()) -= sigma * (seen * own);
                project_one(i, x);
                done[static_cast<std::size_t>(i)] = true;
                if (value_of_node.isZero(0))
                  continue;
                pushed.noalias() += seen.transpose() * value_of_node;
                hessians[g].noalias() +=
                  sigma * seen.transpose() * (derivative * seen).eval();
              }
            gradient(columns) -= pushed;
          }
        for (Index i = 0; i < system.n_nodes(); ++i)
          if (!done[static_cast<std::size_t>(i)]) // no motion moves it
            project_one(i, x);
        value = .5 * z.squaredNorm() - c.dot(z) +
                (2 * x - projected).dot(projected) / (2 * sigma);
      }

      void
      project_one(const Index i, const VectorXd &x)
      {
        const Index begin = system.first[i], size = system.first[i + 1] - begin;
        project(x.segment(begin, size), i, value_of_node, derivative);
        projected.segment(begin, size) = value_of_node;
      }

      const ContactSystem &system;
      const MatrixXd      &R;
      const VectorXd      &c;
      const Projection    &project;

      const std::vector<ColumnGroup> groups;
      std::vector<MatrixXd> rows; ///< of R, of each group's nodes and motions
      std::vector<MatrixXd> hessians; ///< of groups
      VectorXd              projected, gradient;
      SmallVector           value_of_node;
      SmallMatrix           derivative;
      double                value = 0;
    };

    /**
     * Proximal points: r minimises |R^T r + c|^2 / 2 + |r - old|^2 / (2 sigma)
     * over a set, with `project` on it in units of |c|. It ends where z is zero
     * to ten times the precision, over c, or where r changes no more.
     */
    Reach
    nearest(const ContactSystem &layout,
            const MatrixXd      &R,
            const VectorXd      &c,
            const Projection    &project,
            const double         precision)
    {
      const double size = c.norm();
      if (!(size > 0))
        return {c, VectorXd::Zero(R.rows())};
      const VectorXd unit = c / size;
      Reach          result{unit, VectorXd::Zero(R.rows())};
      ProximalStep   step(layout, R, unit, project);
      VectorXd      &z = result.z, &r = result.r;
      double         sigma = 1;
      for (unsigned int i = 0; i < 60; ++i)
        {
          const VectorXd old = r;
          step.solve(sigma, z, r);
          // That is by how much z fails to prove that it is the nearest.
          const double error = (r - old).norm() / sigma;
          if (z.norm() <= 10 * precision || error <= precision * z.norm())
            break;
          // Speed grows with sigma, but r - sigma R z cancels once sigma |z| is
          // large beside r: a thousand at most.
          sigma = std::min(10 * sigma, 1e3 / z.norm());
        }
      return {size * z, size * r};
    }
  } // namespace



  Reach
  nearest_reach(const ContactSystem &layout,
                const MatrixXd      &R,
                const VectorXd      &c,
                const VectorXd      &mu)
  {
    eigen_assert(R.cols() == c.size());
    eigen_assert(mu.size() == layout.n_nodes());
    // Cones are the same in all units.
    const auto on_cone = [&](const SmallVector &x,
                             const Index        i,
                             SmallVector       &value,
                             SmallMatrix       &derivative) {
      project_node(x, mu[i], value, derivative);
    };
    return nearest(layout, R, c, on_cone, 1e-14);
  }



  Reach
  nearest_reach(const ContactSystem &layout,
                const MatrixXd      &R,
                const VectorXd      &c,
                const Holding       &holding)
  {
    eigen_assert(R.rows() == layout.n_contact_unknowns());
    eigen_assert(R.cols() == c.size());
    eigen_assert(holding.friction.size() == layout.n_nodes());
    eigen_assert(holding.pull.size() == layout.n_nodes());
    eigen_assert(holding.push.size() == layout.n_nodes());
    const double  size        = std::max(c.norm(), 1e-300);
    const Holding scaled      = {holding.friction / size,
                                 holding.pull / size,
                                 holding.push / size};
    const auto    on_cylinder = [&](const SmallVector &x,
                                 const Index        i,
                                 SmallVector       &value,
                                 SmallMatrix       &derivative) {
      project_on_cylinder(x, scaled, i, value, derivative);
    };
    // what reactions allow is not exact
    return nearest(layout, R, c, on_cylinder, 1e-10);
  }
} // namespace conetact::solvers
