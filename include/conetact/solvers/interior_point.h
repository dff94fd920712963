// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_interior_point_h
#define conetact_solvers_interior_point_h

#include "conetact/solvers/cone.h"
#include "conetact/solvers/large_factor.h"
#include "conetact/solvers/sparse_relation.h"

#include <vector>

namespace conetact::solvers
{
  /**
   * Primal-dual interior point method for redundant contacts: where W is
   * singular the reactions are not unique, states cannot be read off them, and
   * active sets cycle. Interior points go to the middle of the set of
   * solutions, and every matrix on the way is regular whatever the rank of W.
   *
   * With @f$x = (\mu r_n, r_t)@f$ and
   * @f$z = (g/\mu + |\Delta u_t|, \Delta u_t)@f$ the law says that x and z are
   * complementary in the second-order cone (de Saxcé and Feng, Math. Comput.
   * Modelling 28 (1998) 225-245), and the relation is
   * @f$z - |z_t| e_n = \hat W x + \hat q@f$. Newton's method on the relation
   * and on @f$x \circ z = \sigma m e@f$, scaled after Nesterov and Todd, with
   * the predictor and corrector of Mehrotra, has the matrix
   * @f$\hat W + (I - e_n \tau^T) P@f$ with P the scaling and
   * @f$\tau = z_t/|z_t|@f$, sparse if W is (Acary, Armand, Nguyen, Shpakovych:
   * Second-order cone programming for frictional contact mechanics using
   * interior point algorithm, Optim. Methods Softw. 39 (2024)). Without
   * @f$\tau@f$ the term |z_t| lags a step behind: slower, sometimes more
   * robust.
   */
  class InteriorPoint
  {
  public:
    using Index = Eigen::Index;
    using Array = Eigen::VectorXd;

    /** The relation must outlive the iteration. */
    InteriorPoint(const SparseRelation &relation, const bool coupled);

    /** One step; false if there is none. */
    bool
    step();

    /** Reactions without units, as in LinearRelation. */
    Array
    reactions() const;

    /** Mean product of x and z, which goes to zero with the error. */
    double
    complementarity() const
    {
      return x.dot(z) / static_cast<double>(cones.size());
    }
    /** Norm of what is left of the relation. */
    double
    defect() const
    {
      return residual.norm();
    }

  private:
    /** A cone at rows first, ... of x and z, and what belongs to it. */
    struct Cone
    {
      Index       first, size;
      SmallMatrix P;        ///< scaling: P x = z
      SmallMatrix root;     ///< its square root
      SmallMatrix coupling; ///< I - e_n tau^T
    };

    void
    collect();
    void
    start();
    void
    scale_cones();
    void
    measure();
    double
    smoothing() const;
    bool
    factorize();
    void
    direction(const Array &h, const double share, Array &dx, Array &dz) const;
    Array
    targets(const double sigma_m, const Array &dx, const Array &dz) const;
    double
    longest(const Array &dx, const Array &dz) const;

    const SparseRelation       &relation;
    const bool                  coupled;
    std::vector<Cone>           cones;
    std::vector<Index>          where;  ///< unknown of each row
    Array                       weight; ///< r = weight x
    Eigen::SparseMatrix<double> W;
    Array                       q, x, z, residual;
    LargeFactor                 factor;
  };
} // namespace conetact::solvers

#endif
