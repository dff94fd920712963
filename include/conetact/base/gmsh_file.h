// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_gmsh_file_h
#define conetact_base_gmsh_file_h

#include "conetact/base/points.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace conetact
{
  /**
   * What a mesh file of Gmsh holds: points, the corners of elements with the
   * physical groups that they belong to, and the names of these groups.
   * Versions 2 and 4.1, text or binary; the format is that of Gmsh's reference
   * manual, section "MSH file format".
   */
  struct GmshMesh
  {
    struct Element
    {
      unsigned int              dim;    ///< of a line 1, of a tetrahedron 3
      std::vector<unsigned int> nodes;  ///< of points, in Gmsh's order
      std::set<unsigned int>    groups; ///< numbers of physical groups
      std::vector<unsigned int> middles = {}; ///< of edges; of second order
    };
    std::vector<Point<3>> points;
    std::vector<Element>  elements; ///< without points
    /** By dimension and number. */
    std::map<std::pair<unsigned int, unsigned int>, std::string> names;
  };

  /** What is wrong with a file, without its name: "it ends in the middle". */
  struct GmshFault
  {
    std::string why;
  };

  /** Of the contents of a file; 1 for what has no header. */
  double
  gmsh_version(const std::string &contents);
  /** Throws GmshFault. */
  GmshMesh
  read_gmsh(const std::string &contents);
} // namespace conetact

#endif
