// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_generators_h
#define conetact_bodies_frame_generators_h

#include "conetact/bodies/frame/frame_model.h"

#include <string>
#include <vector>

namespace conetact::bodies
{
  /** One row for each frame that a few numbers describe. */
  struct FrameGenerator
  {
    const char *name;
    const char *description; ///< with its arguments
    /**
     * Fills in nodes and members, all of the first section, from the
     * arguments, parts of the entry `where` + "Arguments".
     */
    void (*generate)(const std::vector<std::string> &arguments,
                     const std::string              &where,
                     FrameModel                     &model);
  };
  const std::vector<FrameGenerator> &
  frame_generators();
} // namespace conetact::bodies

#endif
