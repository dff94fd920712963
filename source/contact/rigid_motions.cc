// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/rigid_motions.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace conetact
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

    /** Mode k of a body at p; rotations move its rim by about 1. */
    Tensor<1, 3>
    mode(const unsigned int          k,
         const unsigned int          dim,
         const RigidMotions::Motion &frame,
         const Point<3>             &p)
    {
      if (k < dim)
        return axis(k);
      const Tensor<1, 3> about = axis(dim == 2 ? 2 : k - dim);
      return cross_product_3d(about, p - frame.centre) / frame.size;
    }

    RigidMotions::Motion
    frame_of(const unsigned int body, const Structure &structure)
    {
      RigidMotions::Motion frame{body, {}, {}, {}, 0};
      const unsigned int   n = structure.n_nodes();
      for (unsigned int i = 0; i < n; ++i)
        frame.centre += Tensor<1, 3>(structure.position(i)) / n;
      for (unsigned int i = 0; i < n; ++i)
        frame.size =
          std::max(frame.size, structure.position(i).distance(frame.centre));
      return frame;
    }

    /** Columns x with A x = 0 for A^T A given; the rest of space in `rest`. */
    Eigen::MatrixXd
    null_columns(const Eigen::MatrixXd &gram)
    {
      if (gram.rows() == 0)
        return gram;
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
      const double limit = 1e-12 * std::max(1., eigen.eigenvalues().maxCoeff());
      Eigen::Index n_null = 0;
      while (n_null < gram.rows() && eigen.eigenvalues()[n_null] < limit)
        ++n_null;
      return eigen.eigenvectors().leftCols(n_null);
    }

    std::string
    direction_text(Tensor<1, 3> v)
    {
      v /= v.norm();
      for (unsigned int d = 0; d < 3; ++d)
        v[d] = std::round(1e4 * v[d]) / 1e4;
      for (unsigned int d = 3; d-- > 0;)
        if (v[d] != 0)
          return to_text(v);
      return to_text(v);
    }
  } // namespace

  RigidMotions::RigidMotions(const Bodies      &b,
                             const NodeRules   &rules,
                             const Coordinates &coordinates)
    : bodies(b)
  {
    const unsigned int dim   = bodies.dim;
    const Eigen::Index n_one = n_modes(dim);
    const Eigen::Index n_all =
      n_one * static_cast<Eigen::Index>(bodies.structures.size());
    for (unsigned int body = 0; body < bodies.structures.size(); ++body)
      frames.push_back(frame_of(body, *bodies.structures[body]));

    Eigen::VectorXd row(n_one);
    const auto      fill_row = [&](const unsigned int  body,
                              const Point<3>     &p,
                              const Tensor<1, 3> &direction) {
      for (unsigned int k = 0; k < n_one; ++k)
        row[k] = direction * mode(k, dim, frames[body], p);
    };

    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n_all, n_all);
    const auto      hold = [&](const unsigned int  body,
                          const Point<3>     &p,
                          const Tensor<1, 3> &direction) {
      fill_row(body, p, direction);
      gram.block(body * n_one, body * n_one, n_one, n_one) +=
        row * row.transpose();
    };
    for (const NodeRule &rule : rules.rules())
      {
        for (const HeldDirection &held : rule.held)
          hold(rule.body,
               bodies.structures[rule.body]->position(rule.node),
               held.direction);
        for (const NodeRule::HeldRotation &held : rule.rotations)
          gram(rule.body * n_one + held.component,
               rule.body * n_one + held.component) += 1;
      }
    for (const Support &support : bodies.supports)
      if (support.stiffness)
        for (const SurfaceNode &node : support.surface.nodes)
          if ((*support.stiffness)(node.position) > 0)
            for (const Support::Held &along : support.directions_at(node))
              hold(support.body, node.position, along.direction);
    free_modes = null_columns(gram);

    Eigen::MatrixXd seen(coordinates.n_contact_unknowns(), free_modes.cols());
    Eigen::Index    i = 0;
    for (const NodeRule *rule : coordinates.contact_rules())
      for (const Tensor<1, 3> &dual : rule->dual)
        {
          const ContactNode &node = *rule->contact_node;
          fill_row(rule->body, node.position, dual);
          seen.row(i) =
            row.transpose() * free_modes.middleRows(rule->body * n_one, n_one);
          for (const auto &[master, weight] : node.masters)
            {
              fill_row(node.master,
                       bodies.structures[node.master]->position(master),
                       weight * dual);
              seen.row(i) -= row.transpose() *
                             free_modes.middleRows(node.master * n_one, n_one);
            }
          ++i;
        }
    const Eigen::MatrixXd unseen = null_columns(seen.transpose() * seen);
    if (unseen.cols() > 0)
      {
        const Motion m = largest(free_modes * unseen.col(0));
        throw InputError("Nothing holds body '" + bodies.names[m.body] +
                         "' against moving " + describe(m) +
                         ": no support, and no contact with friction. Add a "
                         "Support, or friction to a Contact.");
      }
    contact_part = std::move(seen);
  }

  RigidMotions::Motion
  RigidMotions::motion(const Eigen::VectorXd &combination) const
  {
    return largest(free_modes * combination);
  }

  RigidMotions::Motion
  RigidMotions::largest(const Eigen::VectorXd &modes) const
  {
    const Eigen::Index n_one = n_modes(bodies.dim);
    std::size_t        best  = 0;
    for (std::size_t body = 1; body < frames.size(); ++body)
      if (modes.segment(static_cast<Eigen::Index>(body) * n_one, n_one).norm() >
          1.001 * modes.segment(static_cast<Eigen::Index>(best) * n_one, n_one)
                    .norm())
        best = body;
    Motion                motion = frames[best];
    const Eigen::VectorXd own =
      modes.segment(static_cast<Eigen::Index>(best) * n_one, n_one);
    for (unsigned int k = 0; k < n_one; ++k)
      if (k < bodies.dim)
        motion.translation[k] = own[k];
      else
        motion.rotation[bodies.dim == 2 ? 2 : k - bodies.dim] =
          own[k] / motion.size;
    return motion;
  }

  std::string
  describe(const RigidMotions::Motion &motion)
  {
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
} // namespace conetact
