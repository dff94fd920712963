// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_deck_mesh_h
#define conetact_base_deck_mesh_h

#include "conetact/base/file_mesh.h"

#include <filesystem>

namespace conetact
{
  /**
   * The mesh of a deck of Abaqus or CalculiX: nodes, elements, sets, surfaces
   * of elements and of nodes, parts and their instances. Sets of elements,
   * instances and surfaces become groups of their names; a set of nodes is the
   * group of those faces of cells that have all their corners in it. What is
   * in a part is called 'INSTANCE.NAME', and 'NAME' for all instances. Keywords
   * of the analysis are passed over with a note. `path` is for included files.
   * Throws FileFault.
   */
  FileMesh
  read_deck(const std::string &contents, const std::filesystem::path &path);
} // namespace conetact

#endif
