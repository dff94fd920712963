// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_manual_h
#define conetact_application_manual_h

#include <string>

namespace conetact::application
{
  /**
   * Every entry of a scene with its default and its documentation, as Markdown:
   * what `--parameters` prints without a scene. NAME stands for names of the
   * user's own.
   */
  std::string
  manual();

  /** A scene to begin with, small and commented; it runs as it is. */
  std::string
  starter_scene();

  /**
   * Writes it to NAME.prm in the folder of the run and returns what to do next.
   * Throws InputError where the file exists, WriteError.
   */
  std::string
  write_starter_scene(const std::string &name);
} // namespace conetact::application

#endif
