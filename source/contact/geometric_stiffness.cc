// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/geometric_stiffness.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace conetact::contact
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector3d;

    Vector3d
    vector(const Tensor<1, 3> &v)
    {
      return {v[0], v[1], v[2]};
    }

    /** What turns of a body need to know of forces on it. */
    struct Virial
    {
      Matrix3d     sum   = Matrix3d::Zero(); ///< of x f^T [force * length]
      double       terms = 0;                ///< of |x| |f|
      Tensor<1, 3> force;                    ///< resultant

      void
      add(const Tensor<1, 3> &x, const Tensor<1, 3> &f)
      {
        sum += vector(x) * vector(f).transpose();
        terms += x.norm() * f.norm();
        force += f;
      }
    };

    Virial
    virial_of(const ContactModel    &model,
              const unsigned int     body,
              const Eigen::VectorXd &forces)
    {
      const bodies::Structure &structure = *model.bodies.structures[body];
      Virial                   virial;
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        virial.add(structure.position(i) - model.motions.centre(body),
                   model.coordinates.at_node(forces, body, i));
      return virial;
    }

    /** A node of a side, and how far its body may go along a force before it
     * touches there. */
    struct Rest
    {
      Tensor<1, 3> x;
      double       way = std::numeric_limits<double>::max();
    };

    /** Where a body would come to rest along a force, both in its frame. */
    std::optional<Tensor<1, 3>>
    rest_along(const Tensor<1, 3> &force,
               const unsigned int  body,
               const ContactModel &model)
    {
      Rest       first;
      const auto look_at =
        [&](const unsigned int i, const Tensor<1, 3> &n, const double gap) {
          const double closes = -(model.bodies.in_frame(body, n) * force);
          if (closes > 1e-3 * force.norm() && gap / closes < first.way)
            first = {model.bodies.structures[body]->position(i) -
                       model.motions.centre(body),
                     gap / closes};
        };
      for (const pairing::ContactNode &node : model.points.nodes())
        if (!node.meets_nothing() && !node.is_tied())
          {
            if (node.body == body)
              look_at(node.node, node.n, node.gap);
            if (node.obstacle == nullptr && node.master == body)
              for (const auto &[master, weight] : node.masters)
                look_at(master, -node.n, node.gap);
          }
      if (first.way == std::numeric_limits<double>::max())
        return {};
      return first.x;
    }

    /** tr V I - V, its symmetric part without what is negative, where only the
     * turns that amounts have count. */
    Eigen::MatrixXd
    resistance(const Virial &virial, const unsigned int dim)
    {
      constexpr double none = 1e-9; // over the terms of the sum
      const Matrix3d   all  = virial.sum.trace() * Matrix3d::Identity() -
                           .5 * (virial.sum + virial.sum.transpose());
      const Eigen::Index    n     = dim == 2 ? 1 : 3;
      const Eigen::MatrixXd turns = all.bottomRightCorner(n, n);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(turns);
      const Eigen::VectorXd                                values =
        eigen.eigenvalues().unaryExpr([&](const double value) {
          return value > none * virial.terms ? value : 0;
        });
      return eigen.eigenvectors() * values.asDiagonal() *
             eigen.eigenvectors().transpose();
    }

    /** What is tied turns as one: its first body has the sum. */
    Eigen::MatrixXd
    blocks_of(const std::vector<Virial> &virials, const ContactModel &model)
    {
      const unsigned int  dim = model.bodies.dim;
      const auto          n   = static_cast<unsigned int>(virials.size());
      std::vector<Virial> of_assembly(n);
      for (unsigned int body = 0; body < n; ++body)
        {
          Virial &sum = of_assembly[model.motions.first_tied(body)];
          sum.sum += virials[body].sum;
          sum.terms += virials[body].terms;
        }
      const Eigen::Index n_one = model.motions.none().size() / n;
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(model.motions.none().size(),
                                                  model.motions.none().size());
      for (unsigned int body = 0; body < n; ++body)
        if (model.frames.has(body) && of_assembly[body].terms > 0)
          {
            const Eigen::MatrixXd C = resistance(of_assembly[body], dim) /
                                      std::pow(model.motions.size(body), 2);
            const Eigen::Index first                    = body * n_one + dim;
            all.block(first, first, C.rows(), C.cols()) = C;
          }
      const Eigen::MatrixXd &own = model.motions.own();
      if ((own.transpose() * all * own).isZero(0))
        return {};
      return all;
    }
  } // namespace

  Eigen::MatrixXd
  geometric_stiffness(const ContactModel &model, const Eigen::VectorXd &forces)
  {
    AssertDimension(forces.size(), model.coordinates.n_dofs());
    std::vector<Virial> virials;
    for (unsigned int b = 0; b < model.bodies.structures.size(); ++b)
      virials.push_back(model.frames.has(b) ? virial_of(model, b, forces) :
                                              Virial());
    return blocks_of(virials, model);
  }

  Eigen::MatrixXd
  geometric_stiffness_of_loads(const ContactModel    &model,
                               const Eigen::VectorXd &loads)
  {
    AssertDimension(loads.size(), model.coordinates.n_dofs());
    std::vector<Virial> virials(model.bodies.structures.size());
    for (unsigned int b = 0; b < virials.size(); ++b)
      if (model.frames.has(b))
        {
          Virial     virial = virial_of(model, b, loads);
          const auto rest   = rest_along(virial.force, b, model);
          if (!rest)
            continue;
          virial.add(*rest, -virial.force);
          virials[b] = virial;
        }
    return blocks_of(virials, model);
  }
} // namespace conetact::contact
