// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_contact_axes_h
#define conetact_contact_contact_axes_h

#include "conetact/contact/contact_points.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace conetact::contact
{
  /**
   * One of the contacts that share a node has the axes of its unknowns: a bound
   * one, else the nearest, else one with an obstacle. The others, and springs,
   * whose points may be anywhere, are further ones, which see what the node
   * does in these axes. Where no node is shared all candidates have axes, and
   * all is as it is without.
   */
  class ContactAxes
  {
  public:
    using Index = Eigen::Index;

    /** No contacts. */
    ContactAxes() = default;
    /** The points must outlive the object. */
    explicit ContactAxes(const ContactPoints &points);

    /** Candidates with axes, and the first of the unknowns of each among
     * theirs. */
    const std::vector<std::pair<const ContactPoint *, Index>> &
    own() const
    {
      return with_axes;
    }
    /** Layout of their unknowns. */
    const solvers::ContactSystem &
    layout() const
    {
      return own_layout;
    }
    Index
    n_unknowns() const
    {
      return own_layout.n_unknowns();
    }
    /** Numbers of the candidates that have axes, and of those that do not. */
    const std::vector<Index> &
    own_nodes() const
    {
      return numbers;
    }
    const std::vector<Index> &
    further_nodes() const
    {
      return further;
    }

  private:
    std::vector<std::pair<const ContactPoint *, Index>> with_axes;
    std::vector<Index>                                  numbers, further;
    solvers::ContactSystem                              own_layout;
  };
} // namespace conetact::contact

#endif
