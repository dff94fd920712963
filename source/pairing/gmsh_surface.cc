// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Lines and faces of Gmsh's files.

#include "conetact/base/gmsh_file.h"
#include "conetact/pairing/surface_words.h"

namespace conetact::pairing
{
  SurfaceFaces
  read_msh(const std::string &contents, const unsigned int dim)
  {
    FileMesh file;
    try
      {
        file = read_gmsh(contents);
      }
    catch (const FileFault &fault)
      {
        throw Fault{fault.why};
      }
    SurfaceFaces mesh;
    mesh.points = file.points;
    std::vector<const FileMesh::Element *> taken;
    for (const FileMesh::Element &element : file.elements)
      if (element.dim == dim - 1) // not the lines round faces, nor cells
        {
          mesh.faces.push_back(element.nodes);
          taken.push_back(&element);
        }
    mesh.bent = bent_edges(file, taken);
    return mesh;
  }
} // namespace conetact::pairing
