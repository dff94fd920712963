// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_rigid_modes_h
#define conetact_contact_rigid_modes_h

#include "conetact/contact/node_rules.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace conetact::contact
{
  /**
   * Small rigid motions R a of the bodies in closed form: translations, and
   * rotations that move the rim of a body by about 1, so that amounts a are
   * lengths. Each body has 3 modes in the plane and 6 in space.
   */
  class RigidModes
  {
  public:
    /** What is given must outlive the object. */
    explicit RigidModes(const model::Bodies &bodies);

    /** Amounts of all modes of all bodies, 3 a body in 2D, 6 in 3D. */
    using Amounts = Eigen::VectorXd;

    /** Amounts of no motion. */
    Amounts
    none() const
    {
      return Amounts::Zero(n_one * static_cast<Eigen::Index>(frames.size()));
    }
    /** Displacements of all dofs of all bodies. */
    Eigen::VectorXd
    field(const Amounts &amounts) const;
    /** R^T f: forces on all dofs against all modes. */
    Amounts
    resultants(const Eigen::VectorXd &forces) const;
    /** R^T L u, where L makes a turn of a node the way that it is at the end of
     * its body: least squares of displacements depend on no unit. */
    Amounts
    products(Eigen::VectorXd u) const;
    /** R^T L R of a body. */
    Eigen::MatrixXd
    squares(const unsigned int body) const;
    /** direction . R at p, the modes of a body. */
    Eigen::RowVectorXd
    row(const unsigned int  body,
        const Point<3>     &p,
        const Tensor<1, 3> &direction) const;
    /** Displacement at a node of a body. */
    Tensor<1, 3>
    at(const Amounts     &amounts,
       const unsigned int body,
       const unsigned int node) const;
    /** A rigid motion of one body: u(x) = translation + rotation x (x - x0). */
    struct Motion
    {
      unsigned int body;
      bool         axisymmetric; ///< moves along y only
      Point<3>     centre;
      Tensor<1, 3> translation;
      Tensor<1, 3> rotation; ///< [1/length] of the translation's unit
      double       size;     ///< of the body [length]
    };
    /** What amounts do to a body. */
    Motion
    of_body(const Amounts &amounts, const unsigned int body) const;
    /** The same with components in space. */
    Motion
    in_space(const Amounts &amounts, const unsigned int body) const;
    /** The axis about which the motion turns a body, times the angle [rad]. */
    Tensor<1, 3>
    turn(const Amounts &amounts, const unsigned int body) const
    {
      return of_body(amounts, body).rotation;
    }
    /** How far that is [rad]. */
    double
    rotation(const Amounts &amounts, const unsigned int body) const
    {
      return turn(amounts, body).norm();
    }
    /** The body that moves most, and how. */
    Motion
    largest(const Amounts &amounts) const;
    /** The body on which forces on all dofs do most work, and how it moves; the
     * one that moves most where they do none. */
    Motion
    driven_most(const Amounts &amounts, const Eigen::VectorXd &forces) const;
    /** The middle of a body's nodes, or where a rigid one is referred to. */
    const Point<3> &
    centre(const unsigned int body) const
    {
      return frames[body].centre;
    }
    /** Distance of a body's nodes from its centre, at most [length]. */
    double
    size(const unsigned int body) const
    {
      return frames[body].size;
    }
    /** The size of the largest body. */
    double
    largest_size() const;

  protected:
    /** Mode k strains a body of revolution, and is none of it. */
    bool
    strains(const unsigned int body, const unsigned int k) const;

    const model::Bodies      &bodies;
    Eigen::Index              n_one;  ///< modes of a body
    std::vector<Motion>       frames; ///< of each body, without motion
    std::vector<Eigen::Index> offset; ///< first dof of each body
  };

  /** "along (1, 0, 0)", "about (0, 0, 1)", "along ... and about ...". */
  std::string
  describe(const RigidModes::Motion &motion);
} // namespace conetact::contact

#endif
