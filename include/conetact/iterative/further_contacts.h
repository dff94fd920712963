// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_iterative_further_contacts_h
#define conetact_iterative_further_contacts_h

#include "conetact/solvers/contact_problem.h"
#include "conetact/solvers/large_system.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace conetact::iterative
{
  /**
   * Contacts of nodes whose unknowns have the axes of another contact. They see
   * H u of these unknowns, and act on them by H^T r. Of some a part of the law
   * is a stiffness S, which is the system's: its matrix is K + H^T S H, which
   * bodies that nothing else holds do not make singular.
   */
  struct FurtherContacts
  {
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    Rows                   H;      ///< of their unknowns, node by node
    Eigen::VectorXd        S;      ///< of each row, 0: none [force/length]
    solvers::ContactSystem layout; ///< of all contact nodes
    /** Numbers of contact nodes: those of the system without these, and
     * these. */
    std::vector<Eigen::Index> own, further;

    /** Where their displacements are in those of all contact nodes. */
    std::vector<Eigen::Index>
    unknowns_of(const std::vector<Eigen::Index> &nodes) const;
    /** All unknowns with those of these contacts: the system's but for contact,
     * reactions r, contact. Of displacements u of the system, r = 0; */
    Eigen::VectorXd
    with_displacements(const Eigen::VectorXd &u) const;
    /** of forces; */
    Eigen::VectorXd
    with_forces(const Eigen::VectorXd &f) const;
    /** and back. */
    Eigen::VectorXd
    without(const Eigen::VectorXd &x) const;
    /** Their reactions in all unknowns. */
    Eigen::VectorXd
    reactions(const Eigen::VectorXd &x) const;

  private:
    Eigen::VectorXd
    join(const Eigen::VectorXd &u, const Eigen::VectorXd &v) const;
  };

  /**
   * A system with further contacts; `system` has H^T S H. Of its
   * unknowns (u, r, v) r and v are their reactions and displacements,
   * @f$K u - H^T r@f$ what the other contacts and loads balance, @f$v = H u@f$
   * an equation. As r + S v changes, u follows by a solution of `system`: laws
   * of these contacts are solved for it by GMRES, each iteration of which takes
   * such a solution. That is for few such nodes, or for many that see little of
   * each other; a law r = -S v is known beforehand.
   */
  std::shared_ptr<const solvers::LargeSystem>
  make_with_further_contacts(std::shared_ptr<const solvers::LargeSystem> system,
                             FurtherContacts                             given);
} // namespace conetact::iterative

#endif
