// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_mistakes_h
#define conetact_application_scene_mistakes_h

#include "conetact/application/scene_lines.h"

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace conetact::application
{
  /** What no value may be, whatever the entry; empty: nothing. */
  std::string
  misread(const SceneLine &line);
  /** What is wrong with a line that the handler refuses with a message, and
   * what may stand there instead. */
  std::string
  mistake(const dealii::ParameterHandler &prm,
          const SceneLine                &line,
          const std::string              &message);
  /** Where a subsection that is not ended begins. */
  std::string
  unbalanced(const SceneText &scene, const std::vector<SceneLine> &lines);
} // namespace conetact::application

#endif
