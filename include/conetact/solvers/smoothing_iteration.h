// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_smoothing_iteration_h
#define conetact_solvers_smoothing_iteration_h

#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/newton_system.h"
#include "conetact/solvers/node_sets.h"

#include <vector>

namespace conetact::solvers
{
  /**
   * Smoothing and regularisation method for the second-order cone
   * complementarity form of friction, [K] (17): for each node
   * @f$x = (\lambda, \Delta u_t, g)@f$ and @f$y = (\mu r_n, r_t, r_n)@f$ are
   * complementary in (second-order cone) x (half line), @f$x - P(x - y) = 0@f$.
   * P is smoothed by m, the linear relation regularised by eps, and both follow
   * the residual to zero (Hayashi, Yamashita, Fukushima, SIAM J. Optim. 15
   * (2005) 593-615, algorithm 4.1). @f$\lambda@f$ and @f$\mu r_n@f$ are
   * eliminated node by node, so a step solves for the displacements (or
   * reactions) only. Nodes with mu = 0 have no cone.
   *
   * The iteration itself, which can be stopped and continued.
   */
  class SmoothingIteration
  {
  public:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    /** Starts from a state. */
    SmoothingIteration(const LinearRelation   &relation,
                       const SmoothingOptions &options,
                       const ContactState     &start);

    /**
     * Continues until the natural residual is below the target. False if it
     * has to give up; failure() then says why.
     */
    bool
    advance(const double target);

    void
    get(ContactState &state) const;

    /** Norm of the natural residual, with neither m nor eps. */
    double
    residual() const
    {
      return natural;
    }
    unsigned int
    n_iterations() const
    {
      return iterations;
    }
    unsigned int
    n_factorizations() const
    {
      return newton.n_factorizations();
    }
    const std::string &
    failure() const
    {
      return why;
    }

  private:
    /**
     * One point of the iteration; p and d as in LinearRelation, but p is v in
     * stiffness form.
     */
    struct Point
    {
      Array lambda, y; ///< one a node: lambda and the independent mu r_n
      Array p, d;
    };
    /** Residuals of the relation at a point, linear in the point. */
    struct Defect
    {
      Array relation; ///< n values
      Array y;        ///< one a node
    };

    /** A cone linearised, with what gives lambda and y back. */
    struct Cone
    {
      SmallMatrix C, D; ///< I - P' and P'
      SmallVector phi;  ///< x - P(x - y)
      double      pivot  = 0;
      bool        frozen = false; ///< lambda stays
    };
    /** Node i: A dv + B dr = h. */
    struct Law
    {
      SmallMatrix A, B;
      SmallVector h;
    };

    bool
    has_cone(const Index i) const;
    double
    normal_shift(const Index i) const;
    const Array &
    displacements(const Point &point) const;
    const Array &
    reactions(const Point &point) const;
    /** (lambda, u_t) and (mu r_n, r_t). */
    SmallVector
    cone_displacement(const Point &point, const Index i) const;
    SmallVector
    cone_reaction(const Point &point, const Index i) const;
    Defect
    defect(const Point &point) const;
    /** Residual of the cones of node i, smoothed or (m = 0) not. */
    double
    squared_cone_residual(const Point &point,
                          const Index  i,
                          const double m) const;
    double
    merit(const Point &point, const Defect &defect, const double m) const;
    void
    measure();
    double
    smallest_eigenvalue() const;
    bool
    step();
    Cone
    linearize_cone(const Index i) const;
    Law
    law_of(const Index i, const Cone &cone, const double y_defect) const;
    void
    recover(const std::vector<Cone> &cones,
            const Defect            &residual,
            Point                   &delta) const;
    bool
    direction(const Defect &residual, Point &delta);
    void
    shrink();

    const LinearRelation  &relation;
    const SmoothingOptions options;
    Array                  load; ///< d = M p + load
    NewtonSystem           newton;
    Point                  x;
    double                 m, eps, beta;
    double                 natural = 0;
    double                 best    = 0;
    unsigned int           outer = 0, stalls = 0;
    unsigned int           iterations = 0;
    bool                   inside     = false; ///< in the inner loop
    std::string            why;
  };
} // namespace conetact::solvers

#endif
