// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_between_nodes_h
#define conetact_analysis_between_nodes_h

#include "conetact/contact/contact_model.h"
#include "conetact/pairing/sliding.h"

#include <string>
#include <vector>

namespace conetact::analysis
{
  /**
   * Looks for what only nodes cannot see: an obstacle, smaller than cells, or a
   * master that has come in between nodes.
   */
  class BetweenNodes
  {
  public:
    /** Both must outlive the object. */
    BetweenNodes(const pairing::SlidingContacts &contacts,
                 const contact::ContactModel    &model);

    /** What has come in between at displacements u (all dofs) and time t, a
     * sentence; empty: nothing has. */
    std::string
    comes_between(const Eigen::VectorXd &u, const double t);

  private:
    /** A face, or a part of it, whose corners may all touch an obstacle. */
    struct ObstacleFace
    {
      std::size_t               node; ///< one of them, among contact nodes
      std::vector<unsigned int> corners;
    };
    using Places = std::vector<Tensor<1, 3>>; ///< of all nodes of all bodies

    void
    find_obstacle_faces();
    /** At time t, of the points of a face of this size. */
    double
    lowest_gap(const ObstacleFace                           &face,
               const pairing::SlidingContacts::Displacement &at,
               const double                                  size,
               const double                                  t) const;
    std::string
    obstacle_comes_between(const pairing::SlidingContacts::Displacement &at,
                           const double t) const;
    Places
    places(const pairing::SlidingContacts::Displacement &at) const;
    double
    approach(const Places &from, const Places &to) const;
    std::string
    master_comes_between(const pairing::SlidingContacts::Displacement &at,
                         const double                                  t);

    const pairing::SlidingContacts &contacts;
    const contact::ContactModel    &model;
    std::vector<ObstacleFace>       obstacle_faces;
    Places clear_at;      ///< displacements where masters were looked for last
    double clearance = 0; ///< so far none was too deep in a slave [length]
  };
} // namespace conetact::analysis

#endif
