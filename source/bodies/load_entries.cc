// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What scenes say of loads.

#include "conetact/base/errors.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/entries.h"
#include "conetact/bodies/loads.h"

#include <algorithm>
#include <sstream>

namespace conetact::bodies
{
  namespace
  {
    const std::vector<std::pair<std::string, Load::Kind>> load_kinds = {
      {"traction", Load::Kind::traction},
      {"pressure", Load::Kind::pressure},
      {"body force", Load::Kind::body_force},
      {"centrifugal", Load::Kind::centrifugal},
      {"point force", Load::Kind::point_force},
      {"force", Load::Kind::force},
      {"moment", Load::Kind::moment},
      {"bearing", Load::Kind::bearing},
      {"nodal force", Load::Kind::nodal_force},
      {"line load", Load::Kind::line_load},
      {"temperature", Load::Kind::temperature},
      {"initial strain", Load::Kind::initial_strain}};

    std::string
    all_digits(const double number)
    {
      std::ostringstream text;
      text.precision(17);
      text << number;
      return text.str();
    }

    bool
    is_spread(const Load::Kind kind)
    {
      return kind == Load::Kind::force || kind == Load::Kind::moment ||
             kind == Load::Kind::bearing;
    }
    bool
    has_ids(const Load::Kind kind)
    {
      return kind == Load::Kind::traction || kind == Load::Kind::pressure ||
             kind == Load::Kind::nodal_force || kind == Load::Kind::line_load ||
             is_spread(kind);
    }
    bool
    is_scalar(const Load::Kind kind)
    {
      return kind == Load::Kind::pressure || kind == Load::Kind::temperature ||
             kind == Load::Kind::centrifugal;
    }

    bool
    is_rigid(const dealii::ParameterHandler &prm)
    {
      return prm.get("Coupling") == "rigid";
    }

    /** What a kind of load does not read. */
    void
    refuse_idle(const dealii::ParameterHandler &prm,
                const Load::Kind                kind,
                const std::string              &in)
    {
      const bool couples =
        kind == Load::Kind::force || kind == Load::Kind::moment;
      const bool acts_at_point =
        kind == Load::Kind::point_force || kind == Load::Kind::force ||
        kind == Load::Kind::centrifugal || (couples && is_rigid(prm));
      if (is_rigid(prm) && !couples)
        throw InputError(in + "Coupling: a load of Kind = " + prm.get("Kind") +
                         " acts where it is given. rigid is for Kind = force "
                         "and moment: remove the entry, or choose one of "
                         "these.");
      for (const auto &[entry, reads] :
           {std::pair("Boundary ids", has_ids(kind)),
            std::pair("Point", acts_at_point),
            std::pair("Axis", kind == Load::Kind::centrifugal)})
        if (!reads && !prm.get(entry).empty())
          throw InputError(in + entry + ": a load of Kind = " +
                           prm.get("Kind") + " does not know it, it acts on " +
                           (has_ids(kind) ? "Boundary ids" :
                            acts_at_point ? "one Point" :
                                            "the whole body") +
                           ". Remove it, or choose another Kind.");
    }

    using Axes = std::vector<std::pair<unsigned int, unsigned int>>;

    /** The components of a strain as scenes write them. */
    Axes
    strain_axes(const unsigned int dim, const std::size_t n_given)
    {
      if (dim == 3)
        return {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
      if (n_given == 4)
        return {{0, 0}, {1, 1}, {0, 1}, {2, 2}};
      return {{0, 0}, {1, 1}, {0, 1}};
    }

    void
    check_strain_components(const unsigned int dim,
                            const std::size_t  given,
                            const std::string &in)
    {
      // a single 0 stands for all of them
      if (given == 1 || given == strain_axes(dim, given).size())
        return;
      throw InputError(
        in + "Value: there are " + std::to_string(given) +
        " components, separated by ';', but an initial strain has " +
        (dim == 3 ? "six in 3D: xx ; yy ; zz ; xy ; xz ; yz." :
                    "three in 2D, xx ; yy ; xy, or four with zz behind them."));
    }

    /** Where and when a load acts, and how it takes hold of its faces. */
    void
    declare_place(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      prm.declare_entry(
        "Active",
        "1",
        Anything(),
        "A function of t for stages of an assembly: where it is "
        "0 the load does not act, elsewhere it does. [-]");
      prm.declare_entry("Boundary ids",
                        "",
                        Anything(),
                        "For traction, pressure, force, moment, bearing, nodal "
                        "force and line load: "
                        "boundary ids of the body, separated by commas.");
      prm.declare_entry("Point",
                        "",
                        Anything(),
                        "Where a point force acts, and where a force acts that "
                        "is not to act in the centre of its faces. A "
                        "centrifugal load has its axis through this point; "
                        "empty: through the origin. Coupling = rigid needs a "
                        "point, which may be anywhere. [length]");
      prm.declare_entry(
        "Coupling",
        "distributing",
        Selection("distributing|rigid"),
        "How a force or a moment acts on its faces. distributing: a linear "
        "traction spreads it over the faces of Boundary ids, which still "
        "deform. rigid: these faces and Point are one rigid body; the force "
        "acts at Point, and the moment about it. Loads with the same faces and "
        "the same Point have one rigid body. Tables call its motion 'obstacle "
        "coupling LOAD', and what it passes on to the body 'coupling LOAD'. "
        "Faces of bodies of revolution move along y only.");
      prm.declare_entry("Axis",
                        "",
                        Anything(),
                        "Direction of the axis of a centrifugal load in space. "
                        "Empty: z. In the plane the axis is z; that of bodies "
                        "of revolution is y. [-]");
    }
  } // namespace

  void
  declare_load(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    std::string kinds;
    for (const auto &[text, kind] : load_kinds)
      kinds += (kinds.empty() ? "" : "|") + text;
    prm.declare_entry("Body", "", Anything(), "Name of the body it acts on.");
    prm.declare_entry(
      "Kind",
      "traction",
      Selection(kinds),
      "traction [force/area] and pressure [force/area, against the outward "
      "normal] act on boundary ids. body force [force/volume] acts on the "
      "whole body. point force [force] acts at Point; the shape functions of "
      "the cell or member that holds the point distribute it. force [force] "
      "and moment [force x length, about the axes; in 2D about z] are total "
      "ones. With Coupling = distributing a linear traction spreads them over "
      "boundary ids without stiffening these; a force acts at Point, or in "
      "the centre of the faces. With Coupling = rigid the faces move as one. "
      "bearing [force] is the total force of a pin: it presses on the half of "
      "the bore that it points at, by the cosine with its direction. "
      "centrifugal [rad/time] is the angular velocity of a body with a "
      "Density about Axis through Point. nodal force [force, force x length] "
      "acts at each node of boundary ids. line load [force/length] acts on "
      "the members of a frame with boundary ids. temperature [K] is a change "
      "of temperature of the whole body. initial strain [-] is what the body "
      "would strain by if nothing resisted (swelling, shrinking, misfit): "
      "stress = C (strain - initial strain). These two act on the whole body, "
      "turn with it, and add up. Forces of frames come from the mean strain "
      "along each member.");
    declare_place(prm);
    prm.declare_entry("Value",
                      "",
                      Anything(),
                      "Must be given: components, functions of x, y, z, t, "
                      "separated by ';' "
                      "(pressure, temperature: one; initial strain in 3D: xx, "
                      "yy, zz, xy, xz, yz, in 2D: xx, yy, xy, and zz if it is "
                      "not 0, components of the tensor along the axes of the "
                      "scene as the undeformed body lies in them, whatever the "
                      "axes of its material). Moments may follow the "
                      "components of a nodal force on beams (2D: m_z; 3D: "
                      "m_x, m_y, m_z). In 2D tractions and body forces act "
                      "over the body's thickness, other forces are whole "
                      "ones. [by Kind]");
  }

  namespace
  {
    void
    read_rigid(const dealii::ParameterHandler &prm,
               const unsigned int              dim,
               const Structure                &structure,
               const std::string              &in,
               Load                           &load)
    {
      const Surface surface = structure.surface(load.ids);
      if (surface.two_sided || surface.faces.empty())
        throw InputError(in + "Coupling: rigid holds faces of a continuum, and "
                              "the boundary ids have none. Give those of "
                              "faces; nodes of a frame take nodal forces with "
                              "moments.");
      if (prm.get("Point").empty())
        throw InputError(in + "Point is empty. A rigid coupling needs the "
                              "point that its faces move with, and where the "
                              "load acts: give it.");
      load.point = Point<3>(to_vector(prm.get("Point"), dim, in + "Point"));
    }

    void
    read_axis(const dealii::ParameterHandler &prm,
              const unsigned int              dim,
              const Structure                &structure,
              const std::string              &in,
              Load                           &load)
    {
      const std::string axis = prm.get("Axis"), point = prm.get("Point");
      if (!axis.empty() && dim == 2)
        throw InputError(in + "Axis: in the plane it is z, of bodies of "
                              "revolution y. Leave the entry empty.");
      if (!point.empty())
        load.point = Point<3>(to_vector(point, dim, in + "Point"));
      if (structure.is_axisymmetric() && load.point[0] != 0)
        throw InputError(in + "Point: " + point +
                         " is beside the axis of the bodies of revolution, x = "
                         "0, about which they spin. Leave the entry empty.");
      load.axis[structure.is_axisymmetric() ? 1 : 2] = 1;
      if (axis.empty())
        return;
      load.axis = to_vector(axis, dim, in + "Axis");
      if (load.axis.norm() == 0)
        throw InputError(in + "Axis: it has no length. Give a direction other "
                              "than zero.");
      load.axis /= load.axis.norm();
    }

    /** What does not act alike all round a body of revolution. */
    void
    refuse_one_sided(const Load::Kind kind, const std::string &in)
    {
      if (kind == Load::Kind::moment)
        throw InputError(in + "Kind: nothing turns a body of revolution out of "
                              "its plane. Choose a force, along y.");
      if (kind == Load::Kind::bearing)
        throw InputError(in + "Kind: a pin presses one side of a bore, and "
                              "bodies of revolution are loaded alike all "
                              "round. Choose a pressure.");
    }

    /** Values of the whole body, or of a whole force, that say they vary. */
    void
    refuse_place(const Load        &load,
                 const std::string &value,
                 const std::string &in)
    {
      const bool uses_space =
        std::any_of(load.value.begin(),
                    load.value.end(),
                    [](const Expression &e) { return e.uses_space(); });
      if (uses_space && (load.kind == Load::Kind::centrifugal ||
                         load.kind == Load::Kind::bearing))
        throw InputError(in + "Value: '" + value +
                         "' depends on the place. It is " +
                         (load.kind == Load::Kind::bearing ?
                            "a whole force" :
                            "the angular velocity of a body") +
                         ": use t only.");
    }
  } // namespace

  Load
  weight_of(const unsigned int  body,
            const std::string  &name,
            const double        density,
            const Tensor<1, 3> &gravity,
            const unsigned int  dim)
  {
    Load load;
    load.name    = name;
    load.body    = body;
    load.kind    = Load::Kind::body_force;
    load.density = density;
    for (unsigned int d = 0; d < dim; ++d)
      load.value.emplace_back(all_digits(density * gravity[d]), name);
    return load;
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
    refuse_idle(prm, load.kind, in);
    load.active = read_active(prm, in);
    if (has_ids(load.kind))
      load.ids = find_boundary(prm.get("Boundary ids"),
                               *structures[load.body],
                               bodies[load.body],
                               in + "Boundary ids");
    if (structures[load.body]->is_axisymmetric())
      refuse_one_sided(load.kind, in);
    load.is_rigid = is_rigid(prm);
    if (load.is_rigid)
      read_rigid(prm, dim, *structures[load.body], in, load);
    else if (is_spread(load.kind))
      {
        load.spread =
          std::make_shared<SpreadForce>(*structures[load.body], load.ids, in);
        load.point = load.spread->centroid();
      }
    if (load.kind == Load::Kind::point_force ||
        (load.kind == Load::Kind::force && !prm.get("Point").empty()))
      load.point = Point<3>(to_vector(prm.get("Point"), dim, in + "Point"));
    if (load.kind == Load::Kind::centrifugal)
      read_axis(prm, dim, *structures[load.body], in, load);
    const std::string value = prm.get("Value");
    if (value.empty())
      throw InputError(in + "Value is empty. Give its components, separated "
                            "by ';', or 0 for none.");
    std::size_t n =
      is_scalar(load.kind) || (load.kind == Load::Kind::moment && dim == 2) ?
        1 :
        dim;
    const auto given = split(value, ';').size();
    if (load.kind == Load::Kind::initial_strain)
      {
        load.axes = strain_axes(dim, given);
        n         = load.axes.size();
        check_strain_components(dim, given, in);
      }
    const auto all = std::size_t{structures[load.body]->n_components()};
    if (load.kind == Load::Kind::nodal_force && given == all)
      n = all; // with moments
    load.value = parse_components(value, n, in + "Value");
    if (load.is_rigid && structures[load.body]->is_axisymmetric() &&
        !load.value.front().is_zero())
      throw InputError(in +
                       "Value: a rigid ring moves along y only. Give 0 for "
                       "x.");
    refuse_place(load, value, in);
    return load;
  }
} // namespace conetact::bodies
