// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/path_outcome.h"

#include "conetact/base/text.h"
#include "conetact/output/csv.h"

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



  std::string
  outcome_words(const PathEnd &end)
  {
    switch (end.result.outcome)
      {
        case load_path::PathOutcome::target_reached:
          return "target reached" + end.on_the_way;
        case load_path::PathOutcome::no_further_change:
          return "no further change" + end.on_the_way;
        case load_path::PathOutcome::limit_load:
          return "limit load: " + end.mechanism->kind + end.on_the_way +
                 (end.constant ? " under the constant loads" : "");
        case load_path::PathOutcome::turning_point:
          return "turning point" + end.on_the_way;
        case load_path::PathOutcome::not_converged:
          return "not converged" + end.on_the_way;
      }
    return "";
  }



  std::string
  outcome_sentence(const PathEnd               &end,
                   const contact::ContactModel &model,
                   const application::Scene    &scene)
  {
    const std::string at = at_parameter(end), &reason = end.result.reason;
    switch (end.result.outcome)
      {
        case load_path::PathOutcome::target_reached:
          return "Target reached " + at + end.on_the_way + ".";
        case load_path::PathOutcome::no_further_change:
          return "Target reached " + at + end.on_the_way +
                 "; no further change of the contact states for any larger p. "
                 "This is no limit load.";
        case load_path::PathOutcome::limit_load:
          return "Limit load " + at + end.on_the_way +
                 (reason.empty() ? "" : " (" + reason + ")") +
                 ", a mechanism of " + end.mechanism->kind +
                 motion(end, model, scene) + ".";
        case load_path::PathOutcome::turning_point:
          return "Turning point " + at + end.on_the_way +
                 ": the path goes on only if the load decreases" +
                 (reason.empty() ? "." : "; " + reason + ".");
        case load_path::PathOutcome::not_converged:
          return "The path is not converged " + at + end.on_the_way +
                 (reason.empty() ? "" : ": " + reason) +
                 ". All events before it are on disk.";
      }
    return "";
  }
} // namespace conetact::analysis
