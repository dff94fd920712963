// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Which contacts slide far: what is asked for, or what geometry, prescribed
// motions and former runs tell.

#include "conetact/application/scene.h"
#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/held_nodes.h"
#include "conetact/pairing/adjusted_gaps.h"
#include "conetact/pairing/flatness.h"
#include "conetact/pairing/shared_areas.h"
#include "conetact/pairing/shared_nodes.h"

#include <algorithm>
#include <cmath>

namespace conetact::application
{
  namespace
  {
    constexpr const char *kept_sliding = "sliding contacts";

    bool
    slides_in_continued_run(const Scene::Restart &run,
                            const unsigned int    contact)
    {
      const std::vector<double> numbers = run.state.get(kept_sliding);
      return std::find(numbers.begin(), numbers.end(), contact) !=
             numbers.end();
    }
  } // namespace

  void
  Scene::save_kinematics(Archive &archive) const
  {
    std::vector<double> numbers;
    for (unsigned int c = 0; c < contacts.size(); ++c)
      if (contacts[c].slides)
        numbers.push_back(c);
    archive.put(kept_sliding, numbers);
  }

  std::string
  Scene::why_not_sliding(const pairing::Contact &contact) const
  {
    if (path.follows)
      return "a load path follows contacts of undeformed bodies";
    if (adaptive.cycles > 0)
      return "meshes are refined for contacts of undeformed bodies. Set "
             "Adaptive refinement to 0";
    return pairing::why_not_sliding(contact, bodies.structures);
  }

  namespace
  {
    /** Bodies of a contact, and those that turn with them because they are
     * tied. */
    std::vector<unsigned int>
    bodies_with(const pairing::Contact              &contact,
                const std::vector<pairing::Contact> &all)
    {
      std::vector<unsigned int> found = {contact.body};
      if (contact.obstacle == nullptr)
        found.push_back(contact.master);
      const auto has = [&](const unsigned int body) {
        return std::count(found.begin(), found.end(), body) > 0;
      };
      for (std::size_t before = 0; before != found.size();)
        {
          before = found.size();
          for (const pairing::Contact &tie : all)
            if (tie.kind == pairing::ContactKind::tie &&
                tie.obstacle == nullptr && has(tie.body) != has(tie.master))
              found.push_back(has(tie.body) ? tie.master : tie.body);
        }
      return found;
    }
  } // namespace

  /* Turns that are prescribed. */
  std::string
  Scene::why_it_turns(const pairing::Contact &contact) const
  {
    constexpr double                least  = .05; // degrees
    const std::vector<unsigned int> joined = bodies_with(contact, contacts);
    const auto                      turns  = [&](const Expression &angle) {
      return std::any_of(times.begin(), times.end(), [&](const double t) {
        return std::abs(angle(Point<3>(), t)) > least;
      });
    };
    if (contact.obstacle != nullptr && contact.obstacle->turn &&
        turns(*contact.obstacle->turn))
      return "obstacle '" + contact.obstacle->name + "' turns";
    for (const bodies::Support &support : bodies.supports)
      if (support.turn && turns(support.turn->angle) &&
          std::count(joined.begin(), joined.end(), support.body) > 0)
        return "body '" + bodies.names[support.body] + "' turns";
    return "";
  }

  void
  Scene::begin_kinematics(const unsigned int c)
  {
    pairing::Contact           &contact = contacts[c];
    pairing::ContactKinematics &chosen  = kinematics[c];
    chosen.why_not_finite               = why_not_sliding(contact);
    chosen.why_finite                   = why_it_turns(contact);
    const bool may_ask                  = chosen.why_not_finite.empty();
    if (may_ask && contact.kind == pairing::ContactKind::tie)
      chosen.why_not_finite =
        "a tie turns with its bodies only where its sides touch at the start";
    if (shown_to_slide.count(c) > 0)
      chosen.why_finite = shown_to_slide.at(c);
    if (restart && chosen.asked == pairing::Kinematics::automatic)
      {
        if (slides_in_continued_run(*restart, c))
          chosen.why_finite = "it slides far in the run that is continued";
        else
          chosen.why_not_finite =
            "the run that is continued has it small; run the scene from its "
            "start";
      }
    if (chosen.asked == pairing::Kinematics::finite_sliding)
      {
        if (!may_ask)
          throw InputError("Contact '" + contact.name + "', Kinematics: " +
                           chosen.why_not_finite + ". Or choose small.");
        chosen.why_finite = "it is asked for";
      }
    contact.slides = chosen.slides();
  }

  /* What its nodes have shown. Returns whether they must be found anew. */
  bool
  Scene::change_kinematics(const unsigned int c, const std::string &held)
  {
    pairing::Contact           &contact = contacts[c];
    pairing::ContactKinematics &chosen  = kinematics[c];
    const bool                  before  = contact.slides;
    if (before && !held.empty())
      {
        chosen.why_not_finite = held;
        if (chosen.asked == pairing::Kinematics::finite_sliding)
          throw InputError("Contact '" + contact.name +
                           "', Kinematics: " + held + ".");
      }
    // told, but no reason yet: what is curved and pressed only is right to the
    // order of the angle by which its normals turn, and always found
    if (chosen.asked != pairing::Kinematics::finite_sliding &&
        !contact.spring && contact.kind != pairing::ContactKind::tie)
      chosen.why_not_plane = pairing::why_not_plane(
        contact, c, bodies.contact_nodes, bodies.structures, bodies.dim);
    contact.slides = chosen.slides();
    return contact.slides != before;
  }

  void
  Scene::pair_contacts()
  {
    for (unsigned int c = 0; c < contacts.size(); ++c)
      begin_kinematics(c);
    for (bool again = true; again;)
      {
        pairing::ContactNodes found = pairing::find_contact_nodes(
          contacts, bodies.names, bodies.structures, bodies.dim);
        n_shared = pairing::unite_shared(contacts,
                                         bodies.structures,
                                         bodies.dim,
                                         found.nodes);
        pairing::share_areas(contacts,
                             bodies.structures,
                             /*only_sliding=*/false,
                             found.nodes);
        bodies.contact_nodes = std::move(found.nodes);
        pairings             = std::move(found.pairings);
        for (const unsigned int c : adjusted_contacts)
          pairing::adjust_gaps(contacts[c],
                               c,
                               bodies.structures,
                               bodies.contact_nodes);
        contact::align_with_supports(bodies, bodies.contact_nodes);
        const auto held = contact::why_held_nodes_do_not_slide(bodies);
        again           = false;
        for (unsigned int c = 0; c < contacts.size(); ++c)
          again |=
            change_kinematics(c,
                              held.count(c) > 0 ? held.at(c) : std::string());
      }
  }

  void
  Scene::check_turning_supports() const
  {
    for (const bodies::Support &support : bodies.supports)
      if (support.turn && (path.follows || adaptive.cycles > 0))
        throw InputError("Support '" + support.name +
                         "', Turn: load paths and adaptive meshes are for "
                         "bodies that turn little. Leave Turn 0, or choose "
                         "another Solver/Method and Adaptive refinement = 0.");
  }
} // namespace conetact::application
