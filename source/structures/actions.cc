// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/structures/actions.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>

namespace conetact
{
  namespace
  {
    const std::vector<std::pair<std::string, Load::Kind>> load_kinds = {
      {"traction", Load::Kind::traction},
      {"pressure", Load::Kind::pressure},
      {"body force", Load::Kind::body_force},
      {"point force", Load::Kind::point_force}};

    Tensor<1, 3>
    parse_direction(const std::string &text,
                    const unsigned int dim,
                    const std::string &entry)
    {
      const std::string axes = std::string("xyz").substr(0, dim);
      const std::size_t axis = text.size() == 1 ? axes.find(text) : axes.npos;
      Tensor<1, 3>      direction;
      if (axis != axes.npos)
        direction[static_cast<unsigned int>(axis)] = 1;
      else if (!text.empty() && text.front() == '(')
        direction = to_vector(text, dim, entry);
      else
        throw InputError(entry + ": '" + text + "' is not a direction. Give " +
                         (dim == 2 ? "x, y" : "x, y, z") +
                         ", vectors such as " +
                         (dim == 2 ? "(1, 1)" : "(1, 1, 0)") + ", or normal.");
      if (direction.norm() == 0)
        throw InputError(entry + ": the direction " + text +
                         " has no length. Give a vector other than zero.");
      return direction / direction.norm();
    }

    std::vector<Expression>
    expand(std::vector<Expression> expressions,
           const std::string      &text,
           const std::size_t       n,
           const std::string      &entry)
    {
      if (expressions.size() == 1 && expressions[0].is_zero())
        while (expressions.size() < n)
          expressions.push_back(Expression("0", entry));
      if (expressions.size() != n)
        throw InputError(
          entry + ": '" + text + "' has " + std::to_string(expressions.size()) +
          (expressions.size() == 1 ? " expression" : " expressions") +
          ". Give " + std::to_string(n) + ", separated by ';'.");
      return expressions;
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
  } // namespace

  std::vector<Tensor<1, 3>>
  Support::directions_at(const Tensor<1, 3> &outward_normal) const
  {
    return normal ? std::vector<Tensor<1, 3>>{outward_normal} : directions;
  }

  Tensor<2, 3>
  Support::spring(const Point<3> &p, const Tensor<1, 3> &outward_normal) const
  {
    Tensor<2, 3> result;
    for (const Tensor<1, 3> &direction : directions_at(outward_normal))
      result += outer_product(direction, direction);
    const double k = (*stiffness)(p);
    if (k < 0)
      throw InputError("Support '" + name + "', Stiffness: it is " +
                       to_text(k) + " at " + to_text(p) +
                       ". Give a value of 0 or more.");
    return k * result;
  }

  void
  Load::add(const Structure &structure,
            const double     t,
            Eigen::VectorXd &f) const
  {
    switch (kind)
      {
        case Kind::traction:
          structure.add_traction(
            ids,
            [&](const Point<3> &p, const Tensor<1, 3> &) {
              return evaluate(value, p, t);
            },
            f);
          break;
        case Kind::pressure:
          structure.add_traction(
            ids,
            [&](const Point<3> &p, const Tensor<1, 3> &normal) {
              return -value[0](p, t) * normal;
            },
            f);
          break;
        case Kind::body_force:
          structure.add_body_force(
            [&](const Point<3> &p) { return evaluate(value, p, t); }, f);
          break;
        case Kind::point_force:
          if (!structure.add_point_force(point, evaluate(value, point, t), f))
            throw InputError("Load '" + name + "', Point: " + to_text(point) +
                             " lies outside the body. Give a point of the " +
                             "body, in the coordinates of the scene.");
          break;
      }
  }

  void
  declare_support(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Body", "", Anything(), "Name of the body it holds.");
    prm.declare_entry("Boundary ids",
                      "",
                      Anything(),
                      "Boundary ids of the body, separated by commas.");
    prm.declare_entry(
      "Directions",
      "",
      Anything(),
      "What is held: components (x, y, z), the outward 'normal' of each node, "
      "or any vectors such as (1, 1): rollers on a rotated body. Separated by "
      "commas. Empty: all components.");
    prm.declare_entry(
      "Displacement",
      "0",
      Anything(),
      "Prescribed displacement along each direction, a function of x, y, z, t "
      "each, separated by ';'. A single 0 holds all. [length]");
    prm.declare_entry(
      "Stiffness",
      "",
      Anything(),
      "Empty: the displacement is prescribed exactly. Else springs per area "
      "along each direction, a function of x, y, z: an elastic foundation, "
      "whose far end moves by Displacement. [force/length/area]");
  }

  void
  declare_load(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Body", "", Anything(), "Name of the body it acts on.");
    prm.declare_entry("Kind",
                      "traction",
                      Selection("traction|pressure|body force|point force"),
                      "traction [force/area] and pressure [force/area, against "
                      "the outward normal] act on boundary ids, body force "
                      "[force/volume] on the whole body, point force [force] "
                      "at Point, distributed by the shape functions of the "
                      "cell that holds the point.");
    prm.declare_entry("Boundary ids",
                      "",
                      Anything(),
                      "For traction and pressure: boundary ids of the body, "
                      "separated by commas.");
    prm.declare_entry("Point",
                      "",
                      Anything(),
                      "For a point force: where it acts. [length]");
    prm.declare_entry("Value",
                      "0",
                      Anything(),
                      "Components, functions of x, y, z, t, separated by ';' "
                      "(pressure: one). In 2D tractions and body forces act "
                      "over the body's thickness, point forces are whole "
                      "forces. [by Kind]");
  }

  unsigned int
  find_body(const std::string              &body,
            const std::vector<std::string> &bodies,
            const std::string              &entry)
  {
    const auto found = std::find(bodies.begin(), bodies.end(), body);
    if (found == bodies.end())
      throw InputError(
        entry + ": " +
        (body.empty() ? "it is empty" : "there is no body '" + body + "'") +
        ". Give one of: " + join(bodies) + ".");
    return static_cast<unsigned int>(found - bodies.begin());
  }

  BoundaryIds
  find_boundary(const std::string &text,
                const Structure   &structure,
                const std::string &body,
                const std::string &entry)
  {
    const BoundaryIds ids   = to_ids(text, entry);
    const BoundaryIds known = structure.boundary_ids();
    for (const unsigned int id : ids)
      if (known.count(id) == 0)
        throw InputError(entry + ": no face of body '" + body + "' has id " +
                         std::to_string(id) + ". It has: " + join(known) +
                         "; more are tagged by Mesh/Boundary ids.");
    return ids;
  }

  Support
  create_support(dealii::ParameterHandler             &prm,
                 const std::string                    &name,
                 const unsigned int                    dim,
                 const std::vector<std::string>       &bodies,
                 const std::vector<const Structure *> &structures)
  {
    const std::string in = "Support '" + name + "', ";
    Support           support;
    support.name = name;
    support.body = find_body(prm.get("Body"), bodies, in + "Body");
    support.ids  = find_boundary(prm.get("Boundary ids"),
                                *structures[support.body],
                                bodies[support.body],
                                in + "Boundary ids");

    const std::string directions = prm.get("Directions");
    support.normal               = directions == "normal";
    if (!support.normal)
      for (const std::string &part :
           split(directions.empty() ? (dim == 2 ? "x, y" : "x, y, z") :
                                      directions,
                 ','))
        support.directions.push_back(
          parse_direction(part, dim, in + "Directions"));

    const std::string displacement = prm.get("Displacement");
    support.displacement =
      expand(parse_expressions(displacement, in + "Displacement"),
             displacement,
             support.normal ? 1 : support.directions.size(),
             in + "Displacement");
    if (const std::string stiffness = prm.get("Stiffness"); !stiffness.empty())
      {
        support.stiffness.emplace(stiffness, in + "Stiffness");
        if (support.stiffness->uses_time())
          throw InputError(in + "Stiffness: '" + stiffness +
                           "' depends on t. Springs stay the same: use x, y, "
                           "z only.");
      }
    return support;
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
    if (load.kind == Load::Kind::traction || load.kind == Load::Kind::pressure)
      load.ids = find_boundary(prm.get("Boundary ids"),
                               *structures[load.body],
                               bodies[load.body],
                               in + "Boundary ids");
    if (load.kind == Load::Kind::point_force)
      load.point = Point<3>(to_vector(prm.get("Point"), dim, in + "Point"));
    const std::string value = prm.get("Value");
    load.value              = expand(parse_expressions(value, in + "Value"),
                        value,
                        load.kind == Load::Kind::pressure ? 1 : dim,
                        in + "Value");
    return load;
  }
} // namespace conetact
