// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What methods of solution do not know.

#include "conetact/application/method_checks.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <algorithm>
#include <map>

namespace conetact::application
{
  namespace
  {
    /** Parts of a stage at which linearity is checked. */
    constexpr double parts[] = {.1, .25, .381966, .5, .75, .9};

    /** Why values(t) is not linear in each stage; empty: it is. */
    template <typename Values>
    std::string
    why_not_linear(const std::vector<double> &times,
                   const std::string         &entry,
                   const Values              &values)
    {
      double          start = 0;
      Eigen::VectorXd first = values(0.);
      double          size  = solvers::largest(first);
      for (const double end : times)
        {
          const Eigen::VectorXd last = values(end);
          size                       = std::max(size, solvers::largest(last));
          for (const double part : parts)
            {
              const Eigen::VectorXd bend =
                values(start + part * (end - start)) -
                (first + part * (last - first));
              if (!(solvers::largest(bend) <= 1e-11 * size))
                return entry +
                       ": it is not linear in t between t = " + to_text(start) +
                       " and t = " + to_text(end) +
                       ". Along a load path loads change in proportion: give "
                       "the times of its bends in Time/Times.";
            }
          first = last;
          start = end;
        }
      return "";
    }

    bool
    moves(const std::vector<Expression> &expressions)
    {
      return std::any_of(expressions.begin(),
                         expressions.end(),
                         [](const Expression &e) { return e.uses_time(); });
    }

    /** Newton's method knows all laws, others those of cones. */
    bool
    is_newton(const std::string &method)
    {
      return method == "automatic" || method == "active set";
    }

    void
    refuse_joints_of_other_methods(const SceneObjects &scene,
                                   const RunSettings  &settings)
    {
      for (const pairing::Contact &contact : scene.contacts)
        if (settings.path.follows ?
              contact.spring || contact.may_part() :
              contact.is_joined() && !is_newton(settings.solver.method))
          throw InputError(
            "Contact '" + contact.name +
            "', Kind: Solver/Method "
            "= " +
            (settings.path.follows ? "load path" : settings.solver.method) +
            " knows no springs and no ties that begin or end. "
            "Choose automatic.");
    }
  } // namespace



  void
  settle_friction(const SceneObjects &scene, RunSettings &settings)
  {
    for (const pairing::Contact &contact : scene.contacts)
      if (contact.friction->uses_speed() ||
          (contact.layer && contact.layer->uses_speed()) || contact.bond ||
          contact.fluid || contact.is_joined())
        settings.solver.max_substeps = 1;
    refuse_joints_of_other_methods(scene, settings);
    for (const pairing::Contact &contact : scene.contacts)
      if ((contact.bond || contact.fluid) &&
          !is_newton(settings.solver.method) && !settings.path.follows)
        throw InputError("Contact '" + contact.name + "', " +
                         (contact.bond ? "Cohesion" : "Penetrating pressure") +
                         ": Solver/Method = " + settings.solver.method +
                         " knows coefficients of friction only. Choose "
                         "automatic.");
    std::map<unsigned int, double> areas; // of contacts that need them
    for (const pairing::ContactNode &node : scene.bodies.contact_nodes)
      if (node.friction && settings.path.follows)
        throw InputError("Contact '" + scene.contacts[node.contact].name +
                         "', Friction coefficient: Solver/Method = load path "
                         "follows events of cones that stay the same. Let it "
                         "depend on x, y, z only, without Shear limit, Active, "
                         "Compliance and wear, or choose another method. "
                         "Neither does it know a Penetrating pressure.");
      else if (node.friction && node.friction->is_elliptic() &&
               !is_newton(settings.solver.method))
        throw InputError("Contact '" + scene.contacts[node.contact].name +
                         "', Second friction coefficient: Solver/Method = " +
                         settings.solver.method +
                         " knows ellipses that stay the same only, without "
                         "layers, fluids or Active. Choose automatic.");
      else if (node.friction && node.friction->is_elliptic() &&
               !(settings.fclib_increments.empty() &&
                 settings.text_increments.empty()))
        throw InputError("Contact '" + scene.contacts[node.contact].name +
                         "', Second friction coefficient: files of increments "
                         "(FCLib, Text) have cones, and an ellipse that varies "
                         "is none. Leave these entries of Output empty.");
      else if (node.friction && (node.friction->needs_area() || node.layer))
        areas[node.contact] += node.outward.empty() ? 0. : node.area;
    for (const auto &[contact, area] : areas)
      if (area == 0)
        throw InputError("Contact '" + scene.contacts[contact].name +
                         "', Friction coefficient: pressure p, Shear limit, "
                         "Compliance and wear need areas, which the nodes of "
                         "this contact do not have: they are points of frames. "
                         "Let the coefficient depend on x, y, z, t, T, s, v.");
  }



  void
  check_path(const SceneObjects &scene, const RunSettings &settings)
  {
    if (settings.adaptive.cycles > 0 && settings.path.follows)
      throw InputError("Adaptive refinement: the Solver/Method of this scene "
                       "follows a path on one mesh. Set it to 0, or choose "
                       "another method.");
    for (const pairing::ContactNode &node : scene.bodies.contact_nodes)
      if (node.cohesion > 0 && scene.bodies.dim == 3)
        throw InputError("Contact '" + scene.contacts[node.contact].name +
                         "', Cohesion: a load path knows cohesion in 2D only. "
                         "Leave it 0, or choose another Solver/Method.");
    if (!settings.path.follows)
      {
        if (settings.path.law == load_path::PathLaw::holonomic)
          throw InputError("Solver/Law: the holonomic law is one of "
                           "Method = load path. Choose that method, or "
                           "Law = incremental.");
        return;
      }
    if (scene.bodies.dim == 3 &&
        settings.path.law == load_path::PathLaw::holonomic)
      throw InputError("Solver/Law: the holonomic law is for 2D. Choose "
                       "incremental.");
    if (scene.bodies.contact_nodes.empty())
      throw InputError("Solver/Method: a load path follows contact states, but "
                       "the scene has no contact. Choose automatic.");
    for (const bodies::Load &load : scene.loads)
      if (load.is_rigid)
        throw InputError("Load '" + load.name +
                         "', Coupling: a load path knows no rigid couplings. "
                         "Choose Coupling = distributing, or Solver/Method = "
                         "automatic.");
    for (const pairing::Obstacle &obstacle : scene.obstacles)
      if (obstacle.free.any() || obstacle.turn)
        throw InputError(
          "Obstacle '" + obstacle.name + "', " +
          (obstacle.turn ? "Turn" : "Free") +
          ": a load path knows obstacles that translate as prescribed. Remove "
          "the entry, or choose Solver/Method = automatic.");
    for (const pairing::Contact &contact : scene.contacts)
      if (contact.preload)
        throw InputError("Contact '" + contact.name +
                         "', Preload: a load path knows no ties that are "
                         "tightened. Choose Solver/Method = automatic.");
    if (settings.judges_uniqueness)
      throw InputError("Output/Uniqueness: a load path follows one solution. "
                       "Set it to no, or choose Solver/Method = automatic.");
    if (!settings.fclib_increments.empty())
      throw InputError("Output/FCLib increments: a load path has no increments "
                       "of its own. Leave it empty.");
  }



  namespace
  {
    /** What is not linear in t, a sentence; empty: nothing. */
    std::string
    bent_load(const SceneObjects &scene, const std::vector<double> &times)
    {
      for (const bodies::Load &load : scene.loads)
        {
          const bodies::Structure &structure =
            *scene.bodies.structures[load.body];
          const auto forces = [&](const double t) {
            Eigen::VectorXd f = Eigen::VectorXd::Zero(structure.n_dofs());
            load.add(structure, t, f);
            return f;
          };
          const std::string why =
            load.uses_time() ?
              why_not_linear(times, "Load '" + load.name + "', Value", forces) :
              "";
          if (!why.empty())
            return why;
        }
      return "";
    }



    std::string
    bent_motion(const SceneObjects &scene, const std::vector<double> &times)
    {
      std::string why;
      const auto  check = [&](const std::string &entry, const auto &values) {
        if (why.empty())
          why = why_not_linear(times, entry, values);
      };
      for (const bodies::Support &support : scene.bodies.supports)
        {
          const auto &nodes  = support.surface.nodes;
          const auto  values = [&](const Expression &expression) {
            return [&](const double t) {
              Eigen::VectorXd u(static_cast<Eigen::Index>(nodes.size()));
              for (Eigen::Index i = 0; i < u.size(); ++i)
                u[i] =
                  expression(nodes[static_cast<std::size_t>(i)].position, t);
              return u;
            };
          };
          for (const Expression &e : support.displacement)
            check("Support '" + support.name + "', Displacement", values(e));
          for (const bodies::Support::Rotation &rotation : support.rotations)
            check("Support '" + support.name + "', Rotation",
                  values(rotation.angle));
        }
      for (const pairing::ContactNode &node : scene.bodies.contact_nodes)
        if (node.growth)
          check("Contact '" + scene.contacts[node.contact].name + "', Gap",
                [&](const double t) {
                  return Eigen::Matrix<double, 1, 1>(node.growth(t));
                });
      for (const pairing::Obstacle &obstacle : scene.obstacles)
        if (moves(obstacle.displacement))
          check("Obstacle '" + obstacle.name + "', Displacement",
                [&](const double t) {
                  const Tensor<1, 3> d = obstacle.displacement_at(t);
                  return Eigen::Vector3d(d[0], d[1], d[2]);
                });
      return why;
    }
  } // namespace

  void
  check_linear_stages(const SceneObjects        &scene,
                      const std::vector<double> &times)
  {
    for (const std::string &why :
         {bent_load(scene, times), bent_motion(scene, times)})
      if (!why.empty())
        throw InputError(why);
  }



  bool
  may_follow_path(const SceneObjects &scene, const RunSettings &settings)
  {
    const auto is_of_increments = [&](const pairing::Contact &contact) {
      return contact.spring || contact.may_part() || contact.preload ||
             contact.bond || contact.fluid;
    };
    const auto has_law = [&](const pairing::ContactNode &node) {
      return node.friction || (node.cohesion > 0 && scene.bodies.dim == 3);
    };
    const auto turns = [](const bodies::Support &support) {
      return support.turn.has_value();
    };
    return scene.bodies.n_rigid == 0 && settings.adaptive.cycles == 0 &&
           !settings.judges_uniqueness && !settings.follows_branches &&
           settings.fclib_increments.empty() &&
           settings.checkpoint_every == 0 &&
           std::none_of(scene.contacts.begin(),
                        scene.contacts.end(),
                        is_of_increments) &&
           std::none_of(scene.bodies.contact_nodes.begin(),
                        scene.bodies.contact_nodes.end(),
                        has_law) &&
           std::none_of(scene.bodies.supports.begin(),
                        scene.bodies.supports.end(),
                        turns) &&
           bent_load(scene, settings.times).empty() &&
           bent_motion(scene, settings.times).empty();
  }



  void
  check_turning_supports(const SceneObjects &scene, const RunSettings &settings)
  {
    for (const bodies::Support &support : scene.bodies.supports)
      if (support.turn &&
          (settings.path.follows || settings.adaptive.cycles > 0))
        throw InputError("Support '" + support.name +
                         "', Turn: load paths and adaptive meshes are for "
                         "bodies that turn little. Leave Turn 0, or choose "
                         "another Solver/Method and Adaptive refinement = 0.");
  }



  void
  check_preloads(const SceneObjects &scene, const std::vector<double> &times)
  {
    for (const pairing::Contact &contact : scene.contacts)
      {
        if (!contact.preload || !contact.preload->locked_from)
          continue;
        const double      from = *contact.preload->locked_from;
        const std::string in =
          "Contact '" + contact.name + "', Preload locked from: ";
        if (from <= 0)
          throw InputError(in + "the force acts up to t = " + to_text(from) +
                           ", which is never. Give the end of the increment "
                           "in which it has tightened the bolt.");
        if (!times.empty() && from < times.back() &&
            std::none_of(times.begin(), times.end(), [from](const double t) {
              return std::abs(t - from) <= 1e-12 * std::abs(from);
            }))
          throw InputError(in + "no increment ends at t = " + to_text(from) +
                           ". Give the end of one, or choose other Times.");
      }
  }
} // namespace conetact::application
