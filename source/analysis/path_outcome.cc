// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/path_outcome.h"

#include "conetact/base/text.h"
#include "conetact/output/csv.h"

#include <map>
#include <utility>

namespace conetact::analysis
{
  namespace
  {
    std::string
    at_parameter(const PathEnd &end)
    {
      std::string text;
      output::append_number(text, end.result.parameter);
      return end.constant ?
               "when " + text + " of what acts at t = 0 is applied" :
               "at p = " + text;
    }

    /** " after 2 turning points"; `where`: with the first of them. */
    std::string
    turns(const PathEnd &end, const bool where)
    {
      if (end.n_turns == 0)
        return "";
      std::string text =
        " after " + std::to_string(end.n_turns) +
        (end.n_turns == 1 ? " turning point" : " turning points");
      if (!where)
        return text;
      text += end.n_turns == 1 ? " (p = " : " (the first at p = ";
      output::append_number(text, end.first_turn);
      return text + ")";
    }

    /** "; nodes 1, 2 of contact 'floor' slide, node 3 ... stays". */
    std::string
    motion(const PathEnd               &end,
           const contact::ContactModel &model,
           const application::Scene    &scene)
    {
      std::string text;
      const auto  add = [&](const std::vector<std::size_t> &nodes,
                           const char                     *one,
                           const char                     *several) {
        if (!nodes.empty())
          text += (text.empty() ? ": " : ", ") +
                  contact::name_nodes(model, scene.contact_names, nodes) +
                  (nodes.size() == 1 ? one : several);
      };
      add(end.mechanism->slide, " slides", " slide");
      add(end.mechanism->stay,
          end.mechanism->open.empty() ? " stays" : " is the pivot",
          end.mechanism->open.empty() ? " stay" : " are the pivot");
      add(end.mechanism->open, " lifts off", " lift off");
      return text;
    }
  } // namespace



  const char *
  state_name(const load_path::PathState state)
  {
    switch (state)
      {
        case load_path::PathState::open:
          return "open";
        case load_path::PathState::stick:
          return "stick";
        case load_path::PathState::slip_plus:
          return "slip+";
        case load_path::PathState::slip_minus:
          return "slip-";
        case load_path::PathState::slip:
          return "slip";
        case load_path::PathState::open_plus:
          return "open+";
        case load_path::PathState::open_minus:
          return "open-";
      }
    return "";
  }



  const char *
  load_name(const load_path::PathPoint &point)
  {
    if (point.turn)
      return point.way < 0 ? "turns down" : "turns up";
    return point.way < 0 ? "falls" : "rises";
  }



  std::string
  outcome_words(const PathEnd &end)
  {
    const std::string on_the_way = end.on_the_way + turns(end, false);
    switch (end.result.outcome)
      {
        case load_path::PathOutcome::target_reached:
          return "target reached" + on_the_way;
        case load_path::PathOutcome::no_further_change:
          return "no further change" + on_the_way;
        case load_path::PathOutcome::limit_load:
          return "limit load: " + end.mechanism->kind + on_the_way +
                 (end.constant ? " under the constant loads" : "");
        case load_path::PathOutcome::turning_point:
          return "turning point" + on_the_way;
        case load_path::PathOutcome::returned_to_start:
          return "returned to start" + on_the_way;
        case load_path::PathOutcome::cycle:
          return "cycle" + on_the_way;
        case load_path::PathOutcome::no_equilibrium:
          return "jump without equilibrium" + on_the_way;
        case load_path::PathOutcome::not_converged:
          return "not converged" + on_the_way;
      }
    return "";
  }



  std::string
  outcome_sentence(const PathEnd               &end,
                   const contact::ContactModel &model,
                   const application::Scene    &scene)
  {
    const std::string at = at_parameter(end), &reason = end.result.reason;
    const std::string on_the_way = end.on_the_way + turns(end, true);
    switch (end.result.outcome)
      {
        case load_path::PathOutcome::target_reached:
          return "Target reached " + at + on_the_way + ".";
        case load_path::PathOutcome::no_further_change:
          return "Target reached " + at + on_the_way +
                 "; no further change of the contact states for any larger p. "
                 "This is no limit load.";
        case load_path::PathOutcome::limit_load:
          return "Limit load " + at + on_the_way +
                 (reason.empty() ? "" : " (" + reason + ")") +
                 ", a mechanism of " + end.mechanism->kind +
                 motion(end, model, scene) + ".";
        case load_path::PathOutcome::turning_point:
          return "Turning point " + at + on_the_way +
                 ": the path goes on only if the load decreases" +
                 (reason.empty() ? "." : "; " + reason + ".");
        case load_path::PathOutcome::returned_to_start:
          return "The load has fallen to that of the start of its stage, " +
                 at + on_the_way +
                 ": another equilibrium of the same loads. What came before this "
                 "stage is not followed back; let a stage begin with less load "
                 "to see more of the path.";
        case load_path::PathOutcome::cycle:
          return "The path has come back " + at + on_the_way +
                 " to a piece that it has followed before, and would follow it "
                 "for ever. Several nodes change their states together there: "
                 "a small change of loads or friction parts them.";
        case load_path::PathOutcome::no_equilibrium:
          return "A jump without an end " + at + on_the_way +
                 ": next to this state nothing balances a larger load, and no "
                 "other equilibrium was found under it" +
                 (reason.empty() ? "" : " (" + reason + ")") +
                 ". The bodies would move on with inertia, which a load path "
                 "leaves out; Solver/Law = holonomic may follow falling loads.";
        case load_path::PathOutcome::not_converged:
          return "The path is not converged " + at + on_the_way +
                 (reason.empty() ? "" : ": " + reason) +
                 ". All events before it are on disk.";
      }
    return "";
  }



  std::string
  interrupted_path(const unsigned int           point,
                   const double                 t,
                   const std::filesystem::path &folder)
  {
    return "Interrupted at point " + std::to_string(point) +
           " of the path, t = " + to_text(t) +
           ": it and all before it are on disk in " + folder.string() +
           ". A load path cannot be continued: run it from its start.";
  }

  std::string
  node_in_several_contacts(const contact::ContactModel &model,
                           const application::Scene    &scene)
  {
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> seen;
    for (const contact::ContactPoint &point : model.points)
      {
        const pairing::ContactNode &node = *point.node;
        const auto                  other =
          seen.emplace(std::make_pair(node.body, node.node), node.contact)
            .first;
        if (other->second != node.contact)
          return "the node at " + to_text(node.position) + " of body '" +
                 scene.bodies.names[node.body] + "' stands in contacts '" +
                 scene.contact_names[other->second] + "' and '" +
                 scene.contact_names[node.contact] + "'";
      }
    return "";
  }

  std::string
  why_dependent(const contact::ContactModel &model,
                const application::Scene    &scene)
  {
    const std::string shared = node_in_several_contacts(model, scene);
    return "Solver/Method: a load path needs contacts that do not depend on "
           "each other, but " +
           (shared.empty() ?
              "some contact nodes are held on both sides, or slide along "
              "what supports hold. Take them out of a contact or a support, "
              "or choose automatic." :
              shared + ". Take it out of one of them (Boundary ids), or "
                       "choose automatic.");
  }
} // namespace conetact::analysis
