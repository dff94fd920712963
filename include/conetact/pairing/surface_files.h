// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_surface_files_h
#define conetact_pairing_surface_files_h

#include "conetact/pairing/surface_words.h"

#include <filesystem>
#include <string>

namespace conetact::pairing
{
  /**
   * Reads STL (ASCII or binary), Wavefront OBJ (faces of more than four
   * corners as fans of triangles) or Gmsh (.msh, versions 2 and 4.1), by
   * extension. In the plane lines are taken, of Gmsh only. Points that
   * are meant to be one become one (joined()). `entry` is named in messages.
   * Throws InputError.
   */
  SurfaceFaces
  read_surface(const std::filesystem::path &file,
               const unsigned int           dim,
               const std::string           &entry);
} // namespace conetact::pairing

#endif
