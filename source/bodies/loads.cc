// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/loads.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"

#include <algorithm>

namespace conetact::bodies
{
  namespace
  {
    const std::vector<std::pair<std::string, Load::Kind>> load_kinds = {
      {"traction", Load::Kind::traction},
      {"pressure", Load::Kind::pressure},
      {"body force", Load::Kind::body_force},
      {"point force", Load::Kind::point_force},
      {"nodal force", Load::Kind::nodal_force},
      {"line load", Load::Kind::line_load},
      {"temperature", Load::Kind::temperature}};

    bool
    has_ids(const Load::Kind kind)
    {
      return kind == Load::Kind::traction || kind == Load::Kind::pressure ||
             kind == Load::Kind::nodal_force || kind == Load::Kind::line_load;
    }
    bool
    is_scalar(const Load::Kind kind)
    {
      return kind == Load::Kind::pressure || kind == Load::Kind::temperature;
    }

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
  } // namespace

  bool
  Load::uses_time() const
  {
    return std::any_of(value.begin(), value.end(), [](const Expression &e) {
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

  std::optional<Action>
  Load::action(const double t) const
  {
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
          return Action{Action::Kind::traction, ids, {}, vector, {}};
        case Kind::pressure:
          return Action{Action::Kind::traction, ids, {}, inward, {}};
        case Kind::body_force:
          return Action{Action::Kind::body_force, {}, {}, vector, {}};
        case Kind::point_force:
          return Action{Action::Kind::point_force, {}, point, vector, {}};
        case Kind::line_load:
          return Action{Action::Kind::line_load, ids, {}, vector, {}};
        case Kind::temperature:
          return Action{Action::Kind::temperature,
                        {},
                        {},
                        {},
                        [this, t](const Point<3> &p) {
                          return value[0](p, t);
                        }};
        default:
          return {};
      }
  }

  void
  Load::add(const Structure &structure,
            const double     t,
            Eigen::VectorXd &f) const
  {
    const std::string           in = "Load '" + name + "', ";
    const std::optional<Action> a  = action(t);
    if (!a)
      add_nodal_forces(*this, structure, t, f);
    else if (a->kind == Action::Kind::traction)
      structure.add_traction(ids, a->force, f);
    else if (a->kind == Action::Kind::body_force)
      structure.add_body_force(
        [&](const Point<3> &p) { return a->force(p, Tensor<1, 3>()); }, f);
    else if (a->kind == Action::Kind::point_force &&
             !structure.add_point_force(point,
                                        a->force(point, Tensor<1, 3>()),
                                        f))
      throw InputError(in + "Point: " + to_text(point) +
                       " lies outside the body. Give a point of the body, in "
                       "the coordinates of the scene.");
    else if (a->kind == Action::Kind::line_load &&
             !structure.add_line_load(ids, a->force, f))
      throw InputError(in + "Boundary ids: a line load acts on the members of "
                            "a frame, and none has both its nodes there. "
                            "Give a member 'group', or use a traction.");
    else if (a->kind == Action::Kind::temperature &&
             !structure.add_temperature(a->temperature, f))
      throw InputError(in + "Body: nothing in it expands. Set Expansion "
                            "coefficient in its Material or Sections.");
  }

  void
  declare_load(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    std::string kinds;
    for (const auto &[text, kind] : load_kinds)
      kinds += (kinds.empty() ? "" : "|") + text;
    prm.declare_entry("Body", "", Anything(), "Name of the body it acts on.");
    prm.declare_entry("Kind",
                      "traction",
                      Selection(kinds),
                      "traction [force/area] and pressure [force/area, against "
                      "the outward normal] act on boundary ids, body force "
                      "[force/volume] on the whole body, point force [force] "
                      "at Point, distributed by the shape functions of the "
                      "cell or member that holds the point, nodal force "
                      "[force, force x length] at each node of boundary ids, "
                      "line load [force/length] on the members of a frame "
                      "with boundary ids, temperature [K] is a change of "
                      "temperature of the whole body.");
    prm.declare_entry("Boundary ids",
                      "",
                      Anything(),
                      "For traction, pressure, nodal force and line load: "
                      "boundary ids of the body, separated by commas.");
    prm.declare_entry("Point",
                      "",
                      Anything(),
                      "For a point force: where it acts. [length]");
    prm.declare_entry("Value",
                      "0",
                      Anything(),
                      "Components, functions of x, y, z, t, separated by ';' "
                      "(pressure, temperature: one). Moments may follow the "
                      "components of a nodal force on beams (2D: m_z; 3D: "
                      "m_x, m_y, m_z). In 2D tractions and body forces act "
                      "over the body's thickness, other forces are whole "
                      "ones. [by Kind]");
  }

  Load
  create_load(dealii::ParameterHandler             &prm,
              const std::string                    &name,
              const unsigned int                    dim,
              const std::vector<std::string>       &bodies,
              const std::vector<const Structure *> &structures)
  {
    const std::string in = "Load '" + name + "', ";
    Load              load;
    load.name = name;
    load.body = find_body(prm.get("Body"), bodies, in + "Body");
    for (const auto &[text, kind] : load_kinds)
      if (text == prm.get("Kind"))
        load.kind = kind;
    if (has_ids(load.kind))
      load.ids = find_boundary(prm.get("Boundary ids"),
                               *structures[load.body],
                               bodies[load.body],
                               in + "Boundary ids");
    if (load.kind == Load::Kind::point_force)
      load.point = Point<3>(to_vector(prm.get("Point"), dim, in + "Point"));
    const std::string value = prm.get("Value");
    std::size_t       n     = is_scalar(load.kind) ? 1 : dim;
    const auto        given = split(value, ';').size();
    const auto        all = std::size_t{structures[load.body]->n_components()};
    if (load.kind == Load::Kind::nodal_force && given == all)
      n = all; // with moments
    load.value = parse_components(value, n, in + "Value");
    return load;
  }
} // namespace conetact::bodies
