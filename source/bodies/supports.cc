// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/supports.h"

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"
#include "conetact/bodies/placement.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <set>

namespace conetact::bodies
{
  namespace
  {
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
      else if (text == "normal")
        throw InputError(entry + ": normal stands alone. Let one support hold "
                                 "along the normal and another one along other "
                                 "directions.");
      else
        throw InputError(entry + ": '" + text + "' is not a direction. Give " +
                         (dim == 2 ? "x, y, rz" : "x, y, z, rx, ry, rz") +
                         ", vectors such as " +
                         (dim == 2 ? "(1, 1)" : "(1, 1, 0)") +
                         ", normal, separated by commas, or clamped.");
      if (direction.norm() == 0)
        throw InputError(entry + ": the direction " + text +
                         " has no length. Give a vector other than zero.");
      return direction / direction.norm();
    }
    /**
     * The component of a rotation "rx", "ry" or "rz", or none: 2 in 2D; 3, 4,
     * 5 in 3D.
     */
    std::optional<unsigned int>
    rotation_component(const std::string &text, const unsigned int dim)
    {
      if (text == "rz")
        return dim == 2 ? 2 : 5;
      if (dim == 3 && (text == "rx" || text == "ry"))
        return text == "rx" ? 3 : 4;
      return {};
    }

    /** Words of the entry; empty and "clamped" stand for several. */
    std::vector<std::string>
    direction_words(const std::string &text,
                    const unsigned int dim,
                    const bool         rotates)
    {
      if (!text.empty() && text != "clamped")
        return split(text, ',');
      std::vector<std::string> words = {"x", "y"};
      if (dim == 3)
        words.push_back("z");
      if (text == "clamped" && rotates && dim == 3)
        words.insert(words.end(), {"rx", "ry"});
      if (text == "clamped" && rotates)
        words.push_back("rz");
      return words;
    }

    /** Directions and rotations, each with its expression. */
    void
    parse_directions(const std::string &text,
                     const std::string &displacement,
                     const unsigned int dim,
                     const Structure   &structure,
                     const std::string &in,
                     Support           &support)
    {
      const bool rotates = structure.n_components() > dim;
      const auto words   = direction_words(text, dim, rotates);
      for (const std::string &word : words)
        if (!rotation_component(word, dim))
          parse_direction(word, dim, in + "Directions");
      auto expressions =
        parse_components(displacement, words.size(), in + "Displacement");
      for (std::size_t i = 0; i < words.size(); ++i)
        if (const auto component = rotation_component(words[i], dim))
          {
            if (!rotates)
              throw InputError(in + "Directions: '" + words[i] +
                               "' is a rotation, but nodes of the body do not "
                               "rotate, it has no beams. Remove it.");
            support.rotations.push_back(
              {*component, std::move(expressions[i])});
          }
        else
          {
            support.directions.push_back(
              parse_direction(words[i], dim, in + "Directions"));
            support.displacement.push_back(std::move(expressions[i]));
          }
    }
  } // namespace

  std::vector<Support::Held>
  Support::directions_at(const SurfaceNode &node) const
  {
    // a mean normal at an edge would leave the body free to slip out of it
    std::vector<Held> held;
    if (normal)
      for (const Tensor<1, 3> &n : node.normals)
        held.push_back({n, 0});
    else
      for (std::size_t e = 0; e < directions.size(); ++e)
        held.push_back({directions[e], e});
    return held;
  }

  double
  Support::displaced(const std::size_t e,
                     const Point<3>   &p,
                     const double      t) const
  {
    AssertIndexRange(e, displacement.size());
    Assert(!turn || e < directions.size(),
           dealii::ExcMessage("What turns is held along directions."));
    double u = displacement[e](p, t);
    if (turn)
      {
        const Tensor<1, 3> arm = p - turn->centre;
        u += directions[e] *
             (rotation_about(turn->axis, turn->angle(p, t)) * arm - arm);
      }
    return u;
  }

  void
  Support::release()
  {
    surface = {};
    normal  = false;
    directions.clear();
    displacement.clear();
    stiffness.reset();
    turn.reset();
    rotations.clear();
  }

  bool
  Support::is_still() const
  {
    return !turn &&
           std::all_of(displacement.begin(),
                       displacement.end(),
                       [](const Expression &u) { return u.is_zero(); }) &&
           std::all_of(rotations.begin(),
                       rotations.end(),
                       [](const Rotation &r) { return r.angle.is_zero(); });
  }

  Tensor<2, 3>
  Support::spring(const Point<3> &p, const Tensor<1, 3> &outward_normal) const
  {
    Tensor<2, 3> result;
    for (const Tensor<1, 3> &direction :
         normal ? std::vector<Tensor<1, 3>>{outward_normal} : directions)
      result += outer_product(direction, direction);
    const double k = (*stiffness)(p);
    if (k < 0)
      throw InputError("Support '" + name + "', Stiffness: it is " +
                       to_text(k) + " at " + to_text(p) +
                       ". Give a value of 0 or more.");
    return k * result;
  }

  namespace
  {
    /** Supports that turn hold all components: rollers would stay behind. */
    void
    read_turn(dealii::ParameterHandler &prm,
              const unsigned int        dim,
              const Structure          &structure,
              const std::string        &in,
              Support                  &support)
    {
      Expression angle(prm.get("Turn"), in + "Turn");
      if (angle.uses_space())
        throw InputError(in + "Turn: '" + prm.get("Turn") +
                         "' depends on position. What a support holds turns "
                         "as a whole: use t only.");
      const Tensor<1, 3> axis = turn_axis(prm.get("Turn axis"), dim, in);
      if (angle.is_zero())
        return;
      if (support.normal || support.directions.size() != dim)
        throw InputError(in + "Turn: a support that turns holds all "
                              "components. Leave Directions empty.");
      if (support.stiffness)
        throw InputError(in + "Turn: springs do not turn. Leave Stiffness "
                              "empty, or Turn 0.");
      if (structure.is_axisymmetric())
        throw InputError(in + "Turn: a body of revolution turns about its axis "
                              "without moving, and about no other. Leave it "
                              "0.");
      if (structure.n_components() > dim || structure.may_be_mechanism())
        throw InputError(in + "Turn: it is for bodies of cells, not for bars "
                              "and beams. Prescribe a Displacement.");
      const std::string centre = prm.get("Reference point");
      support.turn =
        Support::Turn{std::move(angle),
                      axis,
                      centre.empty() ?
                        Point<3>() :
                        Point<3>(
                          to_vector(centre, dim, in + "Reference point"))};
    }
  } // namespace

  std::optional<Support>
  axis_support(const Structure   &structure,
               const unsigned int body,
               const std::string &body_name)
  {
    std::set<unsigned int> hanging; // follow what is held
    for (const HangingNode &node : structure.hanging_nodes())
      hanging.insert(node.node);
    Support support;
    support.name = "axis of body " + body_name;
    support.body = body;
    support.directions.push_back(Tensor<1, 3>({1., 0., 0.}));
    support.displacement.emplace_back("0", support.name);
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      if (structure.position(i)[0] == 0 && hanging.count(i) == 0)
        support.surface.nodes.push_back({i, structure.position(i), 0, {}, {}});
    if (support.surface.nodes.empty())
      return {};
    return support;
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
    prm.declare_entry("Active",
                      "1",
                      Anything(),
                      "A function of t for stages of an assembly: where it is "
                      "0 at the end of an increment the support holds "
                      "nothing; elsewhere it holds, at its Displacement. "
                      "Where stages change the run goes on from a checkpoint, "
                      "so nodes of contacts must be held alike in all stages. "
                      "[-]");
    prm.declare_entry(
      "Directions",
      "",
      Anything(),
      "What is held: components (x, y, z), the outward 'normal' of each node "
      "(on an edge where faces turn by more than 40 degrees, the normal of "
      "each), or any vectors such as (1, 1): rollers on a rotated body; rotations of "
      "nodes of beams (2D: rz; 3D: rx, ry, rz). Separated by commas. Empty: "
      "all components; 'clamped': all components and rotations.");
    prm.declare_entry(
      "Displacement",
      "0",
      Anything(),
      "Prescribed displacement along each direction, a function of x, y, z, t "
      "each, separated by ';'. A single 0 holds all. [length; rad]");
    prm.declare_entry(
      "Stiffness",
      "",
      Anything(),
      "Empty: the displacement is prescribed exactly. Otherwise the support "
      "is an elastic foundation: it has springs of this stiffness per area "
      "along each direction, and their far end moves by Displacement. It is a "
      "function of x, y, z. [force/length/area]");
    prm.declare_entry(
      "Turn",
      "0",
      Anything(),
      "Angle by which all that the support holds has turned about its "
      "Reference point since the start, a function of t. It may be any angle. "
      "Displacement comes on top of it. The support must hold all components. "
      "[degrees]");
    prm.declare_entry("Turn axis",
                      "0, 0, 1",
                      Anything(),
                      "Axis of Turn, three components; in 2D it is z.");
    prm.declare_entry("Reference point",
                      "",
                      Anything(),
                      "Turn is about this point. Empty: the origin. [length]");
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
    support.name    = name;
    support.body    = find_body(prm.get("Body"), bodies, in + "Body");
    support.ids     = find_boundary(prm.get("Boundary ids"),
                                *structures[support.body],
                                bodies[support.body],
                                in + "Boundary ids");
    support.surface = structures[support.body]->surface(support.ids);

    const std::string directions   = prm.get("Directions");
    support.normal                 = directions == "normal";
    const std::string displacement = prm.get("Displacement");
    if (support.normal)
      support.displacement =
        parse_components(displacement, 1, in + "Displacement");
    else
      parse_directions(
        directions, displacement, dim, *structures[support.body], in, support);
    if (const std::string stiffness = prm.get("Stiffness"); !stiffness.empty())
      {
        support.stiffness.emplace(stiffness, in + "Stiffness");
        if (support.stiffness->uses_time())
          throw InputError(in + "Stiffness: '" + stiffness +
                           "' depends on t. Springs stay the same: use x, y, "
                           "z only.");
        if (!support.rotations.empty())
          throw InputError(in + "Stiffness: springs do not hold rotations. "
                                "Hold them by a support of their own.");
      }
    read_turn(prm, dim, *structures[support.body], in, support);
    return support;
  }
} // namespace conetact::bodies
