// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_frame_parameters_h
#define conetact_bodies_frame_parameters_h

#include "conetact/bodies/frame/frame_model.h"

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <string>

namespace conetact::bodies
{
  /**
   * Entries of a frame in the body's subsection: `Sections`, a list of names
   * each of which brings its own `subsection Section NAME` as soon as the list
   * is read, and `subsection Frame`. The handler must outlive its parsing.
   */
  void
  declare_frame(dealii::ParameterHandler &prm);
  /**
   * The finished frame of the parsed entries; a relative file is one in
   * `folder`; `body` is for messages: "Body 'roof'". Throws InputError.
   */
  FrameModel
  parse_frame(dealii::ParameterHandler    &prm,
              const unsigned int           dim,
              const std::filesystem::path &folder,
              const std::string           &body);
} // namespace conetact::bodies

#endif
