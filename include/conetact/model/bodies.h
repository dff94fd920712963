// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_model_bodies_h
#define conetact_model_bodies_h

#include "conetact/bodies/structure.h"
#include "conetact/bodies/supports.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/round_surface.h"

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace conetact::model
{
  /** A tie whose sides move along an axis, see add_preloads(). */
  struct Cut
  {
    unsigned int          contact = 0; ///< index of the tie
    unsigned int          body    = 0; ///< the rigid one that opens it
    Tensor<1, 3>          axis;        ///< unit, from the master to the body
    std::optional<double> locked_from; ///< time
    std::optional<double> opening;     ///< where it is locked [length]

    /** Whether it is locked in increments that begin at t. */
    bool
    is_due(const double t) const
    {
      return locked_from && t >= *locked_from - rounding();
    }
    /** Whether it is locked in increments that end at t. */
    bool
    is_locked_after(const double t) const
    {
      return locked_from && t > *locked_from + rounding();
    }

  private:
    double
    rounding() const
    {
      return 1e-12 * std::abs(*locked_from);
    }
  };

  /** A round side of a body that may spin, see find_free_spins(). */
  struct RoundSide
  {
    unsigned int          contact = 0; ///< index
    unsigned int          body    = 0;
    pairing::RoundSurface surface; ///< undeformed
    /** Outward normals at nodes of the other side where all faces of it are one
     * plane, in its body. */
    std::map<unsigned int, Tensor<1, 3>> opposite_planes;
  };

  /** The bodies of a scene, what holds them and where they may touch. */
  struct Bodies
  {
    unsigned int                           dim = 2;
    std::vector<std::string>               names;
    std::vector<const bodies::Structure *> structures;
    std::vector<bodies::Support>           supports;
    std::vector<pairing::ContactNode>      contact_nodes;
    std::vector<RoundSide>                 round_sides;

    /** The last ones are rigid: obstacles that are free, then cuts. */
    std::size_t n_rigid = 0;
    std::size_t
    n_elastic() const
    {
      return structures.size() - n_rigid;
    }
    bool
    is_rigid(const std::size_t body) const
    {
      return body >= n_elastic();
    }
    std::size_t
    n_free_obstacles() const
    {
      return n_rigid - cuts.size();
    }
    bool
    is_free_obstacle(const std::size_t body) const
    {
      return is_rigid(body) && body < n_elastic() + n_free_obstacles();
    }
    /** Ties that forces tighten; which are locked changes with time. */
    std::vector<Cut> cuts;
    /** Bodies of revolution round the y axis: all of them or none. */
    bool
    are_axisymmetric() const
    {
      return !structures.empty() && structures.front()->is_axisymmetric();
    }
    /** "body 'block'", "obstacle 'plate'" or "'preload bolt'". */
    std::string
    called(const std::size_t body) const
    {
      const bool is_cut = is_rigid(body) && !is_free_obstacle(body);
      return (is_cut         ? "'" :
              is_rigid(body) ? "obstacle '" :
                               "body '") +
             names[body] + "'";
    }
    /**
     * Where bodies that turn far stand, one for each body; empty: nothing
     * turns far. A body deforms little in its frame: displacements and forces
     * of elasticity are components there, x = frame(X + u). What contacts see
     * and tables tell are those in space.
     */
    std::vector<pairing::RigidMotion> frames;
    /** Displacement in space of a node that moved by u in its frame. */
    Tensor<1, 3>
    displacement(const unsigned int  body,
                 const unsigned int  node,
                 const Tensor<1, 3> &u) const
    {
      if (frames.empty())
        return u;
      const pairing::RigidMotion &frame = frames[body];
      return frame.displacement(structures[body]->position(node)) +
             frame.direction_to_space(u);
    }
    /** The inverse: what moved by u in space, in its frame. */
    Tensor<1, 3>
    in_frame(const unsigned int  body,
             const unsigned int  node,
             const Tensor<1, 3> &u) const
    {
      return frames.empty() ?
               u :
               frames[body].relative(structures[body]->position(node), u);
    }
    /** Forces and directions in space, in the frame of a body. */
    Tensor<1, 3>
    in_frame(const unsigned int body, const Tensor<1, 3> &direction) const
    {
      return frames.empty() ? direction :
                              frames[body].direction_to_own(direction);
    }
    Tensor<1, 3>
    in_space(const unsigned int body, const Tensor<1, 3> &direction) const
    {
      return frames.empty() ? direction :
                              frames[body].direction_to_space(direction);
    }
    /** Where its frame puts a node. */
    Point<3>
    position(const unsigned int body, const unsigned int node) const
    {
      const Point<3> p = structures[body]->position(node);
      return frames.empty() ? p : frames[body].to_space(p);
    }

    /** Body and number of nodes that contacts may come to see, in any
     * direction, as they slide. */
    std::vector<std::pair<unsigned int, unsigned int>> nodes_to_keep;

    /** Bodies that nothing reaches and that are not solved; empty: none. */
    std::vector<bool> at_rest;
    bool
    is_at_rest(const std::size_t body) const
    {
      return body < at_rest.size() && at_rest[body];
    }
    /** Whether its nodes deform: unknowns of equilibrium. */
    bool
    deforms(const std::size_t body) const
    {
      return !is_at_rest(body) && !is_rigid(body);
    }
  };
} // namespace conetact::model

#endif
