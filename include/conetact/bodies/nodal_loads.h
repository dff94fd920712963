// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_nodal_loads_h
#define conetact_bodies_nodal_loads_h

#include "conetact/bodies/loads.h"

#include <Eigen/SparseCore>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace conetact::bodies
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
               const std::vector<const Structure *> &structures,
               const unsigned int                    dim);

    /** What acts at one time. */
    struct Acting
    {
      Eigen::VectorXd mechanical; ///< all forces on all dofs of all bodies but
                                  ///< those of initial strains
      Eigen::VectorXd thermal;    ///< the part of them that initial strains
                                  ///< (temperature) make; empty: none
      Eigen::VectorXd both;       ///< their sum where there are thermal ones
      /** Force and moment about the origin of each load. */
      std::vector<std::pair<Tensor<1, 3>, Tensor<1, 3>>> each;
    };
    /**
     * At time t. Throws InputError where a load is not finite or a point is
     * outside.
     */
    Acting
    acting(const double t);
    /** Called for each load and its nodal forces, on all dofs of its body. */
    using Visitor = std::function<void(const Load &, const Eigen::VectorXd &)>;
    void
    visit(const double t, const Visitor &visit);
    /** Change of a body's temperature at a point of it [K]. */
    double
    temperature(const unsigned int body,
                const Point<3>    &p,
                const double       t) const;
    /** Its forces alone. */
    Eigen::VectorXd
    at(const double t)
    {
      Acting all = acting(t);
      return std::move(all.thermal.size() > 0 ? all.both : all.mechanical);
    }

    /** What a load amounts to at the time at which it is largest. */
    struct Largest
    {
      std::string  name;
      bool         is_constant = false;
      double       time        = 0;
      unsigned int n_nodes     = 0; ///< with a force
      double       size        = 0; ///< sum of absolute nodal forces
      Tensor<1, 3> force, moment;   ///< the latter about the origin
    };
    /** Of each load, of all times asked for so far. */
    const std::vector<Largest> &
    largest() const
    {
      return of_loads;
    }

    /** What a load asks for when it is largest, compared with what the mesh
     * carries: totals, or the area and the mass that it acts on. Empty for
     * those of single nodes, of members and of initial strains. */
    std::string
    asked(const std::size_t load) const;

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
    /** Keeps the resultant of the nodal forces f if it is the largest. */
    void
    note(const std::size_t load, const double t, const Eigen::VectorXd &f);

    const std::vector<Load>              &loads;
    const std::vector<const Structure *> &structures;
    const unsigned int                    dim;
    std::vector<std::map<double, Forces>> kept; ///< of each load, by time
    std::vector<Largest>                  of_loads;
    Eigen::Index                          room;
    unsigned int                          evaluations = 0, integrations = 0;
  };
} // namespace conetact::bodies

#endif
