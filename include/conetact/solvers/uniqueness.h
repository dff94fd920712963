// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_uniqueness_h
#define conetact_solvers_uniqueness_h

#include "conetact/solvers/contact_problem.h"

#include <memory>
#include <optional>

namespace conetact::solvers
{
  /**
   * Whether an increment has one solution. With two, of displacements that
   * differ by x, reactions by K x,
   * @f[ x^T K x \le \sum_i \mu_i |(K x)_{n,i}|\,|x_{t,i}| , @f]
   * for the law of friction is monotone but for its dependence on r_n. So there
   * is one at most where
   * @f[ K - \frac c2 \sum_i \mu_i \left(s_i (K e_{n,i}) (K e_{n,i})^T +
   *     \frac 1{s_i} \sum_t e_{t,i} e_{t,i}^T\right) @f]
   * is positive definite with c = 1 and any s > 0, which a Cholesky factor
   * shows. For one node the proof ends at
   * @f$\mu = 2\sqrt{k_{tt} k_{nn} - k_{tn}^2}/k_{nn}@f$.
   */
  class UniquenessCheck
  {
  public:
    explicit UniquenessCheck(std::shared_ptr<const ContactSystem> system);

    /** Up to which factor on all coefficients the proof holds, whatever the
     * load; infinite without friction. None where bodies float or contacts are
     * redundant, and of more than `most` unknowns. */
    std::optional<double>
    proof_factor() const
    {
      return factor;
    }

    /** The coefficients that they are factors of. */
    const Eigen::VectorXd &
    mu() const
    {
      return system->mu;
    }

    static constexpr Eigen::Index most = 2000;

  private:
    /** Whether K - c M is positive definite, beyond rounding. */
    bool
    holds(const double c, const Eigen::MatrixXd &M) const;
    Eigen::VectorXd
    balanced(Eigen::VectorXd s) const;
    Eigen::VectorXd
    perturb(const Eigen::VectorXd &s, const Eigen::VectorXd &x) const;
    /** M of these weights, and (next) M x. */
    Eigen::MatrixXd
    perturbation(const Eigen::VectorXd &s) const;
    double
    find_factor() const;

    std::shared_ptr<const ContactSystem> system;
    Eigen::MatrixXd                      K;
    std::optional<double>                factor;
  };

  /** What a search for another solution of an increment has found. */
  struct AnotherSearch
  {
    std::optional<ContactState> other;
    bool                        is_complete = false; ///< there is no other one
    std::size_t                 n_tried     = 0;     ///< sets of states
  };
  /** Another solution than `state`: in the plane of all of them, else from some
   * starts. */
  AnotherSearch
  find_another(const ContactProblem &problem,
               const ContactState   &state,
               const double          tolerance);
} // namespace conetact::solvers

#endif
