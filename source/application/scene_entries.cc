// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/scene_entries.h"

#include "conetact/application/adaptive_settings.h"
#include "conetact/application/automatic_contacts.h"
#include "conetact/application/load_history.h"
#include "conetact/application/solver_options.h"
#include "conetact/bodies/body_table.h"
#include "conetact/bodies/loads.h"
#include "conetact/bodies/supports.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/obstacle_table.h"

namespace conetact::application
{
  namespace
  {
    using Handler = dealii::ParameterHandler;

    template <typename Declare>
    void
    declare_each(Handler                        &prm,
                 const std::string              &kind,
                 const std::vector<std::string> &names,
                 const Declare                  &declare)
    {
      for (const std::string &name : names)
        {
          prm.enter_subsection(kind + " " + name);
          declare(prm);
          prm.leave_subsection();
        }
    }

    void
    declare_solver_section(Handler &prm)
    {
      prm.enter_subsection("Solver");
      declare_solver(prm);
      prm.declare_entry(
        "Threads",
        "1",
        dealii::Patterns::Integer(0, 1024),
        "Threads of the factorisation of the bodies' stiffness; "
        "0: one for each core. Of many processes (--processes) the "
        "first one has them, for what it does alone; the others have "
        "one each and sleep meanwhile. Results do not depend on it but "
        "for rounding.");
      prm.leave_subsection();
    }

    void
    declare_output_section(Handler &prm)
    {
      prm.enter_subsection("Output");
      prm.declare_entry("VTU",
                        "1",
                        dealii::Patterns::Integer(0),
                        "Write VTU files for ParaView at every n-th increment; "
                        "0: none.");
      prm.declare_entry(
        "Units",
        "",
        dealii::Patterns::Anything(),
        "Names of the units of force, length, time and temperature that this "
        "scene is in, such as N, mm, s, K (the last two may be left out). VTU "
        "files, pictures and reports show them; nothing is computed with them. "
        "Empty: not told.");
      prm.declare_entry(
        "Probes",
        "",
        dealii::Patterns::Anything(),
        "Points of the undeformed bodies whose displacement "
        "history.csv tells, each with a name: 'tip: 1, 0, 0 ; "
        "edge: 0.5, 0, 1'; 'edge in block: 0.5, 0, 1' where "
        "several bodies hold the point. Between nodes it is that "
        "of the element, of members of frames with the loads on "
        "them [length].");
      prm.declare_entry("Checkpoint",
                        "0",
                        dealii::Patterns::Integer(0),
                        "Keep what is needed to go on with --restart, in "
                        "checkpoint.bin, at every n-th increment and at the "
                        "last one; 0: never.");
      prm.declare_entry(
        "Uniqueness",
        "no",
        dealii::Patterns::Selection("no|yes"),
        "Whether to judge that each increment has one solution. The answer is "
        "yes, by a bound on the coefficients of friction from the condensed "
        "stiffness; or no, with another solution in reactions-2.csv; or open. "
        "Supports must hold the bodies, which may have up to 2000 contact "
        "unknowns.");
      prm.declare_entry(
        "FCLib increments",
        "",
        dealii::Patterns::Anything(),
        "Write the condensed problem of these increments "
        "(numbers from 1 on separated by commas, or all) with "
        "its solution as problem-0001.hdf5, ..., local problems "
        "of FCLib; empty: none.");
      prm.declare_entry(
        "Text increments",
        "",
        dealii::Patterns::Anything(),
        "Write the condensed problem of these increments "
        "(numbers from 1 on separated by commas, or all) as "
        "plain text, problem-0001.txt, ..., in the units of the "
        "scene, for conetact-reproductions or a script; of a "
        "load path: of these stages, with its constant loads "
        "as problem-0000.txt; empty: none.");
      prm.leave_subsection();
    }
  } // namespace



  void
  declare_lists(Handler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Dimension",
                      "2",
                      Selection("2|3"),
                      "Dimension of space: 2 (plane strain or stress) or 3.");
    const auto declare = [&](const std::string &list,
                             const std::string &what,
                             const std::string &more = "") {
      prm.declare_entry(list,
                        "",
                        Anything(),
                        "Names of " + what +
                          ", separated by commas; each has "
                          "its own subsection." +
                          more);
    };
    declare("Bodies", "the elastic bodies");
    declare("Obstacles", "the rigid obstacles");
    declare("Contacts",
            "the contacts",
            " 'automatic' stands for all pairs that are near, see Automatic "
            "contact.");
    declare("Supports", "the supports");
    declare("Loads", "the loads");
    prm.declare_entry(
      "Gravity",
      "",
      Anything(),
      "Acceleration, a component for each axis: 0, -9.81. It "
      "is a load 'weight BODY' from t = 0 on for each body with "
      "a Density; for a weight that grows, use Kind = body "
      "force. Empty: none. [length/time^2]");
  }



  void
  declare_scene(Handler &prm, const SceneNames &names)
  {
    declare_lists(prm);
    declare_adaptive(prm);
    declare_each(prm, "Body", names.bodies, bodies::declare_body);
    declare_each(prm, "Obstacle", names.obstacles, pairing::declare_obstacle);
    declare_each(prm, "Contact", names.contacts, pairing::declare_contact);
    declare_automatic_contact(prm);
    declare_each(prm, "Support", names.supports, bodies::declare_support);
    declare_each(prm, "Load", names.loads, bodies::declare_load);
    prm.enter_subsection("Time");
    declare_time(prm);
    prm.leave_subsection();
    declare_solver_section(prm);
    declare_output_section(prm);
  }
} // namespace conetact::application
