// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Faults that are planted into right results are found, right ones accepted.

#include "conetact/contact/contact_history.h"
#include "conetact/solvers/solver_table.h"
#include "conetact/verification/verification.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::application;
using namespace conetact::bodies;
using namespace conetact::contact;
using namespace conetact::solvers;
using namespace conetact::verification;

namespace
{
  constexpr double tolerance = 1e-10;

  /** The increments of a scene, solved, with their verification. */
  class Solved
  {
  public:
    explicit Solved(const std::string &text)
      : scene(test::make_scene(text))
      , model(scene->bodies, scene->times)
      , verification(model.bodies,
                     model.elastic,
                     model.coordinates,
                     model.motions,
                     model.points,
                     tolerance)
    {}

    /** Calls visit(claim) for each increment before it is accepted. */
    template <typename Visit>
    void
    for_each(const Visit &visit)
    {
      NodalLoads     loads = scene->nodal_loads();
      ContactHistory history(model);
      const auto     solver = make_solver(scene->solver);
      set_stiffness();
      for (const double t : scene->times)
        {
          const Eigen::VectorXd forces = loads.at(t);
          LoadCase              load   = model.load_case(forces, {}, t);
          // whatever fluid there is has got everywhere
          const bool is_wet = model.points.all().front().node->fluid != nullptr;
          load.laws         = history.laws_until(
            t,
            [](unsigned int, const Point<3> &) { return 0.; },
            std::vector<bool>(model.points.size(), is_wet));
          ContactState state   = history.start();
          const auto   problem = history.problem(load);
          ASSERT_TRUE(solver->solve(problem, state).converged);
          if (problem.system->form == Form::stiffness)
            state.u = elastic_part(problem, state);
          const ContactHistory before = history;
          history.advance(state, t, load.laws.get());
          Claim claim;
          claim.laws = load.laws;
          claim.worn = before.memory().wear.receded();
          if (load.laws)
            model.points.set_friction(load.laws->coefficients(state));
          claim.amounts = model.amounts(load.placement, history.free_motions());
          claim.w       = contact::shared(
            model.elasticity().expand({&load}, {history.primal()}).front());
          claim.r      = state.r.head(model.points.n_unknowns());
          claim.states = state.node;
          claim.loads = claim.mechanical = contact::shared(forces);
          claim.t                        = t;
          visit(claim);
          verification.accept(claim.t, verification.judge(claim));
        }
    }

    std::unique_ptr<Scene> scene;
    ContactModel           model;
    Verification           verification;

  private:
    void
    set_stiffness()
    {
      const ContactSystem &system = *model.elasticity().system();
      Eigen::VectorXd      k(system.n_nodes());
      for (Eigen::Index i = 0; i < k.size(); ++i)
        {
          const double mean =
            system.matrix.diagonal()
              .segment(system.first[static_cast<std::size_t>(i)],
                       system.n_tangents(i) + 1)
              .mean();
          k[i] = system.form == Form::stiffness ? mean : 1 / mean;
        }
      verification.set_stiffness(k);
    }
  };

  std::string
  block(const std::string &name, const std::string &arguments, const double E)
  {
    return "subsection Body " + name +
           "\n subsection Mesh\n set Generator = subdivided_hyper_rectangle\n"
           " set Arguments = " +
           arguments +
           " : true\n end\n subsection Material\n set Young modulus = " +
           std::to_string(E) + "\n set Poisson ratio = 0.3\n end\nend\n";
  }

  const std::string time =
    "subsection Time\n set End = 3\n set Increments = 3\nend\n";

  std::string
  floor_contact(const std::string &body, const std::string &ids)
  {
    return "subsection Contact bottom\n set Body = " + body +
           "\n set Boundary ids = " + ids +
           "\n set Obstacle = floor\n set Friction coefficient = 0.3\nend\n";
  }

  std::string
  held(const bool space)
  {
    return std::string(space ? "set Dimension = 3\n" : "") +
           "set Bodies = block\nset Obstacles = floor\nset Contacts = bottom\n"
           "set Supports = top\n" +
           (space ? block("block", "4, 4, 3 : 0, 0, 0 : 1, 1, 1", 1000) :
                    block("block", "12, 6 : 0, 0 : 2, 1", 1000)) +
           "subsection Obstacle floor\n set Normal = " +
           (space ? "0, 0, 1" : "0, 1") + "\nend\n" +
           floor_contact("block", space ? "4" : "2") +
           "subsection Support top\n set Body = block\n set Boundary ids = " +
           (space ? "5" : "3") +
           "\n set Displacement = 0.004*max(t - 1, 0) ; " +
           (space ? "0.001*t ; " : "") + "-0.01*min(t, 1)\nend\n" + time;
  }

  const std::string stacked =
    "set Bodies = block, mat\nset Contacts = joint\nset Supports = low\n"
    "set Loads = press, push\n" +
    block("block", "6, 4 : 3, 1 : 6, 3", 2e5) +
    block("mat", "18, 3 : 0, 0 : 9, 1", 10) +
    "subsection Contact joint\n set Body = block\n set Boundary ids = 2\n"
    " set Master body = mat\n set Master boundary ids = 3\n"
    " set Pairing = node to face\n"
    " set Friction coefficient = 0.4\nend\n"
    "subsection Support low\n set Body = mat\n set Boundary ids = 2\nend\n"
    "subsection Load press\n set Body = block\n set Kind = pressure\n"
    " set Boundary ids = 3\n set Value = 0.01\nend\n"
    "subsection Load push\n set Body = block\n set Kind = body force\n"
    " set Value = 0.0005*t ; 0\nend\n" +
    time;

  const std::string dropped =
    "set Bodies = block\nset Obstacles = floor\nset Contacts = bottom\n"
    "set Loads = weight\n" +
    block("block", "10, 5 : 0, 0 : 20, 10", 2e5) +
    "subsection Obstacle floor\n set Normal = 0, 1\n set Point = 0, -100\nend\n" +
    floor_contact("block", "2") +
    "subsection Load weight\n set Body = block\n set Kind = body force\n"
    " set Value = 5e-6*t ; -7.7e-5\nend\n" +
    time;

  /** The same with all laws that a contact may have. */
  std::string
  held_by_laws(const bool space)
  {
    const std::string coulomb = "Friction coefficient = 0.3\n";
    std::string       text    = held(space);
    return text.replace(
      text.find(coulomb),
      coulomb.size(),
      "Friction coefficient = (0.2 + 0.1*exp(-s/0.003))/(1 + p/100) + 0.01*t\n"
      " set Shear limit = 3\n set Compliance = table(p; 0 : 2e-4; 10 : 1e-4)\n"
      " set Shear compliance = 1e-5\n set Wear coefficient = 1e-3\n"
      " set Wear integration = implicit\n");
  }

  /** The same with an ellipse of friction whose axes vary. */
  std::string
  with_ellipse(std::string text)
  {
    const std::string friction = " set Friction coefficient = ";
    return text.insert(text.find(friction),
                       " set Second friction coefficient = 0.1/(1 + p/200) + "
                       "0.08*exp(-s/0.01) + 0.05*exp(-v/0.01)\n"
                       " set Friction angle = 20\n");
  }

  /** The same with a bond that softens, pressed or pulled; or all wet. */
  std::string
  held_by_bonds(const bool space, const bool pulled)
  {
    std::string text    = held(space);
    const auto  replace = [&](const std::string &old, const std::string &by) {
      text.replace(text.find(old), old.size(), by);
    };
    replace("Friction coefficient = 0.3\n",
            "Friction coefficient = 0.3\n set Cohesion = 1\n"
            " set Tensile strength = 2\n set Cohesion lost = slip\n"
            " set Softening length = 0.02\n");
    if (pulled)
      replace("-0.01*min(t, 1)", "0.002*t");
    return text;
  }

  std::string
  held_wet(const bool space)
  {
    const std::string coulomb = "Friction coefficient = 0.3\n";
    std::string       text    = held(space);
    return text.replace(text.find(coulomb),
                        coulomb.size(),
                        coulomb + " set Penetrating pressure = 4\n"
                                  " set Fluid from boundary ids = 0\n");
  }

  /** A block on springs, and one that is tied to it for the time being. */
  std::string
  joined(const bool space)
  {
    const auto spring = [&](const std::string &name, const double x) {
      const std::string place = std::to_string(x) + (space ? ", 0.4" : "");
      return "subsection Contact " + name +
             "\n set Kind = spring\n set Body = low\n set Stiffness = 300\n"
             " set Point = " +
             place + ", 0\n set Master point = " + place +
             ", -1\n set Acts = " +
             (name == "stop" ? "push\n" : "push and pull\n") + "end\n";
    };
    const std::string low = space ? "4" : "2", high = space ? "5" : "3";
    std::string       text =
      std::string(space ? "set Dimension = 3\n" : "") +
      "set Bodies = low, high\nset Contacts = joint, stop, coil\n"
      "set Supports = left, soft\nset Loads = press\n" +
      (space ? block("low", "3, 2, 2 : 0, 0, 0 : 1, 1, 1", 1000) +
                 block("high", "2, 2, 2 : 0, 0, 1 : 1, 1, 2", 1000) :
               block("low", "4, 3 : 0, 0 : 1, 1", 1000) +
                 block("high", "3, 3 : 0, 1 : 1, 2", 1000)) +
      "subsection Contact joint\n set Body = high\n set Boundary ids = " + low +
      "\n set Master body = low\n set Master boundary ids = " + high +
      "\n set Kind = tie\n set Active = t > 0\nend\n" + spring("stop", .3) +
      spring("coil", .8) +
      "subsection Support left\n set Body = low\n set Boundary ids = 0\n"
      " set Directions = x" +
      (space ? ", y" : "") +
      "\nend\nsubsection Support soft\n set Body = low\n"
      " set Boundary ids = 1\n set Directions = normal\n set Stiffness = 50\n"
      "end\nsubsection Load press\n set Body = high\n set Kind = traction\n"
      " set Boundary ids = " +
      high + "\n set Value = 0.4*t ; " + (space ? "0.1*t ; -t" : "-t") +
      "\nend\n";
    return text + time;
  }

  /** Two blocks that are tied at a side, and held at the same end. */
  std::string
  tied_and_held()
  {
    const auto block_at = [](const std::string &name, const std::string &box) {
      return block(name, "2, 2 : " + box, 1000) + "subsection Support " + name +
             "\n set Body = " + name + "\n set Boundary ids = 0\nend\n";
    };
    return "set Bodies = a, b\nset Contacts = joint\nset Supports = a, b\n" +
           block_at("a", "0, 0 : 1, 1") + block_at("b", "0, 1 : 1, 2") +
           "subsection Contact joint\n set Body = a\n"
           " set Boundary ids = 3\n set Master body = b\n"
           " set Master boundary ids = 2\n set Kind = tie\n"
           " set Pairing = node to face\nend\n" +
           time;
  }

  /** A fault at one node, where it has enough force; false: not here. */
  using Fault = bool (*)(Claim &, const ContactPoint &, std::size_t);

  bool
  scale(Claim &c, const ContactPoint &p, std::size_t)
  {
    c.r.segment(p.first, static_cast<Eigen::Index>(p.dual.size())) *= 1 + 1e-6;
    return true;
  }
  bool
  flip(Claim &c, const ContactPoint &p, std::size_t)
  {
    const auto n = p.first + static_cast<Eigen::Index>(p.dual.size()) - 1;
    c.r[n]       = -c.r[n];
    return true;
  }
  bool
  drop(Claim &c, const ContactPoint &p, std::size_t)
  {
    c.r.segment(p.first, static_cast<Eigen::Index>(p.dual.size())).setZero();
    return true;
  }
  bool
  turn(Claim &c, const ContactPoint &p, std::size_t)
  {
    if (p.dual.size() < 2)
      return false;
    // in the plane the tangential reaction turns towards the normal
    const double a = c.r[p.first], b = c.r[p.first + 1];
    c.r[p.first]     = a - 1e-3 * b;
    c.r[p.first + 1] = b + 1e-3 * a;
    return true;
  }
  bool
  rename(Claim &c, const ContactPoint &p, const std::size_t i)
  {
    const double limit =
      p.mu * c.r[p.first + static_cast<Eigen::Index>(p.dual.size()) - 1];
    const double r_t =
      c.r.segment(p.first, static_cast<Eigen::Index>(p.dual.size()) - 1).norm();
    if (c.states[i] == NodeState::stick && !p.node->may_part() &&
        r_t >= .99 * limit)
      return false; // biactive, or without friction
    c.states[i] =
      c.states[i] == NodeState::stick ? NodeState::slip : NodeState::stick;
    return true;
  }
  bool
  open(Claim &c, const ContactPoint &, const std::size_t i)
  {
    const bool was_closed = c.states[i] != NodeState::open;
    c.states[i]           = NodeState::open;
    return was_closed;
  }

  bool
  wear_more(Claim &c, const ContactPoint &p, const std::size_t i)
  {
    const bool counts = c.laws && !p.node->may_part() && !p.node->spring;
    if (counts)
      c.worn[static_cast<Eigen::Index>(i)] += 1e-7;
    return counts;
  }

  void
  plant_faults(const std::string &text, unsigned int &n_planted)
  {
    Solved solved(text);
    solved.for_each([&](const Claim &claim) {
      const Finding right = solved.verification.judge(claim);
      EXPECT_TRUE(right.why.empty()) << right.why;
      EXPECT_LE(right.residual, tolerance);
      EXPECT_LE(right.equilibrium, tolerance);
      const auto  &points  = solved.model.points;
      const double largest = claim.r.cwiseAbs().maxCoeff();
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const auto n = points[i].first +
                         static_cast<Eigen::Index>(points[i].dual.size()) - 1;
          if (std::abs(claim.r[n]) < 1e-3 * largest)
            continue;
          unsigned int number = 0;
          for (const Fault fault :
               {scale, flip, drop, turn, rename, open, wear_more})
            {
              ++number;
              Claim wrong = claim;
              if (!fault(wrong, points[i], i))
                continue;
              ++n_planted;
              EXPECT_FALSE(solved.verification.judge(wrong).why.empty())
                << "fault " << number << " at node " << i << ", t = " << claim.t
                << ", state " << static_cast<int>(claim.states[i]) << ", r "
                << claim.r
                     .segment(points[i].first,
                              static_cast<Eigen::Index>(points[i].dual.size()))
                     .transpose();
            }
        }
      for (double size = 1; size < 1e11; size *= 10)
        for (Eigen::Index k = 0; k < claim.amounts.size(); ++k)
          {
            Claim wrong = claim;
            wrong.amounts[k] += size * solved.model.motions.size(0);
            ++n_planted;
            EXPECT_FALSE(solved.verification.judge(wrong).why.empty());
          }
    });
  }
} // namespace

TEST(Verification, PlantedFaultsAreFound)
{
  unsigned int n = 0;
  for (const std::string &scene : {held(false), held(true), stacked, dropped})
    plant_faults(scene, n);
  EXPECT_GE(n, 1000u);
}

TEST(Verification, PlantedFaultsAreFoundWhateverTheLaw)
{
  unsigned int n = 0;
  for (const bool space : {false, true})
    {
      plant_faults(held_by_laws(space), n);
      plant_faults(held_wet(space), n);
      if (space)
        for (const std::string &scene : {held(space),
                                         held_by_laws(space),
                                         held_by_bonds(space, false),
                                         held_wet(space)})
          plant_faults(with_ellipse(scene), n);
      plant_faults(joined(space), n);
      for (const bool pulled : {false, true})
        plant_faults(held_by_bonds(space, pulled), n);
    }
  EXPECT_GE(n, 1500u);
}

// A tie between nodes that supports hold could carry anything.
TEST(Verification, WhatSupportsHoldCarriesNothingMore)
{
  Solved              solved(tied_and_held());
  const ContactModel &model = solved.model;
  ASSERT_EQ(model.points.n_bound(), 3u);
  solved.verification.set_stiffness(
    {}, Eigen::VectorXd::Constant(model.points.n_bound_unknowns(), 1e3));
  Claim claim;
  claim.amounts = model.motions.placement(1);
  claim.w = claim.loads = claim.mechanical =
    contact::shared(Eigen::VectorXd::Zero(model.coordinates.n_dofs()));
  claim.r = Eigen::VectorXd::Zero(model.points.n_all_unknowns());
  EXPECT_EQ(solved.verification.judge(claim).why, "");
  for (const ContactPoint &point : model.points.all())
    if (point.node->position[0] == 0)
      claim.r[point.first] = 1e6;
  EXPECT_NE(solved.verification.judge(claim).why.find("not determined"),
            std::string::npos);
}
