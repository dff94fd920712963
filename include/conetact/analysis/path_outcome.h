// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_path_outcome_h
#define conetact_analysis_path_outcome_h

#include "conetact/application/scene.h"
#include "conetact/contact/mechanism.h"
#include "conetact/load_path/load_path.h"

#include <filesystem>
#include <optional>
#include <string>

namespace conetact::analysis
{
  /** open, stick, slip+, slip- or slip. */
  const char *
  state_name(const load_path::PathState state);

  /** What the load does at a point, from there on: rises, turns down, ... */
  const char *
  load_name(const load_path::PathPoint &point);

  /** How a path ended. */
  struct PathEnd
  {
    load_path::PathResult             result;
    std::optional<contact::Mechanism> mechanism; ///< at a limit load
    std::string  on_the_way;         ///< " after a jump at p = 2", or nothing
    bool         constant   = false; ///< not all that acts at p = 0 was applied
    unsigned int n_turns    = 0;     ///< of the load parameter
    double       first_turn = 0;     ///< the first of them
    double
    parameter() const
    {
      return constant ? 0. : result.parameter;
    }
  };

  /** The words of the last line of events.csv: "limit load: sliding". */
  std::string
  outcome_words(const PathEnd &end);

  /** The same as a sentence that names loads and nodes. */
  std::string
  outcome_sentence(const PathEnd               &end,
                   const contact::ContactModel &model,
                   const application::Scene    &scene);

  /** What is on disk of a path that was interrupted, a sentence. */
  std::string
  interrupted_path(const unsigned int           point,
                   const double                 t,
                   const std::filesystem::path &folder);

  /** A contact node that stands in more than one contact, and in which, as part
   * of a sentence; empty: none does. */
  std::string
  node_in_several_contacts(const contact::ContactModel &model,
                           const application::Scene    &scene);

  /** Why no path is followed with contacts that depend on each other, a
   * sentence. */
  std::string
  why_dependent(const contact::ContactModel &model,
                const application::Scene    &scene);
} // namespace conetact::analysis

#endif
