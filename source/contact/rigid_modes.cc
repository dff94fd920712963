// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/rigid_modes.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /** Translations and rotations of a body: 3 in the plane, 6 in space. */
    constexpr Eigen::Index
    n_modes(const unsigned int dim)
    {
      return dim == 2 ? 3 : 6;
    }

    Tensor<1, 3>
    axis(const unsigned int k)
    {
      Tensor<1, 3> e;
      e[k] = 1;
      return e;
    }

    /** The one motion of a body of revolution is along y: mode 1. */
    bool
    is_axial(const unsigned int k)
    {
      return k == 1;
    }

    /**
     * Mode k of a body at p: the translation e_k, or the rotation e_k x (p -
     * p_0) / size, which moves its rim by about 1. Whatever strains a body of
     * revolution is no motion: nothing.
     */
    Tensor<1, 3>
    mode(const unsigned int        k,
         const unsigned int        dim,
         const RigidModes::Motion &frame,
         const Point<3>           &p)
    {
      if (frame.axisymmetric && !is_axial(k))
        return Tensor<1, 3>();
      if (k < dim)
        return axis(k);
      const Tensor<1, 3> about = axis(dim == 2 ? 2 : k - dim);
      return cross_product_3d(about, p - frame.centre) / frame.size;
    }

    Tensor<1, 3>
    displacement(const RigidModes::Motion &motion, const Point<3> &p)
    {
      return motion.translation +
             cross_product_3d(motion.rotation, p - motion.centre);
    }

    RigidModes::Motion
    frame_of(const model::Bodies &bodies, const unsigned int body)
    {
      const bodies::Structure &structure = *bodies.structures[body];
      RigidModes::Motion       frame{
        body, structure.is_axisymmetric(), {}, {}, {}, 0};
      const unsigned int n = structure.n_nodes();
      if (bodies.is_rigid(body))
        frame.centre = structure.position(0); // its reference point
      for (unsigned int i = 0; i < n && !bodies.is_rigid(body); ++i)
        // Any point near the middle will do: rotations about it move nodes
        // least, and are nearly orthogonal to translations.
        frame.centre += Tensor<1, 3>(structure.position(i)) / n;
      for (unsigned int i = 0; i < n; ++i)
        frame.size =
          std::max(frame.size, structure.position(i).distance(frame.centre));
      if (frame.size == 0)
        frame.size = 1; // an obstacle without extent: any lever will do
      return frame;
    }

    /** A unit vector with four digits, so that rounding is not told. */
    std::string
    direction_text(Tensor<1, 3> v)
    {
      v /= v.norm();
      for (unsigned int d = 0; d < 3; ++d)
        v[d] = std::round(1e4 * v[d]) / 1e4;
      return to_text(v);
    }
  } // namespace



  /* All bodies have as many amounts, used or not: of body b they begin at b
     times n_one. */
  RigidModes::RigidModes(const model::Bodies &b)
    : bodies(b)
    , n_one(n_modes(b.dim))
    , offset(1, 0)
  {
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      {
        frames.push_back(frame_of(bodies, body));
        offset.push_back(offset.back() + bodies.structures[body]->n_dofs());
      }
  }

  bool
  RigidModes::strains(const unsigned int body, const unsigned int k) const
  {
    return frames[body].axisymmetric && !is_axial(k);
  }



  /* The row e . R(p): by how much each mode moves p along a direction e. Its
     transpose times a force is the work that the force does on the modes. */
  Eigen::RowVectorXd
  RigidModes::row(const unsigned int  body,
                  const Point<3>     &p,
                  const Tensor<1, 3> &direction) const
  {
    AssertIndexRange(body, frames.size());
    Eigen::RowVectorXd result(n_one);
    for (unsigned int k = 0; k < n_one; ++k)
      result[k] = direction * mode(k, bodies.dim, frames[body], p);
    return result;
  }

  Tensor<1, 3>
  RigidModes::at(const Amounts     &amounts,
                 const unsigned int body,
                 const unsigned int node) const
  {
    AssertDimension(amounts.size(), none().size());
    AssertIndexRange(body, frames.size());
    return displacement(of_body(amounts, body),
                        bodies.structures[body]->position(node));
  }

  /* The sum of all modes, as translation and rotation vector: amounts over the
     size are angles. */
  RigidModes::Motion
  RigidModes::of_body(const Amounts &amounts, const unsigned int body) const
  {
    AssertDimension(amounts.size(), none().size());
    AssertIndexRange(body, frames.size());
    Motion motion = frames[body];
    for (unsigned int k = 0; k < n_one; ++k)
      if (const double amount = amounts[body * n_one + k]; strains(body, k))
        continue;
      else if (k < bodies.dim)
        motion.translation[k] = amount;
      else
        motion.rotation[bodies.dim == 2 ? 2 : k - bodies.dim] =
          amount / motion.size;
    return motion;
  }

  double
  RigidModes::largest_size() const
  {
    double largest = 0;
    for (const Motion &frame : frames)
      largest = std::max(largest, frame.size);
    return largest;
  }

  /* u = R a at all dofs. Most bodies have no part in a motion, and are left
     out. */
  Eigen::VectorXd
  RigidModes::field(const Amounts &amounts) const
  {
    AssertDimension(amounts.size(), none().size());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(offset.back());
    for (unsigned int body = 0; body < frames.size(); ++body)
      {
        if (amounts.segment(body * n_one, n_one).isZero(0))
          continue;
        const bodies::Structure &structure = *bodies.structures[body];
        const unsigned int       n_c       = structure.n_components();
        const Motion             motion    = of_body(amounts, body);
        Eigen::Index             dof       = offset[body];
        for (unsigned int i = 0; i < structure.n_nodes(); ++i, dof += n_c)
          {
            const Tensor<1, 3> moved =
              displacement(motion, structure.position(i));
            for (unsigned int c = 0; c < bodies.dim; ++c)
              u[dof + c] = moved[c];
            for (unsigned int c = bodies.dim; c < n_c; ++c)
              if (structure.has_dof(i, c))
                // An amount is the way of the rim, a dof of rotation an angle.
                u[dof + c] = amounts[body * n_one + c] / frames[body].size;
          }
      }
    return u;
  }

  /* R^T f: forces along the translations, moments about the centre over the
     size along the rotations, so that both are forces. */
  RigidModes::Amounts
  RigidModes::resultants(const Eigen::VectorXd &forces) const
  {
    AssertDimension(forces.size(), offset.back());
    Amounts sum = none();
    for (unsigned int body = 0; body < frames.size(); ++body)
      {
        const bodies::Structure &structure = *bodies.structures[body];
        const unsigned int       n_c       = structure.n_components();
        Eigen::Index             dof       = offset[body];
        for (unsigned int i = 0; i < structure.n_nodes(); ++i, dof += n_c)
          {
            Tensor<1, 3> force;
            for (unsigned int c = 0; c < bodies.dim; ++c)
              force[c] = forces[dof + c];
            if (force.norm_square() > 0)
              sum.segment(body * n_one, n_one) +=
                row(body, structure.position(i), force).transpose();
            for (unsigned int c = bodies.dim; c < n_c; ++c)
              sum[body * n_one + c] += forces[dof + c] / frames[body].size;
          }
      }
    return sum;
  }

  /* A unit amount of a turning mode turns a node by 1/size, and resultants()
     takes 1/size of a moment: size^2 between them leaves 1, as along a
     direction. */
  RigidModes::Amounts
  RigidModes::products(Eigen::VectorXd u) const
  {
    AssertDimension(u.size(), offset.back());
    for (unsigned int body = 0; body < frames.size(); ++body)
      {
        const unsigned int n_c  = bodies.structures[body]->n_components();
        const double       size = frames[body].size;
        for (Eigen::Index dof = offset[body]; dof < offset[body + 1];
             dof += n_c)
          for (unsigned int c = bodies.dim; c < n_c; ++c)
            u[dof + c] *= size * size;
      }
    return resultants(u);
  }

  /* Node by node, as products() of fields would be for each mode. */
  Eigen::MatrixXd
  RigidModes::squares(const unsigned int body) const
  {
    AssertIndexRange(body, frames.size());
    const bodies::Structure  &structure = *bodies.structures[body];
    Eigen::MatrixXd           sum       = Eigen::MatrixXd::Zero(n_one, n_one);
    std::vector<Tensor<1, 3>> modes(n_one);
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      {
        for (unsigned int k = 0; k < n_one; ++k)
          modes[k] = mode(k, bodies.dim, frames[body], structure.position(i));
        for (unsigned int k = 0; k < n_one; ++k)
          for (unsigned int l = 0; l < n_one; ++l)
            sum(k, l) += modes[k] * modes[l];
        for (unsigned int c = bodies.dim; c < structure.n_components(); ++c)
          if (structure.has_dof(i, c))
            sum(c, c) += 1;
      }
    return sum;
  }

  /* The body that moves most, to be named in a sentence. */
  RigidModes::Motion
  RigidModes::largest(const Amounts &modes) const
  {
    AssertDimension(modes.size(), none().size());
    // Amounts are lengths, so that turns and translations compare.
    std::size_t best = 0;
    for (std::size_t body = 1; body < frames.size(); ++body)
      if (modes.segment(static_cast<Eigen::Index>(body) * n_one, n_one).norm() >
          // Bodies may move alike: the first is named, not one by rounding.
          1.001 * modes.segment(static_cast<Eigen::Index>(best) * n_one, n_one)
                    .norm())
        best = body;
    return in_space(modes, static_cast<unsigned int>(best));
  }

  /* The work of forces on the modes of each body, (R^T f)_k a_k: the body that
     is pushed most is the one to name, not one that only goes along. */
  RigidModes::Motion
  RigidModes::driven_most(const Amounts         &modes,
                          const Eigen::VectorXd &forces) const
  {
    const Amounts work = resultants(forces).cwiseProduct(modes);
    const auto    of   = [&](const std::size_t body) {
      return work.segment(static_cast<Eigen::Index>(body) * n_one, n_one).sum();
    };
    std::size_t best = 0;
    for (std::size_t body = 1; body < frames.size(); ++body)
      if (of(body) > 1.001 * of(best))
        best = body;
    return of(best) > 0 ? in_space(modes, static_cast<unsigned int>(best)) :
                          largest(modes);
  }

  RigidModes::Motion
  RigidModes::in_space(const Amounts &modes, const unsigned int body) const
  {
    Motion motion      = of_body(modes, body);
    motion.translation = bodies.in_space(body, motion.translation);
    motion.rotation    = bodies.in_space(body, motion.rotation);
    return motion;
  }

  std::string
  describe(const RigidModes::Motion &motion)
  {
    // Both are lengths: one is rounding below a millionth of the other.
    const double translation = motion.translation.norm();
    const double rotation    = motion.size * motion.rotation.norm();
    const double small       = 1e-6 * std::max(translation, rotation);
    std::string  text;
    if (translation > small)
      text = "along " + direction_text(motion.translation);
    if (rotation > small)
      text += std::string(text.empty() ? "" : " and ") + "about " +
              direction_text(motion.rotation);
    return text;
  }
} // namespace conetact::contact
