// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_library_meshes_h
#define conetact_bodies_continuum_library_meshes_h

#include "conetact/base/file_mesh.h"

#include <deal.II/grid/grid_in.h>

#include <string>

namespace conetact::bodies
{
  /** A file and which of deal.II's readers it is for. */
  struct LibraryFile
  {
    std::string               where; ///< "Body 'block', Mesh/File: "
    std::string               name;
    const std::string        &contents;
    dealii::GridIn<2>::Format format;
  };

  /**
   * Reads a mesh by deal.II in a process apart, since its readers do not check
   * what they are told. Ids other than 0 become groups of this number. Throws
   * InputError.
   */
  template <int dim>
  FileMesh
  read_by_library(const LibraryFile &file);
} // namespace conetact::bodies

#endif
