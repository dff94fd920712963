// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_tests_rigid_bodies_h
#define conetact_tests_rigid_bodies_h

#include "conetact/solvers/contact_problem.h"

#include <Eigen/Geometry>
#include <Eigen/Sparse>

#include <cmath>
#include <random>
#include <vector>

/**
 * Time steps of rigid blocks as multibody programs pose them,
 * @f[ M v = M v_0 + h f + H r, \quad u = H^T v, @f]
 * with several contacts a face, so that @f$W = H^T M^{-1} H@f$ has a rank far
 * below its size and the reactions are not unique. With a spin the gyroscopic
 * terms make M and W unsymmetric. Lengths in m, masses in kg.
 */
namespace conetact
{
  using namespace solvers;

  struct RigidBlock
  {
    Eigen::Vector3d centre;
    Eigen::Vector3d size;
    double          angle    = 0; ///< about the z axis
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d spin     = Eigen::Vector3d::Zero();
    bool            fixed    = false; ///< a foundation
  };

  struct RigidContact
  {
    Eigen::Vector3d at, normal; ///< the normal points from `below` to `above`
    std::size_t     below, above;
  };

  class RigidBodies
  {
  public:
    int                       dim     = 3;
    double                    mu      = .5;
    double                    density = 2000, step = .01;
    Eigen::Vector3d           gravity = {0, -9.81, 0};
    std::vector<RigidBlock>   blocks;
    std::vector<RigidContact> contacts;

    Eigen::Index
    n_dofs() const
    {
      return static_cast<Eigen::Index>(blocks.size()) * per_body();
    }

    /** Contacts at the corners (2D: ends) of a rectangle with these axes. */
    void
    add_face(const std::size_t      below,
             const std::size_t      above,
             const Eigen::Vector3d &centre,
             const Eigen::Vector3d &normal,
             const Eigen::Vector3d &half_width,
             const Eigen::Vector3d &half_depth)
    {
      for (const double i : {-1., 1.})
        for (const double j : {-1., 1.})
          if (dim == 3 || j < 0)
            contacts.push_back(
              {centre + i * half_width + (dim == 3 ? j : 0.) * half_depth,
               normal,
               below,
               above});
    }

    /** Mass and gyroscopic terms of all bodies; fixed ones are heavy. */
    Eigen::SparseMatrix<double>
    mass() const
    {
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t b = 0; b < blocks.size(); ++b)
        {
          const Eigen::MatrixXd m     = body_mass(blocks[b]);
          const auto            first = static_cast<int>(b) * per_body();
          for (int i = 0; i < per_body(); ++i)
            for (int j = 0; j < per_body(); ++j)
              if (m(i, j) != 0)
                entries.emplace_back(first + i, first + j, m(i, j));
        }
      Eigen::SparseMatrix<double> M(n_dofs(), n_dofs());
      M.setFromTriplets(entries.begin(), entries.end());
      return M;
    }

    /** H: forces on the bodies of reactions in the order of ContactProblem. */
    Eigen::SparseMatrix<double>
    directions() const
    {
      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t c = 0; c < contacts.size(); ++c)
        for (int k = 0; k < dim; ++k)
          {
            const Eigen::Vector3d e      = direction(contacts[c].normal, k);
            const int             column = dim * static_cast<int>(c) + k;
            add_force(entries, contacts[c], contacts[c].above, e, column);
            add_force(entries, contacts[c], contacts[c].below, -e, column);
          }
      Eigen::SparseMatrix<double> H(n_dofs(),
                                    static_cast<Eigen::Index>(contacts.size()) *
                                      dim);
      H.setFromTriplets(entries.begin(), entries.end());
      return H;
    }

    /** M v_0 + h f. */
    Eigen::VectorXd
    load() const
    {
      Eigen::VectorXd f(n_dofs());
      for (std::size_t b = 0; b < blocks.size(); ++b)
        {
          const RigidBlock     &block = blocks[b];
          const Eigen::MatrixXd m     = body_mass(block);
          Eigen::VectorXd       v(6);
          v << block.velocity + step * (block.fixed ? 0. : 1.) * gravity,
            block.spin;
          if (dim == 2)
            v = Eigen::Vector3d(v(0), v(1), v(5)).eval();
          f.segment(static_cast<Eigen::Index>(b) * per_body(), per_body()) =
            m * v;
        }
      return f;
    }

    ContactProblem
    problem() const
    {
      const Eigen::SparseMatrix<double>                  H = directions();
      const Eigen::SparseMatrix<double>                  M = mass();
      const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(M);

      auto system    = std::make_shared<ContactSystem>();
      system->form   = Form::compliance;
      system->matrix = H.transpose() * Eigen::MatrixXd(lu.solve(H));
      const auto n   = static_cast<Eigen::Index>(contacts.size());
      for (Eigen::Index i = 1; i <= n; ++i)
        system->first.push_back(dim * i);
      system->mu = Eigen::VectorXd::Constant(n, mu);
      ContactProblem result;
      result.load   = H.transpose() * lu.solve(load());
      result.gap    = Eigen::VectorXd::Zero(n);
      result.system = system;
      return result;
    }

  private:
    int
    per_body() const
    {
      return dim == 3 ? 6 : 3;
    }

    /** Unit vector of component k: tangents first, the normal last. */
    Eigen::Vector3d
    direction(const Eigen::Vector3d &normal, const int k) const
    {
      const Eigen::Vector3d t =
        normal.cross(Eigen::Vector3d::UnitZ()).normalized();
      if (k == dim - 1)
        return normal;
      return k == 0 ? t : Eigen::Vector3d(normal.cross(t));
    }

    Eigen::MatrixXd
    body_mass(const RigidBlock &block) const
    {
      const Eigen::Vector3d s = block.size.cwiseAbs2();
      const double m = density * block.size.prod() * (block.fixed ? 1e6 : 1.);
      const Eigen::Matrix3d Q =
        Eigen::AngleAxisd(block.angle, Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
      const Eigen::Matrix3d J =
        Q *
        (m / 12 * Eigen::Vector3d(s(1) + s(2), s(0) + s(2), s(0) + s(1)))
          .asDiagonal() *
        Q.transpose();
      if (dim == 2)
        return Eigen::Vector3d(m, m, J(2, 2)).asDiagonal();
      Eigen::Matrix3d skew;
      skew << 0, -block.spin(2), block.spin(1), //
        block.spin(2), 0, -block.spin(0),       //
        -block.spin(1), block.spin(0), 0;
      Eigen::MatrixXd result = Eigen::MatrixXd::Zero(6, 6);
      result.diagonal().head(3).setConstant(m);
      result.bottomRightCorner(3, 3) = J + step * skew * J;
      return result;
    }

    void
    add_force(std::vector<Eigen::Triplet<double>> &entries,
              const RigidContact                  &contact,
              const std::size_t                    body,
              const Eigen::Vector3d               &force,
              const int                            column) const
    {
      const Eigen::Vector3d moment =
        (contact.at - blocks[body].centre).cross(force);
      const int first = static_cast<int>(body) * per_body();
      for (int i = 0; i < dim; ++i)
        if (force(i) != 0)
          entries.emplace_back(first + i, column, force(i));
      for (int i = (dim == 3 ? 0 : 2); i < 3; ++i)
        if (moment(i) != 0)
          entries.emplace_back(first + (dim == 3 ? 3 + i : 2),
                               column,
                               moment(i));
    }
  };

  /** A tower of equal blocks on a foundation; `lean` shifts each of them. */
  inline RigidBodies
  tower(const int dim, const int height, const double lean = 0)
  {
    RigidBodies           s;
    const Eigen::Vector3d size(1, .5, 1);
    s.dim = dim;
    for (int i = 0; i <= height; ++i)
      {
        RigidBlock block;
        block.size   = size;
        block.centre = {lean * i, .5 * i, 0};
        block.fixed  = i == 0;
        s.blocks.push_back(block);
        if (i > 0)
          s.add_face(s.blocks.size() - 2,
                     s.blocks.size() - 1,
                     {lean * (i - .5), .5 * i - .25, 0},
                     Eigen::Vector3d::UnitY(),
                     {.5 - .5 * std::abs(lean), 0, 0},
                     {0, 0, .5});
      }
    return s;
  }

  /** Rows of `width` bricks in running bond on a foundation. */
  inline RigidBodies
  wall(const int dim, const int width, const int height)
  {
    RigidBodies s;
    s.dim = dim;
    RigidBlock ground;
    ground.fixed  = true;
    ground.size   = {width + 1., 1, 1};
    ground.centre = {.5 * width, -.5, 0};
    s.blocks.push_back(ground);
    const auto at = [&](const int row, const int i) {
      return static_cast<std::size_t>(row == 0 ? 0 : 1 + (row - 1) * width + i);
    };
    for (int row = 1; row <= height; ++row)
      for (int i = 0; i < width; ++i)
        {
          const double x = i + .5 * (row % 2) + .5, y = .5 * row - .25;
          RigidBlock   block;
          block.size   = {1, .5, .6};
          block.centre = {x, y, 0};
          s.blocks.push_back(block);
          for (const double side : {-1., 1.})
            {
              const int  j    = i + ((row % 2 == 1) ? (side > 0) : -(side < 0));
              const bool rest = row == 1 || (j >= 0 && j < width);
              if (rest)
                s.add_face(at(row - 1, j),
                           at(row, i),
                           {x + .25 * side, y - .25, 0},
                           Eigen::Vector3d::UnitY(),
                           {.25, 0, 0},
                           {0, 0, .3});
            }
        }
    return s;
  }

  /** A round arch of n voussoirs between two abutments. */
  inline RigidBodies
  arch(const int dim, const int n, const double thickness = .3)
  {
    RigidBodies s;
    s.dim              = dim;
    const double pi    = std::acos(-1.);
    const double angle = pi / n;
    for (int i = -1; i <= n; ++i)
      {
        const double phi = (i + .5) * angle; // from the right abutment
        RigidBlock   block;
        block.size   = {thickness, angle, .5};
        block.centre = {std::cos(phi), std::sin(phi), 0};
        block.angle  = phi;
        block.fixed  = i < 0 || i == n;
        s.blocks.push_back(block);
        if (i < 0)
          continue;
        const Eigen::Vector3d radial(std::cos(i * angle),
                                     std::sin(i * angle),
                                     0),
          along(-radial(1), radial(0), 0);
        s.add_face(s.blocks.size() - 2,
                   s.blocks.size() - 1,
                   radial,
                   along,
                   .5 * thickness * radial,
                   {0, 0, .25});
      }
    return s;
  }

  /** Random velocities, in m/s, and spins, in rad/s, before the step. */
  inline void
  shake(RigidBodies &s, const double velocity, const double spin)
  {
    std::mt19937 random(3);
    const auto   number = [&] {
      return 2 * (static_cast<double>(random()) / 4294967296.) - 1;
    };
    for (RigidBlock &block : s.blocks)
      if (!block.fixed)
        for (int i = 0; i < 3; ++i)
          {
            block.velocity(i) = velocity * number();
            block.spin(i)     = spin * number();
          }
  }
} // namespace conetact

#endif
