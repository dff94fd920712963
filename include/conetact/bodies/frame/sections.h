// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_sections_h
#define conetact_bodies_frame_sections_h

#include "conetact/bodies/frame/frame_model.h"

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * Entry `Sections`, a list of names. Each name that is read declares its own
   * `subsection Section NAME`: the list must stand before them.
   */
  void
  declare_sections(dealii::ParameterHandler &prm);
  /** `body` is for messages: "Body 'roof'". Throws InputError. */
  std::vector<FrameSection>
  parse_sections(dealii::ParameterHandler &prm,
                 const unsigned int        dim,
                 const std::string        &body);
} // namespace conetact::bodies

#endif
