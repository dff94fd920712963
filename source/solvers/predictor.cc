// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/predictor.h"

namespace conetact::solvers
{
  std::optional<ContactState>
  Predictor::predict(const ContactState    &start,
                     const Eigen::VectorXd &change) const
  {
    if (!goes_on(start) && !once_more(start))
      return std::nullopt;
    // The same direction as before, but for a tenth across it.
    const double ratio = change.dot(last_change) / last_change.squaredNorm();
    if (!(ratio > 0) ||
        !((change - ratio * last_change).norm() < .1 * change.norm()))
      return std::nullopt;
    ContactState guess = start;
    guess.v += ratio * dv;
    guess.r += ratio * dr;
    return guess;
  }



  bool
  Predictor::turns(const ContactState    &start,
                   const Eigen::VectorXd &change) const
  {
    constexpr double cosine = .5; // A load that turns by less goes on.
    return goes_on(start) && change.dot(last_change) <
                               cosine * change.norm() * last_change.norm();
  }



  /* Numbers are compared to the last bit: a state that anything has touched
     since is not the one that was remembered. */
  bool
  Predictor::goes_on(const ContactState &start) const
  {
    return last_end.size() == start.r.size() && start.r == last_end;
  }



  bool
  Predictor::once_more(const ContactState &start) const
  {
    return last_start.r.size() == start.r.size() && start.r == last_start.r &&
           start.v == last_start.v;
  }



  void
  Predictor::remember(const ContactState    &start,
                      const ContactState    &end,
                      const Eigen::VectorXd &change)
  {
    eigen_assert(end.r.size() == start.r.size());
    eigen_assert(end.v.size() == start.v.size());
    last_change = change;
    last_start  = start;
    last_end    = end.r;
    dv          = end.v - start.v;
    dr          = end.r - start.r;
  }
} // namespace conetact::solvers
