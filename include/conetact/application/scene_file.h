// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_file_h
#define conetact_application_scene_file_h

#include <filesystem>
#include <string>
#include <vector>

namespace conetact::application
{
  /** Where a line of a scene comes from. */
  struct LineOrigin
  {
    std::string  file;
    std::size_t  number = 0;
    unsigned int depth  = 0; ///< 0: the scene's own file, 1: included by it
  };

  /** The text of a scene with all files that it includes. */
  struct SceneText
  {
    std::string             text;
    std::vector<LineOrigin> origins; ///< of its lines

    /** A text that is in one file. */
    SceneText(const std::string &in_one, const std::string &file);
    SceneText() = default;

    /** "scene.prm, line 3", of a line that counts from 0. */
    std::string
    place(const std::size_t line) const;
  };

  /**
   * Reads a scene file and, where a line says `include FILE`, that file in its
   * place, relative to the folder of the file that says so. Line ends of all
   * systems, a mark of the encoding and letters in Latin-1 are taken as well as
   * UTF-8. Throws InputError.
   */
  SceneText
  read_scene_file(const std::filesystem::path &file);
} // namespace conetact::application

#endif
