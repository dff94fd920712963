// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_growing_set_h
#define conetact_contact_growing_set_h

#include "conetact/contact/contact_model.h"

#include <functional>

namespace conetact::contact
{
  /**
   * The working set of a model as it grows: candidates that would penetrate
   * join, until results are those of all candidates.
   */
  class GrowingSet
  {
  public:
    explicit GrowingSet(ContactModel &model);

    /** As guess_working_set(). */
    void
    start(const std::function<Eigen::VectorXd(const double t)> &forces,
          const std::vector<double>                            &times);

    /** One that has grown before, of a run that is continued. */
    void
    resume(std::vector<Eigen::Index> nodes);

    /** Whether no candidate outside penetrates, by the gaps of all [length]. */
    bool
    suffices(const Eigen::VectorXd &gaps) const;
    /** Those that penetrate join. Returns how many. */
    std::size_t
    extend(const Eigen::VectorXd &gaps);
    /** All candidates join. False if they are in the set already. */
    bool
    take_all();

    std::size_t
    size() const
    {
      return model.working_set().nodes().size();
    }
    std::size_t
    size_at_start() const
    {
      return n_first;
    }
    unsigned int
    n_extensions() const
    {
      return n_extended;
    }

  private:
    ContactModel &model;
    std::size_t   n_first;
    unsigned int  n_extended = 0;
  };
} // namespace conetact::contact

#endif
