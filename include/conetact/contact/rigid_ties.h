// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_rigid_ties_h
#define conetact_contact_rigid_ties_h

#include "conetact/contact/contact_points.h"
#include "conetact/contact/rigid_modes.h"

#include <map>
#include <vector>

namespace conetact::contact
{
  /** What binds rigid motions of bodies to each other. */
  class RigidTies
  {
  public:
    RigidTies() = default;
    /** Takes points that are tied as they were at the start: those that are
     * found again are replaced. */
    RigidTies(const model::Bodies &bodies,
              const RigidModes    &modes,
              const ContactPoints &points);

    bool
    empty() const
    {
      return ties.empty();
    }
    /** The first of the bodies that a body is tied with. */
    unsigned int
    first_of(const unsigned int body) const
    {
      return first[body];
    }
    /** Bodies that are tied together, each set in order. */
    std::vector<std::vector<unsigned int>>
    assemblies() const;
    /** The sum of squares of the ties of the assembly that begins with a body,
     * in these of all modes. */
    Eigen::MatrixXd
    squares(const unsigned int               first_body,
            const std::vector<Eigen::Index> &among) const;
    /** Adds what is missing from the displacements that ties want at time t,
     * each along its row. */
    void
    add_missing(const double               t,
                const RigidModes::Amounts &amounts,
                RigidModes::Amounts       &sum) const;

  private:
    /** An equation that binds a node to its opponent. */
    struct Tie
    {
      const pairing::ContactNode                *node;
      Tensor<1, 3>                               direction;
      std::map<unsigned int, Eigen::RowVectorXd> rows; ///< of bodies' modes
    };

    void
    join_bodies();
    static void
    add(const double factor, const Tie &tied, RigidModes::Amounts &sum);
    /** Displacement relative to the opponent, along its direction. */
    static double
    relative(const Tie &tied, const RigidModes::Amounts &amounts);

    std::vector<Tie>          ties;
    std::vector<unsigned int> first; ///< of each body
  };
} // namespace conetact::contact

#endif
