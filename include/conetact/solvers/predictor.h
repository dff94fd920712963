// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_predictor_h
#define conetact_solvers_predictor_h

#include "conetact/solvers/contact_problem.h"

#include <optional>

namespace conetact::solvers
{
  /**
   * Where an increment may end: if its load changes as that of the increment
   * before, @f$\Delta f = s\,\Delta f_{last}@f$ but for a tenth of it, then
   * displacements and reactions may do so too. Only a first guess of states and
   * directions of slip: what a solver makes of it is judged like any other
   * result.
   */
  class Predictor
  {
  public:
    /**
     * `change` is the load of the increment less the load that `start` is in
     * balance with, up to a sign that stays the same. Nothing if the load goes
     * another way than before, or if this increment starts neither where the
     * last one ended nor where it started (then it is solved once more, with a
     * load that is a little better).
     */
    std::optional<ContactState>
    predict(const ContactState &start, const Eigen::VectorXd &change) const;

    /** Whether the load goes quite another way than that of the increment
     * before: what slipped then does not tell what slips now. */
    bool
    turns(const ContactState &start, const Eigen::VectorXd &change) const;

    /** An increment that was solved. */
    void
    remember(const ContactState    &start,
             const ContactState    &end,
             const Eigen::VectorXd &change);

  private:
    bool
    goes_on(const ContactState &start) const;
    bool
    once_more(const ContactState &start) const;

    Eigen::VectorXd last_change, dv, dr; ///< of the last increment
    ContactState    last_start;
    Eigen::VectorXd last_end; ///< its reactions
  };
} // namespace conetact::solvers

#endif
