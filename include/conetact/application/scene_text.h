// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_text_h
#define conetact_application_scene_text_h

#include "conetact/application/scene_file.h"

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace conetact::application
{
  /**
   * Reads a scene's text with the handler. With `skip_undefined`, entries and
   * subsections that are not declared are passed over. Throws InputError whose
   * sentence names the file and the line, the fault, and what may stand there
   * instead: the declared name that is most alike.
   */
  void
  parse_scene_text(dealii::ParameterHandler &prm,
                   const SceneText          &scene,
                   const bool                skip_undefined);

  /**
   * Throws InputError where an entry or a subsection stands twice: the handler
   * would silently take the last one. What a file includes may be replaced by
   * entries of its own behind that line.
   */
  void
  refuse_repeats(const SceneText &scene);

  /**
   * Takes out subsections of files that are included where a list nearer to the
   * user, of the file that includes them or of the command line, does not name
   * them any more. Returns sentences of what is left out.
   */
  std::vector<std::string>
  leave_out_unlisted(SceneText                      &scene,
                     const std::vector<std::string> &overrides);

  /** Values by their paths, "Contact bottom/Friction coefficient". */
  using Entries = std::map<std::string, std::string>;
  Entries
  entries_of(const std::string &text);

  /**
   * The last line, counted from 0, that sets an entry or begins a subsection,
   * "Body block/Material"; none: it is not there.
   */
  std::optional<std::size_t>
  place_of(const SceneText &scene, const std::string &path);

  /** Whether "A/B/Entry=value" of the command line sets the entry at `path`. */
  bool
  sets(const std::string &override, const std::string &path);

  /**
   * Sets one entry, "A/B/Entry=value" of the command line. Throws InputError,
   * also where the entry is not declared, unless `skip_undefined`.
   */
  void
  parse_override(dealii::ParameterHandler &prm,
                 const std::string        &override,
                 const bool                skip_undefined);
} // namespace conetact::application

#endif
