// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_model_increment_record_h
#define conetact_model_increment_record_h

#include "conetact/bodies/structure.h"
#include "conetact/solvers/contact_problem.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace conetact::model
{
  /** A contact node at the end of an increment. */
  struct ContactRow
  {
    unsigned int       contact = 0; ///< index into RunDescription::contacts
    unsigned int       node    = 0; ///< number in its body
    Point<3>           position;    ///< undeformed [length]
    Tensor<1, 3>       normal;      ///< from the obstacle to the body
    Tensor<1, 3>       t1, t2;      ///< tangents (2D: t2 = e_z)
    double             area = 0;    ///< tributary area [length^2]
    double             gap  = 0;    ///< at the end of the increment [length]
    Tensor<1, 3>       u;  ///< (u_n, u_t1, u_t2), total, relative [length]
    Tensor<1, 3>       du; ///< the same of this increment
    Tensor<1, 3>       reaction; ///< (r_n, r_t1, r_t2) on the body [force]
    Point<3>           foot;     ///< where it acts on the other side [length]
    Point<3>           acts;     ///< where it acts on the body [length]
    solvers::NodeState state    = solvers::NodeState::open;
    bool               master   = false; ///< the other side of a pair of bodies
    double             wear     = 0; ///< depth that this side has lost [length]
    double             removed  = 0; ///< volume of both so far [length^3]
    bool               bonded   = false; ///< sticks, and would bear a pull
    bool               wet      = false; ///< a fluid is between its sides
    bool               faces    = true;  ///< something, so that it has a gap
    bool               couples  = false; ///< it has forces, and no pressure
    double             fracture = 0; ///< work against its bond [force x length]

    /** Of a master: reactions and areas that add up without the signs of their
     * weights. On faces of second degree areas of corners cancel out. */
    Tensor<1, 3> pressing;
    double       covered = 0;

    /** As pictures have it: 3 is bonded, 4 is wet. */
    double
    state_number() const
    {
      return wet ? 4. : bonded ? 3. : static_cast<double>(state);
    }
    /** A force and the area that it presses on. */
    std::pair<Tensor<1, 3>, double>
    pressed() const
    {
      return master ? std::pair(pressing, covered) : std::pair(reaction, area);
    }
    /** 0 where nothing is covered. */
    Tensor<1, 3>
    traction() const
    {
      const auto [force, on] = pressed();
      return on > 0 ? force / on : Tensor<1, 3>();
    }

    /** Of (n, t1, t2) the components along the axes. */
    Tensor<1, 3>
    in_space(const Tensor<1, 3> &v) const
    {
      return v[0] * normal + v[1] * t1 + v[2] * t2;
    }
  };

  /** Force [force] and moment about the origin [force x length]. */
  struct Resultant
  {
    Tensor<1, 3> force;
    Tensor<1, 3> moment;
  };

  /** An obstacle that is free, at its reference point. */
  struct ObstacleRecord
  {
    Tensor<1, 3> displacement; ///< since the start [length]
    Tensor<1, 3> rotation;     ///< about the axes [rad]
    Resultant    contacts;     ///< what all contacts do to it
  };

  /** Where the bodies move most. */
  struct LargestDisplacement
  {
    double       size = 0; ///< [length]
    unsigned int body = 0;
    Point<3>     position; ///< undeformed
  };

  /** A node of a master that wears, whether or not anything stands there. */
  struct WornNode
  {
    unsigned int body = 0, node = 0;
    double       depth = 0; ///< [length]
  };

  /** Of a tie that a force tightens. */
  struct PreloadRecord
  {
    double force      = 0; ///< tension [force]
    double shortening = 0; ///< since the start [length]
  };

  /** An increment as its contact nodes see it. */
  struct CondensedIncrement
  {
    solvers::ContactProblem problem;
    std::optional<solvers::ContactState>
      solution; ///< none if it was solved in parts
  };

  /** One of all solutions of an increment: its number, and that of the one that
   * it follows in the increment before. */
  struct BranchRows
  {
    unsigned int            number = 1, parent = 1;
    std::vector<ContactRow> rows;
  };

  /** All that is known of a finished increment. */
  struct IncrementRecord
  {
    unsigned int          increment = 0; ///< counts from 1
    double                time      = 0;
    solvers::SolverReport report;
    solvers::KannoErrors  errors;
    unsigned int          pairings    = 0; ///< how often contacts were found
    double                equilibrium = 0; ///< uncondensed residual, relative
    double                balance     = 0; ///< sum of all resultants, relative

    /** The same of each body, where there are several. */
    std::vector<double> body_balance;

    std::vector<ContactRow> rows;
    std::vector<WornNode>   worn_masters;
    std::vector<Resultant>  contacts; ///< one a contact
    Resultant               supports;
    Resultant               loads;
    std::vector<Resultant>  each_support, each_load;

    std::vector<ObstacleRecord> obstacles; ///< that are free
    std::vector<PreloadRecord>  preloads;

    LargestDisplacement       largest_displacement;
    std::vector<Tensor<1, 3>> probes; ///< displacements of chosen points

    double strain_energy = 0; ///< at the end [force x length]
    // of the increment [force x length]
    double      external_work = 0; ///< of loads and moving supports
    double      dissipation   = 0; ///< mean tangential reactions times slips
    double      contact_work_normal = 0; ///< the same of the normal part
    bool        determinate = true; ///< false: displacements are not unique
    std::string unique;             ///< yes, no or open; empty: nobody asked
    std::vector<ContactRow> other_rows; ///< of another solution, if there is
    std::vector<BranchRows> branches;   ///< all solutions, if asked for

    /**
     * Of increments that are drawn, one a body: displacements of all its dofs,
     * these without a rigid motion (stresses come from them; none given: the
     * displacements), its loads.
     */
    std::vector<Eigen::VectorXd> displacements, deformations;
    std::vector<bodies::Actions> actions;

    /** Where a file of it is wanted. */
    std::shared_ptr<const CondensedIncrement> condensed;
  };
} // namespace conetact::model

#endif
