// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_direct_system_h
#define conetact_iterative_direct_system_h

#include "conetact/iterative/elements.h"
#include "conetact/solvers/contact_problem.h"
#include "conetact/solvers/local_system.h"

#include <Eigen/SparseCore>

namespace conetact::iterative
{
  /**
   * A system of few unknowns, such as that of a frame, whose matrix each Newton
   * step factorises with the laws of its nodes. In double precision: the
   * stiffness of slender members spans more digits than single precision has.
   */
  class DirectSystem : public solvers::LocalSystem
  {
  public:
    /** The unknowns of contact are the last ones of n. */
    DirectSystem(const Elements          &elements,
                 solvers::ContactSystem &&contact,
                 const Index              n);

    Index
    n_unknowns() const override
    {
      return K.rows();
    }
    Kept
    multiply(const Kept &u) const override
    {
      return keep(K * array(u));
    }
    Array
    diagonal() const override
    {
      return K.diagonal();
    }
    std::optional<Step>
    solve(const std::vector<solvers::NodeLaw> &laws,
          const Kept                          &f,
          const Precision                     &precision) const override;

  protected:
    Index
    n_contact_unknowns() const override
    {
      return layout.n_unknowns();
    }

  private:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    Matrix
    newton_matrix(const std::vector<solvers::NodeLaw> &laws) const;

    Matrix                       K;
    const solvers::ContactSystem layout; ///< of the last unknowns
  };
} // namespace conetact::iterative

#endif
