// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// What a scene means for a load path: stages, prestress, refusals.

#include "conetact/application/scene.h"
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
  } // namespace



  namespace
  {
    /** Newton's method knows all laws, others those of cones. */
    bool
    is_newton(const std::string &method)
    {
      return method == "automatic" || method == "active set";
    }
  } // namespace

  void
  Scene::refuse_joints_of_other_methods() const
  {
    for (const pairing::Contact &contact : contacts)
      if (path.follows ? contact.spring || contact.may_part() :
                         contact.is_joined() && !is_newton(solver.method))
        throw InputError("Contact '" + contact.name +
                         "', Kind: Solver/Method "
                         "= " +
                         (path.follows ? "load path" : solver.method) +
                         " knows no springs and no ties that begin or end. "
                         "Choose automatic.");
  }



  /* Friction that changes is one of increments; their parts have no speed. */
  void
  Scene::settle_friction()
  {
    for (const pairing::Contact &contact : contacts)
      if (contact.friction->uses_speed() ||
          (contact.layer && contact.layer->uses_speed()) || contact.bond ||
          contact.fluid || contact.is_joined())
        solver.max_substeps = 1;
    refuse_joints_of_other_methods();
    for (const pairing::Contact &contact : contacts)
      if ((contact.bond || contact.fluid) && !is_newton(solver.method) &&
          !path.follows)
        throw InputError("Contact '" + contact.name + "', " +
                         (contact.bond ? "Cohesion" : "Penetrating pressure") +
                         ": Solver/Method = " + solver.method +
                         " knows coefficients of friction only. Choose "
                         "automatic.");
    std::map<unsigned int, double> areas; // of contacts that need them
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      if (node.friction && path.follows)
        throw InputError("Contact '" + contacts[node.contact].name +
                         "', Friction coefficient: Solver/Method = load path "
                         "follows events of cones that stay the same. Let it "
                         "depend on x, y, z only, without Shear limit, Active, "
                         "Compliance and wear, or choose another method. "
                         "Neither does it know a Penetrating pressure.");
      else if (node.friction && node.friction->is_elliptic() &&
               !is_newton(solver.method))
        throw InputError(
          "Contact '" + contacts[node.contact].name +
          "', Second friction coefficient: Solver/Method = " + solver.method +
          " knows ellipses that stay the same only, without "
          "layers, fluids or Active. Choose automatic.");
      else if (node.friction && node.friction->is_elliptic() &&
               !(fclib_increments.empty() && text_increments.empty()))
        throw InputError("Contact '" + contacts[node.contact].name +
                         "', Second friction coefficient: files of increments "
                         "(FCLib, Text) have cones, and an ellipse that varies "
                         "is none. Leave these entries of Output empty.");
      else if (node.friction && (node.friction->needs_area() || node.layer))
        areas[node.contact] += node.outward.empty() ? 0. : node.area;
    for (const auto &[contact, area] : areas)
      if (area == 0)
        throw InputError("Contact '" + contacts[contact].name +
                         "', Friction coefficient: pressure p, Shear limit, "
                         "Compliance and wear need areas, which the nodes of "
                         "this contact do not have: they are points of frames. "
                         "Let the coefficient depend on x, y, z, t, T, s, v.");
  }



  void
  Scene::check_path() const
  {
    if (adaptive.cycles > 0 && path.follows)
      throw InputError("Adaptive refinement: the Solver/Method of this scene "
                       "follows a path on one mesh. Set it to 0, or choose "
                       "another method.");
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      if (node.cohesion > 0 && bodies.dim == 3)
        throw InputError("Contact '" + contacts[node.contact].name +
                         "', Cohesion: a load path knows cohesion in 2D only. "
                         "Leave it 0, or choose another Solver/Method.");
    if (!path.follows)
      {
        if (path.law == load_path::PathLaw::holonomic)
          throw InputError("Solver/Law: the holonomic law is one of "
                           "Method = load path. Choose that method, or "
                           "Law = incremental.");
        return;
      }
    if (bodies.dim == 3 && path.law == load_path::PathLaw::holonomic)
      throw InputError("Solver/Law: the holonomic law is for 2D. Choose "
                       "incremental.");
    if (bodies.contact_nodes.empty())
      throw InputError("Solver/Method: a load path follows contact states, but "
                       "the scene has no contact. Choose automatic.");
    for (const bodies::Load &load : loads)
      if (load.is_rigid)
        throw InputError("Load '" + load.name +
                         "', Coupling: a load path knows no rigid couplings. "
                         "Choose Coupling = distributing, or Solver/Method = "
                         "automatic.");
    for (const pairing::Obstacle &obstacle : obstacles)
      if (obstacle.free.any() || obstacle.turn)
        throw InputError(
          "Obstacle '" + obstacle.name + "', " +
          (obstacle.turn ? "Turn" : "Free") +
          ": a load path knows obstacles that translate as prescribed. Remove "
          "the entry, or choose Solver/Method = automatic.");
    for (const pairing::Contact &contact : contacts)
      if (contact.preload)
        throw InputError("Contact '" + contact.name +
                         "', Preload: a load path knows no ties that are "
                         "tightened. Choose Solver/Method = automatic.");
    if (judges_uniqueness)
      throw InputError("Output/Uniqueness: a load path follows one solution. "
                       "Set it to no, or choose Solver/Method = automatic.");
    if (!fclib_increments.empty())
      throw InputError("Output/FCLib increments: a load path has no increments "
                       "of its own. Leave it empty.");
  }



  void
  Scene::check_stages() const
  {
    for (const std::string &why : {bent_load(), bent_motion()})
      if (!why.empty())
        throw InputError(why);
  }



  std::string
  Scene::bent_load() const
  {
    for (const bodies::Load &load : loads)
      {
        const bodies::Structure &structure = *bodies.structures[load.body];
        const auto               forces    = [&](const double t) {
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
  Scene::bent_motion() const
  {
    std::string why;
    const auto  check = [&](const std::string &entry, const auto &values) {
      if (why.empty())
        why = why_not_linear(times, entry, values);
    };
    for (const bodies::Support &support : bodies.supports)
      {
        const auto &nodes  = support.surface.nodes;
        const auto  values = [&](const Expression &expression) {
          return [&](const double t) {
            Eigen::VectorXd u(static_cast<Eigen::Index>(nodes.size()));
            for (Eigen::Index i = 0; i < u.size(); ++i)
              u[i] = expression(nodes[static_cast<std::size_t>(i)].position, t);
            return u;
          };
        };
        for (const Expression &e : support.displacement)
          check("Support '" + support.name + "', Displacement", values(e));
        for (const bodies::Support::Rotation &rotation : support.rotations)
          check("Support '" + support.name + "', Rotation",
                values(rotation.angle));
      }
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      if (node.growth)
        check("Contact '" + contacts[node.contact].name + "', Gap",
              [&](const double t) {
                return Eigen::Matrix<double, 1, 1>(node.growth(t));
              });
    for (const pairing::Obstacle &obstacle : obstacles)
      if (moves(obstacle.displacement))
        check("Obstacle '" + obstacle.name + "', Displacement",
              [&](const double t) {
                const Tensor<1, 3> d = obstacle.displacement_at(t);
                return Eigen::Vector3d(d[0], d[1], d[2]);
              });
    return why;
  }



  bool
  Scene::has_moments() const
  {
    return std::any_of(loads.begin(),
                       loads.end(),
                       [](const bodies::Load &load) {
                         return load.kind == bodies::Load::Kind::moment;
                       });
  }



  bool
  Scene::may_follow_path() const
  {
    const auto is_of_increments = [&](const pairing::Contact &contact) {
      return contact.spring || contact.may_part() || contact.preload ||
             contact.bond || contact.fluid;
    };
    const auto has_law = [&](const pairing::ContactNode &node) {
      return node.friction || (node.cohesion > 0 && bodies.dim == 3);
    };
    const auto turns = [](const bodies::Support &support) {
      return support.turn.has_value();
    };
    return bodies.n_rigid == 0 && adaptive.cycles == 0 && !judges_uniqueness &&
           !follows_branches && fclib_increments.empty() &&
           checkpoint_every == 0 && !restart && stage_ends().size() < 2 &&
           std::none_of(contacts.begin(), contacts.end(), is_of_increments) &&
           std::none_of(bodies.contact_nodes.begin(),
                        bodies.contact_nodes.end(),
                        has_law) &&
           std::none_of(bodies.supports.begin(),
                        bodies.supports.end(),
                        turns) &&
           bent_load().empty() && bent_motion().empty();
  }



  Eigen::VectorXd
  Scene::prestress() const
  {
    std::vector<Eigen::Index> offset = {0};
    for (const bodies::Structure *structure : bodies.structures)
      offset.push_back(offset.back() + structure->n_dofs());
    Eigen::VectorXd forces; // empty: none
    const auto      add = [&](const unsigned int  body,
                         const unsigned int  node,
                         const Tensor<1, 3> &force) {
      if (forces.size() == 0)
        forces.setZero(offset.back());
      for (unsigned int c = 0; c < bodies.dim; ++c)
        forces[offset[body] +
               node * static_cast<Eigen::Index>(
                        bodies.structures[body]->n_components()) +
               c] += force[c];
    };
    for (const pairing::ContactNode &node : bodies.contact_nodes)
      if (node.prestress > 0)
        {
          pairing::for_each_side(node,
                                 [&](const unsigned int body,
                                     const unsigned int i,
                                     const double       weight) {
                                   add(body,
                                       i,
                                       -weight * node.prestress * node.n);
                                 });
        }
    return forces;
  }
} // namespace conetact::application
