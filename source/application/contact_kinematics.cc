// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/contact_kinematics.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/contact/free_spins.h"
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

    /** Least and largest gap of a contact's nodes at the start. */
    void
    take_gaps(const std::vector<pairing::ContactNode> &nodes,
              const unsigned int                       contact,
              pairing::Pairing                        &found)
    {
      std::vector<double> gaps;
      for (const pairing::ContactNode &node : nodes)
        if (node.contact == contact && !node.meets_nothing())
          gaps.push_back(pairing::gap_at_start(node));
      if (gaps.empty())
        return;
      found.least_gap   = *std::min_element(gaps.begin(), gaps.end());
      found.largest_gap = *std::max_element(gaps.begin(), gaps.end());
    }

    bool
    slides_in_continued_run(const Restart &run, const unsigned int contact)
    {
      const std::vector<double> numbers = run.state.get(kept_sliding);
      return std::find(numbers.begin(), numbers.end(), contact) !=
             numbers.end();
    }

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

  void
  save_kinematics(const std::vector<pairing::Contact> &contacts,
                  Archive                             &archive)
  {
    std::vector<double> numbers;
    for (unsigned int c = 0; c < contacts.size(); ++c)
      if (contacts[c].slides)
        numbers.push_back(c);
    archive.put(kept_sliding, numbers);
  }

  ContactKinematicsChoice::ContactKinematicsChoice(
    const RunSettings                       &s,
    const FormerKinematics                  &f,
    SceneObjects                            &of,
    std::vector<pairing::ContactKinematics> &chosen)
    : settings(s)
    , former(f)
    , scene(of)
    , kinematics(chosen)
  {
    AssertDimension(kinematics.size(), scene.contacts.size());
  }

  std::string
  ContactKinematicsChoice::why_not_sliding(
    const pairing::Contact &contact) const
  {
    if (settings.path.follows)
      return "a load path follows contacts of undeformed bodies";
    if (settings.adaptive.cycles > 0)
      return "meshes are refined for contacts of undeformed bodies. Set "
             "Adaptive refinement to 0";
    return pairing::why_not_sliding(contact, scene.bodies.structures);
  }

  /* Turns that are prescribed. */
  std::string
  ContactKinematicsChoice::why_it_turns(const pairing::Contact &contact) const
  {
    constexpr double                least = .05; // degrees
    const std::vector<unsigned int> joined =
      bodies_with(contact, scene.contacts);
    const auto turns = [&](const Expression &angle) {
      return std::any_of(settings.times.begin(),
                         settings.times.end(),
                         [&](const double t) {
                           return std::abs(angle(Point<3>(), t)) > least;
                         });
    };
    if (contact.obstacle != nullptr && contact.obstacle->turn &&
        turns(*contact.obstacle->turn))
      return "obstacle '" + contact.obstacle->name + "' turns";
    for (const bodies::Support &support : scene.bodies.supports)
      if (support.turn && turns(support.turn->angle) &&
          std::count(joined.begin(), joined.end(), support.body) > 0)
        return "body '" + scene.bodies.names[support.body] + "' turns";
    return "";
  }

  void
  ContactKinematicsChoice::begin(const unsigned int c)
  {
    pairing::Contact           &contact = scene.contacts[c];
    pairing::ContactKinematics &chosen  = kinematics[c];
    chosen.why_not_finite               = why_not_sliding(contact);
    chosen.why_finite                   = why_it_turns(contact);
    const bool may_ask                  = chosen.why_not_finite.empty();
    if (may_ask && contact.kind == pairing::ContactKind::tie)
      chosen.why_not_finite =
        "a tie turns with its bodies only where its sides touch at the start";
    if (former.shown_to_slide.count(c) > 0)
      chosen.why_finite = former.shown_to_slide.at(c);
    if (former.restart && chosen.asked == pairing::Kinematics::automatic)
      {
        if (slides_in_continued_run(*former.restart, c))
          chosen.why_finite = "it slides far in the run that is continued";
        else if (!former.restart->is_of_this_run)
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
  ContactKinematicsChoice::change(const unsigned int c, const std::string &held)
  {
    pairing::Contact           &contact = scene.contacts[c];
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
      chosen.why_not_plane = pairing::why_not_plane(contact,
                                                    c,
                                                    scene.bodies.contact_nodes,
                                                    scene.bodies.structures,
                                                    scene.bodies.dim);
    contact.slides = chosen.slides();
    return contact.slides != before;
  }

  std::vector<pairing::Pairing>
  ContactKinematicsChoice::pair(const std::vector<unsigned int> &adjusted)
  {
    const auto &structures = scene.bodies.structures;
    for (unsigned int c = 0; c < scene.contacts.size(); ++c)
      begin(c);
    pairing::ContactNodes found;
    for (bool again = true; again;)
      {
        found  = pairing::find_contact_nodes(scene.contacts,
                                            scene.bodies.names,
                                            structures,
                                            scene.bodies.dim);
        shared = pairing::unite_shared(scene.contacts,
                                       structures,
                                       scene.bodies.dim,
                                       found.nodes);
        pairing::share_areas(scene.contacts,
                             structures,
                             /*only_sliding=*/false,
                             found.nodes);
        scene.bodies.contact_nodes = std::move(found.nodes);
        for (unsigned int c = 0; c < scene.contacts.size(); ++c)
          if (pairing::lift_convex_faces(
                scene.contacts[c], c, structures, scene.bodies.contact_nodes))
            take_gaps(scene.bodies.contact_nodes, c, found.pairings[c]);
        for (const unsigned int c : adjusted)
          pairing::adjust_gaps(scene.contacts[c],
                               c,
                               structures,
                               scene.bodies.contact_nodes);
        contact::align_with_supports(scene.bodies, scene.bodies.contact_nodes);
        contact::point_to_axes(scene.bodies, scene.bodies.contact_nodes);
        const auto held = contact::why_held_nodes_do_not_slide(scene.bodies);
        again           = false;
        for (unsigned int c = 0; c < scene.contacts.size(); ++c)
          again |= change(c, held.count(c) > 0 ? held.at(c) : std::string());
      }
    return std::move(found.pairings);
  }
} // namespace conetact::application
