// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/loads.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    Tensor<1, 3>
    evaluate(const std::vector<Expression> &value,
             const Point<3>                &p,
             const double                   t)
    {
      Tensor<1, 3> vector;
      for (unsigned int d = 0; d < value.size(); ++d)
        vector[d] = value[d](p, t);
      return vector;
    }

    /** Forces, and moments where there are as many values as dofs. */
    void
    add_nodal_forces(const Load      &load,
                     const Structure &structure,
                     const double     t,
                     Eigen::VectorXd &f)
    {
      const unsigned int n = structure.n_components();
      for (const SurfaceNode &node : structure.surface(load.ids).nodes)
        for (unsigned int c = 0; c < load.value.size(); ++c)
          {
            const double value = load.value[c](node.position, t);
            if (value != 0 && !structure.has_dof(node.node, c))
              throw InputError("Load '" + load.name + "', Value: the node at " +
                               to_text(node.position) +
                               " does not rotate, only bars and hinges meet "
                               "there. Remove the moment.");
            f[n * node.node + c] += value;
          }
    }

    std::string
    why_nothing_takes(const Action &action)
    {
      if (action.kind == Action::Kind::point_force)
        return "Point: " + to_text(action.point) +
               " lies outside the body. Give a point of the body, in the "
               "coordinates of the scene.";
      if (action.kind == Action::Kind::line_load)
        return "Boundary ids: a line load acts on the members of a frame, and "
               "none has both its nodes there. Give a member 'group', or use a "
               "traction.";
      return "Body: nothing in it strains of itself. Choose another body.";
    }

    /** A force or a moment on a rigid body. */
    void
    add_at_first_node(const Load      &load,
                      const Structure &structure,
                      const double     t,
                      Eigen::VectorXd &f)
    {
      const std::size_t n     = load.value.size(),
                        first = load.kind == Load::Kind::moment ?
                                  structure.n_components() - n :
                                  0;
      for (std::size_t c = 0; c < n; ++c)
        f[static_cast<Eigen::Index>(first + c)] += load.value[c](load.point, t);
    }
  } // namespace

  bool
  Load::uses_time() const
  {
    return (active && active->uses_time()) ||
           std::any_of(value.begin(), value.end(), [](const Expression &e) {
             return e.uses_time();
           });
  }

  bool
  Load::is_zero() const
  {
    return std::all_of(value.begin(), value.end(), [](const Expression &e) {
      return e.is_zero();
    });
  }

  /* In the axes of the body. In the plane a moment is about z. */
  Tensor<1, 3>
  Load::total(const double t, const Tensor<2, 3> &turn) const
  {
    const Tensor<1, 3> v = evaluate(value, point, t);
    return kind == Kind::moment && value.size() == 1 ?
             Tensor<1, 3>({0, 0, v[0]}) :
             Tensor<1, 3>(transpose(turn) * v);
  }

  Tensor<1, 3>
  Load::spread_traction(const Point<3> &p, const Tensor<1, 3> &total) const
  {
    return kind == Kind::moment ?
             spread->traction(p, {}, total) :
             spread->traction(
               p,
               total,
               dealii::cross_product_3d(point - spread->centroid(), total));
  }

  Tensor<1, 3>
  Load::centrifugal_force(const Point<3> &p, const double t) const
  {
    const Tensor<1, 3> from = p - point;
    const double       w    = value[0](p, t);
    return density * w * w * (from - (from * axis) * axis);
  }

  InitialStrain
  Load::initial_strain(const Point<3> &p, const double t) const
  {
    InitialStrain initial;
    if (kind == Kind::temperature)
      initial.temperature = value[0](p, t);
    for (std::size_t k = 0; k < axes.size(); ++k)
      initial.strain[axes[k].first][axes[k].second] =
        initial.strain[axes[k].second][axes[k].first] = value[k](p, t);
    return initial;
  }

  std::optional<Action>
  Load::action(const double t, const Tensor<2, 3> &turn) const
  {
    if (is_rigid)
      return {};
    const SurfaceField vector = [this, t](const Point<3> &p,
                                          const Tensor<1, 3> &) {
      return evaluate(value, p, t);
    };
    const SurfaceField inward = [this, t](const Point<3>     &p,
                                          const Tensor<1, 3> &normal) {
      return -value[0](p, t) * normal;
    };
    switch (kind)
      {
        case Kind::traction:
          return Action::traction(ids, vector);
        case Kind::pressure:
          return Action::traction(ids, inward);
        case Kind::force:
        case Kind::moment:
          return Action::traction(ids,
                                  [this,
                                   sum = total(t, turn)](const Point<3> &p,
                                                         const Tensor<1, 3> &) {
                                    return spread_traction(p, sum);
                                  });
        case Kind::bearing:
          return Action::traction(ids, spread->bearing(total(t, turn)));
        case Kind::centrifugal:
          return Action::body_force(
            [this, t](const Point<3> &p) { return centrifugal_force(p, t); });
        case Kind::body_force:
          return Action::body_force(
            [this, t](const Point<3> &p) { return evaluate(value, p, t); });
        case Kind::point_force:
          return Action::point_force(point, evaluate(value, point, t));
        case Kind::line_load:
          return Action::line_load(ids, vector);
        case Kind::temperature:
        case Kind::initial_strain:
          return Action::initial_strains(
            [this, t](const Point<3> &p) { return initial_strain(p, t); });
        default:
          return {};
      }
  }

  void
  Load::add(const Structure    &structure,
            const double        t,
            Eigen::VectorXd    &f,
            const Tensor<2, 3> &turn) const
  {
    if (!is_active(t))
      return;
    const std::string           in = "Load '" + name + "', ";
    const std::optional<Action> a  = action(t, turn);
    if (is_rigid)
      add_at_first_node(*this, structure, t, f);
    else if (!a)
      add_nodal_forces(*this, structure, t, f);
    else if (kind == Kind::temperature && !structure.expands())
      {
        if (!warms_contacts)
          throw InputError(in + "Body: nothing in it expands. Set Expansion "
                                "coefficient in its Material or Sections.");
      }
    else if (!structure.add(*a, f))
      throw InputError(in + why_nothing_takes(*a));
  }
} // namespace conetact::bodies
