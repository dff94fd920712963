// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_structures_nodal_loads_h
#define conetact_structures_nodal_loads_h

#include "conetact/structures/loads.h"

#include <Eigen/SparseCore>

#include <map>
#include <vector>

namespace conetact
{
  /**
   * Nodal forces of all loads of a scene [force]. Each load is integrated once
   * where it does not depend on time, else once a time, as long as there is
   * room to keep its forces.
   */
  class NodalLoads
  {
  public:
    /** Both must live longer than this object. */
    NodalLoads(const std::vector<Load>              &loads,
               const std::vector<const Structure *> &structures);

    /**
     * On all dofs of all bodies at time t. Throws InputError where a load is
     * not finite or a point is outside.
     */
    Eigen::VectorXd
    at(const double t);

    /** Loads that were asked for, and those that had to be integrated. */
    unsigned int
    n_evaluations() const
    {
      return evaluations;
    }
    unsigned int
    n_integrations() const
    {
      return integrations;
    }

  private:
    using Forces = Eigen::SparseVector<double>;
    void
    add(const std::size_t load, const double t, Eigen::VectorXd &f);

    const std::vector<Load>              &loads;
    const std::vector<const Structure *> &structures;
    std::vector<std::map<double, Forces>> kept; ///< of each load, by time
    Eigen::Index                          room;
    unsigned int                          evaluations = 0, integrations = 0;
  };
} // namespace conetact

#endif
