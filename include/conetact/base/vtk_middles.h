// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_vtk_middles_h
#define conetact_base_vtk_middles_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /**
   * Brings middle nodes of cells in space into Gmsh's order by their places:
   * what Gmsh reads from a .vtk file of second order it keeps in an order that
   * is neither its own nor VTK's.
   */
  void
  arrange_middles_of_vtk(FileMesh &mesh);
} // namespace conetact

#endif
