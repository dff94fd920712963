// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_text_h
#define conetact_application_scene_text_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace conetact::application
{
  /**
   * Reads a scene's text with the handler. With `skip_undefined`, entries and
   * subsections that are not declared are passed over. Throws InputError whose
   * sentence names `file` and the line, the fault, and what may stand there
   * instead: the declared name that is most alike.
   */
  void
  parse_scene_text(dealii::ParameterHandler &prm,
                   const std::string        &text,
                   const std::string        &file,
                   const bool                skip_undefined);

  /**
   * Throws InputError where an entry or a subsection stands twice: the handler
   * would silently take the last one.
   */
  void
  refuse_repeats(const std::string &text, const std::string &file);

  /** Values by their paths, "Contact bottom/Friction coefficient". */
  using Entries = std::map<std::string, std::string>;
  Entries
  entries_of(const std::string &text);

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
