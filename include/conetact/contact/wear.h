// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_wear_h
#define conetact_contact_wear_h

#include "conetact/base/archive.h"
#include "conetact/contact/contact_points.h"
#include "conetact/contact/worn_sides.h"

#include <memory>

namespace conetact::contact
{
  /** What has worn off both sides of all contacts so far; a value. */
  class Wear
  {
  public:
    /** Of so many candidates: nothing. */
    explicit Wear(const Eigen::Index n_candidates = 0);
    /** Fields of masters from here on. */
    void
    set_sides(std::shared_ptr<const WornSides> of_masters);

    /** Candidates stand elsewhere: they face other nodes of their masters. */
    void
    stand(const ContactPoints &points);
    /** Both sides have lost these depths, of each candidate on its area. */
    void
    add(const ContactPoints   &points,
        const Eigen::VectorXd &depths,
        const Eigen::VectorXd &areas);
    /** What this history of the same contacts has lost, where these stand. */
    void
    take(const Wear &other, const ContactPoints &points);
    /** The same, as much more as is known of candidates and of fields. */
    void
    add_difference(const Eigen::VectorXd &more,
                   const Eigen::VectorXd &more_of_sides,
                   const ContactPoints   &points);

    /** k p ds of each candidate so far, on its way [length]. */
    const Eigen::VectorXd &
    worn() const
    {
      return all;
    }
    /** Volume of both sides so far: areas change [length^3]. */
    const Eigen::VectorXd &
    removed() const
    {
      return volumes;
    }
    /** How far both sides have receded where each candidate stands, which
     * opens its gap [length]. */
    const Eigen::VectorXd &
    receded() const
    {
      return opening;
    }
    /** Depths of nodes of masters, by WornSides [length]. */
    const Eigen::VectorXd &
    of_sides() const
    {
      return depths_of_sides;
    }
    /** Null: no master has a depth of its own. */
    const WornSides *
    sides() const
    {
      return masters.get();
    }

    void
    save(Archive &archive) const;
    void
    restore(const Archive &archive, const ContactPoints &points);

  private:
    /** Part of what a candidate has worn that stays with it. */
    double
    own_part(const pairing::ContactNode &node) const;

    std::shared_ptr<const WornSides> masters;
    Eigen::VectorXd                  all, volumes, opening, depths_of_sides;
  };
} // namespace conetact::contact

#endif
