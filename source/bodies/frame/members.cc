// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/frame/members.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace conetact::bodies
{
  namespace
  {
    Eigen::Vector3d
    to_eigen(const Tensor<1, 3> &v)
    {
      return {v[0], v[1], v[2]};
    }

    /** Rows: along the member, y and z of the section. */
    Eigen::Matrix3d
    local_axes(const Tensor<1, 3> &along,
               const Tensor<1, 3> &wanted,
               const std::string  &member)
    {
      const Eigen::Vector3d x     = to_eigen(along).normalized();
      const bool            given = wanted.norm() > 0;
      Eigen::Vector3d       v     = to_eigen(wanted).normalized();
      if (!given)
        // Upright members have no plane with the vertical.
        v = std::abs(x.z()) > 1 - 1e-9 ? Eigen::Vector3d::UnitX() :
                                         Eigen::Vector3d::UnitZ();
      Eigen::Vector3d y = v.cross(x);
      if (y.norm() < 1e-6)
        throw InputError("Orientation: the vector " + to_text(wanted) +
                         " points along member " + member +
                         ". Give another one, or a section of its own to "
                         "that member.");
      y.normalize();
      Eigen::Matrix3d axes;
      axes << x.transpose(), y.transpose(), x.cross(y).transpose();
      return axes;
    }
  } // namespace

  Member::Member(const FrameModel &model, const FrameMember &member)
    : ends(member.nodes)
    , hinges(member.hinges)
    , properties(&model.sections[member.section])
    , bending(properties->is_beam() && !(hinges[0] && hinges[1]))
    , start(model.nodes[ends[0]].position)
    , finish(model.nodes[ends[1]].position)
    , l(start.distance(finish))
    , axes(
        local_axes(finish - start,
                   properties->orientation,
                   model.nodes[ends[0]].name + "-" + model.nodes[ends[1]].name))
  {}

  Tensor<1, 3>
  Member::axis(const unsigned int i) const
  {
    return Tensor<1, 3>({axes(i, 0), axes(i, 1), axes(i, 2)});
  }

  std::vector<unsigned int>
  Member::active_dofs(const unsigned int dim) const
  {
    std::vector<unsigned int> dofs;
    for (unsigned int end = 0; end < 2; ++end)
      {
        for (unsigned int c = 0; c < dim; ++c)
          dofs.push_back(6 * end + c);
        if (turns_with(end))
          for (unsigned int c = dim == 2 ? 5 : 3; c < 6; ++c)
            dofs.push_back(6 * end + c);
      }
    return dofs;
  }

  Member::Matrix
  Member::full_stiffness() const
  {
    Matrix k = Matrix::Zero();
    // k = value v v^T for a strain v . u
    const auto add = [&](const double value, const Vector &v) {
      k += value * v * v.transpose();
    };
    const auto strain = [](const std::vector<std::pair<int, double>> &terms) {
      Vector v = Vector::Zero();
      for (const auto &[dof, factor] : terms)
        v[dof] = factor;
      return v;
    };
    const double e = properties->young_modulus;
    // E A / l times the square of the elongation; a bar has nothing else.
    add(e * properties->area / l, strain({{0, -1}, {6, 1}}));
    if (!bending)
      return k;
    add(properties->torsion / l, strain({{3, -1}, {9, 1}}));
    // constant and linear part of the curvature, about z and about y
    add(e * properties->inertia_z / l, strain({{5, -1}, {11, 1}}));
    add(3 * e * properties->inertia_z / l,
        strain({{1, 2 / l}, {5, 1}, {7, -2 / l}, {11, 1}}));
    add(e * properties->inertia_y / l, strain({{4, -1}, {10, 1}}));
    add(3 * e * properties->inertia_y / l,
        strain({{2, -2 / l}, {4, 1}, {8, 2 / l}, {10, 1}}));
    return k;
  }

  void
  Member::condense(Matrix &k, Vector &f) const
  {
    for (int end = 0; end < 2; ++end)
      if (bending && hinges[static_cast<std::size_t>(end)])
        for (int r = 6 * end + 3; r < 6 * end + 6; ++r)
          if (k(r, r) > 0) // out of the plane there is no stiffness
            {
              // No moment at the hinge: its rotation follows from the other
              // dofs, and what a load does to it goes to them.
              const Vector k_r = k.col(r);
              f -= k_r * (f[r] / k_r[r]);
              k -= k_r * k_r.transpose() / k_r[r];
              k.row(r).setZero();
              k.col(r).setZero();
              f[r] = 0;
            }
  }

  Member::Matrix
  Member::stiffness() const
  {
    Matrix k    = full_stiffness();
    Vector none = Vector::Zero();
    condense(k, none);
    Matrix rotation = Matrix::Zero();
    for (int i = 0; i < 12; i += 3)
      rotation.block<3, 3>(i, i) = axes;
    k = (rotation.transpose() * k * rotation).eval();
    // A rotation rounds both triangles differently.
    k.triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }

  Member::Vector
  Member::shape_forces(const double s, const LocalForce &force) const
  {
    Vector f        = Vector::Zero();
    f.segment<3>(0) = (1 - s) * force;
    f.segment<3>(6) = s * force;
    if (!bending)
      return f;
    // the cubic deflections less the linear ones
    const double bubble = s * (1 - s);
    const double w      = bubble * (1 - 2 * s);
    for (const int c : {1, 2})
      {
        f[c] += w * force[c];
        f[6 + c] -= w * force[c];
        // theta_z = dw_y/dx, theta_y = -dw_z/dx
        const double sign = c == 1 ? 1 : -1;
        f[6 - c] += sign * l * bubble * (1 - s) * force[c];
        f[12 - c] -= sign * l * bubble * s * force[c];
      }
    return f;
  }

  Member::Vector
  Member::local_forces(const MemberLoad &load) const
  {
    // Exact for cubic shapes times loads of degree 6.
    static const dealii::QGauss<1> gauss(5);
    Vector                         f = Vector::Zero();
    for (const VectorField &q : load.per_length)
      for (unsigned int i = 0; i < gauss.size(); ++i)
        {
          const double s = gauss.point(i)[0];
          f +=
            shape_forces(s, gauss.weight(i) * l * axes * to_eigen(q(point(s))));
        }
    for (const auto &[s, force] : load.points)
      f += shape_forces(s, axes * to_eigen(force));
    // Forces that would stretch the member as heat would if nothing resisted.
    const double n =
      properties->young_modulus * properties->area * load.initial_strain;
    f[0] -= n;
    f[6] += n;
    Matrix k = full_stiffness();
    condense(k, f);
    return f;
  }

  Member::Vector
  Member::forces(const MemberLoad &load) const
  {
    Vector f = local_forces(load);
    for (int i = 0; i < 12; i += 3)
      f.segment<3>(i) = (axes.transpose() * f.segment<3>(i)).eval();
    return f;
  }

  Member::Vector
  Member::to_local(const Vector &global) const
  {
    Vector local;
    for (int i = 0; i < 12; i += 3)
      local.segment<3>(i) = axes * global.segment<3>(i);
    return local;
  }

  Member::Vector
  Member::end_forces(const Vector &u, const MemberLoad &load) const
  {
    Matrix k    = full_stiffness();
    Vector none = Vector::Zero();
    condense(k, none);
    // Nodal forces that stand for the load are no forces of the nodes on the
    // member.
    return k * to_local(u) - local_forces(load);
  }
} // namespace conetact::bodies
