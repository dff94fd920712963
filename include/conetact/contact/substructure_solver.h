// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_substructure_solver_h
#define conetact_contact_substructure_solver_h

#include "conetact/contact/schur_solver.h"

namespace conetact
{
  /**
   * A matrix in unknowns of its own, p = T q, that stands once or several times
   * in a larger one, @f$ A = \sum T^T A_p T @f$.
   */
  struct Substructure
  {
    using Map = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    Eigen::SparseMatrix<double> upper;   ///< upper triangle of A_p
    std::vector<unsigned int>   node_of; ///< of each p
    std::vector<Map>            uses;    ///< T of each; none: A is A_p
  };

  /** A as the sum of its parts. */
  struct Substructures
  {
    std::vector<Substructure> parts;
    std::vector<unsigned int> node_of;     ///< of each q
    Eigen::Index              n_schur = 0; ///< the last q are C
  };

  /**
   * A SchurSolver that factorises a substructure used several times once.
   * Those p that the unknowns C or several uses see are its interface, to which
   * it is condensed: S. The sum of all @f$T^T S T@f$ is a matrix in the
   * unknowns C and, where uses meet, in others E, which a second SchurSolver
   * eliminates. A single part that is A itself is not divided.
   */
  class SubstructureSolver
  {
  public:
    /**
     * Columns of a map that meet no interface must be orthogonal. Throws
     * SingularMatrix, std::bad_alloc.
     */
    explicit SubstructureSolver(const Substructures &substructures);
    static FactorEstimate
    estimate(const Substructures &substructures);
    /** The part of it that goes into the sum; nothing is ordered for it. */
    static FactorEstimate
    estimate_sum(const Substructures &substructures);

    Eigen::Index
    n_unknowns() const
    {
      return n;
    }

    /** As those of SchurSolver. */
    Eigen::MatrixXd
    take_schur_complement();
    Eigen::MatrixXd
    reduce(const Eigen::MatrixXd &b) const;
    Eigen::MatrixXd
    expand(const Eigen::MatrixXd &b, const Eigen::MatrixXd &u_C) const;

    /** Sums over the factors at hand. */
    double
    factor_bytes() const;
    double
    factor_operations() const;
    /** With the factors of the parts. */
    SchurWork
    work() const;

    /** Uses of substructures that are not the first. */
    unsigned int
    n_shared() const
    {
      return n_repeated;
    }

  private:
    /** Inside a use p = inside^-T q, at its interface p = interface q_EC. */
    struct Member
    {
      Substructure::Map inside, interface;
    };
    struct Part
    {
      std::unique_ptr<SchurSolver> solver;
      std::vector<Member>          members;
    };
    /** What acts on the uses of a part, one column each. */
    struct Columns
    {
      std::vector<std::pair<const Member *, Eigen::Index>> origin;
      Eigen::MatrixXd loads, displacements; ///< of all p, of the interface
    };

    bool
    is_whole() const
    {
      return sum == nullptr;
    }
    static Columns
    loaded_columns(const Part            &part,
                   const Eigen::MatrixXd &b,
                   const Eigen::MatrixXd &u);
    /** b_EC less what the loads inside pass on. */
    Eigen::MatrixXd
    condensed_forces(const Eigen::MatrixXd &b) const;

    Eigen::Index                 n;
    std::vector<Eigen::Index>    kept; ///< unknowns q that are (E, C)
    Eigen::Index                 n_E        = 0;
    unsigned int                 n_repeated = 0;
    std::vector<Part>            parts;
    std::unique_ptr<SchurSolver> sum; ///< of interfaces; none: A is whole
  };
} // namespace conetact

#endif
