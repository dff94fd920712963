// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_bound_unknowns_h
#define conetact_contact_bound_unknowns_h

#include "conetact/contact/redundant_rows.h"

#include <Eigen/Dense>

#include <vector>

namespace conetact::contact
{
  /**
   * Ties and bilateral contacts, eliminated before a contact solver sees them.
   * Of the compliance form with all rows and all motions of the bodies by
   * themselves,
   * @f[ \begin{pmatrix} v_c\\ v_t\\ 0\end{pmatrix} =
   *     \begin{pmatrix} W_{cc} & W_{ct} & G_c\\ W_{tc} & W_{tt} & G_t\\
   *                     -G_c^T & -G_t^T & C\end{pmatrix}
   *     \begin{pmatrix} r_c\\ r_t\\ a\end{pmatrix} +
   *     \begin{pmatrix} q_c\\ q_t\\ -b\end{pmatrix}, @f]
   * rows t are equations, @f$v_t = 0@f$ with any @f$r_t@f$. Motions that bodies
   * have together, @f$a = N a_f + M a_t@f$, stay unknowns with a balance of
   * their own; @f$r_t@f$ and @f$a_t@f$ are solved for. What is left is the same
   * form in @f$(r_c, a_f)@f$. @f$G_t N = 0@f$ but for what foundations deform.
   *
   * Rows that others imply (a node in two ties, or held by a support as well)
   * are left out (RedundantRows). Of all reactions that do what the others do
   * the least are given: they do not depend on axes, units or the order of
   * rows. Whether what the rows left out ask for is fulfilled, the verification
   * finds out.
   */
  class BoundUnknowns
  {
  public:
    /** Nothing is bound: all stays as it is. */
    BoundUnknowns() = default;
    /**
     * `all`: the matrix above, of n_c and n_t rows of contacts; N and M:
     * orthonormal columns that span all motions together; `loose`: columns of
     * N that no foundation resists; `redundant`: of the rows t.
     */
    BoundUnknowns(const Eigen::MatrixXd           &all,
                  const Eigen::Index               n_c,
                  const Eigen::Index               n_t,
                  const Eigen::MatrixXd           &N,
                  const Eigen::MatrixXd           &M,
                  const std::vector<Eigen::Index> &loose,
                  RedundantRows                    redundant);

    const RedundantRows &
    redundant_rows() const
    {
      return redundant;
    }
    /** The matrix of (r_c, a_f). */
    const Eigen::MatrixXd &
    matrix() const
    {
      return kept;
    }
    /** (q_t, -M^T b) of a load (q_c, q_t, -b). */
    Eigen::VectorXd
    bound_part(const Eigen::VectorXd &load) const;
    /** (q_c, -N^T b), without what is bound. */
    Eigen::VectorXd
    kept_part(const Eigen::VectorXd &load) const;
    /** What a load on what is bound adds to that. */
    Eigen::VectorXd
    effect(const Eigen::VectorXd &bound_load) const;
    /** (r_c, r_t, a) from (r_c, a_f). */
    Eigen::VectorXd
    complete(const Eigen::VectorXd &unknowns,
             const Eigen::VectorXd &bound_load) const;
    /** (r_t, M a_t) of these. */
    Eigen::VectorXd
    bound_of(const Eigen::VectorXd &unknowns,
             const Eigen::VectorXd &bound_load) const;

  private:
    using Index    = Eigen::Index;
    using VectorXd = Eigen::VectorXd;
    using MatrixXd = Eigen::MatrixXd;

    VectorXd
    scales_of(const MatrixXd &W, const MatrixXd &G) const;
    VectorXd
    chosen_part(const VectorXd &bound_load) const;

    Index                         n_contact = 0, n_bound = 0;
    MatrixXd                      N, M;
    RedundantRows                 redundant;
    std::vector<Index>            rows;    ///< of W_tt that are independent
    VectorXd                      scaling; ///< of them and the tied motions
    VectorXd                      sign;    ///< 1 of reactions, -1 of motions
    Eigen::PartialPivLU<MatrixXd> factor;
    MatrixXd                      answer; ///< of what is bound to what is not
    MatrixXd                      kept;
  };
} // namespace conetact::contact

#endif
