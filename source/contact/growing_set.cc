// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/growing_set.h"

#include "conetact/contact/candidates.h"

namespace conetact::contact
{
  GrowingSet::GrowingSet(ContactModel &m)
    : model(m)
    , n_first(size())
  {}

  void
  GrowingSet::start(
    const std::function<Eigen::VectorXd(const double t)> &forces,
    const std::vector<double>                            &times)
  {
    // A guess: nodes that it misses join when they penetrate.
    model.choose(guess_working_set(model, forces, times));
    n_first = size();
  }

  void
  GrowingSet::resume(std::vector<Eigen::Index> nodes)
  {
    model.choose(WorkingSet(model.points.layout(), std::move(nodes)));
    n_first = size();
  }

  bool
  GrowingSet::suffices(const Eigen::VectorXd &gaps) const
  {
    return penetrating(model, gaps).empty();
  }

  std::size_t
  GrowingSet::extend(const Eigen::VectorXd &gaps)
  {
    const std::size_t before = size();
    join(model, gaps);
    ++n_extended;
    return size() - before;
  }

  bool
  GrowingSet::take_all()
  {
    // Nothing is left to try.
    if (model.working_set().is_all())
      return false;
    model.choose(WorkingSet(model.points.layout()));
    return true;
  }
} // namespace conetact::contact
