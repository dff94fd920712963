// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_unv_file_h
#define conetact_base_unv_file_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /**
   * The mesh of a universal file of I-DEAS, as Salome, FreeCAD and Gmsh write
   * it: nodes (dataset 2411), elements (2412) and groups of both with their
   * names (2467, 2477 and their forerunners). A group of nodes is that of the
   * faces that have all their corners in it. Throws FileFault.
   */
  FileMesh
  read_unv(const std::string &contents);
} // namespace conetact

#endif
