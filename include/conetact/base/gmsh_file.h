// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_gmsh_file_h
#define conetact_base_gmsh_file_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /** Of the contents of a file; 1 for what has no header. */
  double
  gmsh_version(const std::string &contents);
  /**
   * Versions 2 and 4.1, text or binary; the format is that of Gmsh's reference
   * manual, section "MSH file format". Throws FileFault.
   */
  FileMesh
  read_gmsh(const std::string &contents);
} // namespace conetact

#endif
