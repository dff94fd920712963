// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_lines_h
#define conetact_application_scene_lines_h

#include "conetact/application/scene_file.h"

#include <string>
#include <vector>

namespace conetact::application
{
  /** One line of a scene and where it stands. */
  struct SceneLine
  {
    enum class Kind
    {
      none, ///< blank or a comment
      set,
      subsection,
      end,
      unknown
    };
    Kind                     kind = Kind::none;
    std::string              name, text;
    std::vector<std::string> path; ///< of subsections around it
  };

  /** Far more than any scene has inside of each other. */
  constexpr std::size_t most_sections = 20;

  /** One entry a line of the text. The scene tells places of errors. */
  std::vector<SceneLine>
  read_lines(const std::string &text, const SceneText *scene = nullptr);

  /** "Body block/Material/Poisson ratio" */
  std::string
  path_of(const SceneLine &line);
  /** What is behind the equals sign. */
  std::string
  value_of(const SceneLine &line);
  /** The list whose names have such subsections, Contacts of "Contact bottom";
   * empty: there is none. */
  std::string
  list_of(const std::string &subsection);
  /** " in 'Body block/Material'"; empty outside of all sections. */
  std::string
  in_section(const std::vector<std::string> &path);
} // namespace conetact::application

#endif
