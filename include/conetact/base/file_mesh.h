// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_file_mesh_h
#define conetact_base_file_mesh_h

#include "conetact/base/points.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace conetact
{
  /**
   * Numbers of groups from here on are given by the program: to groups that
   * have names only, and to what is in several groups. They have more digits
   * than a user can write, so that no number of a scene means them.
   */
  constexpr unsigned int own_numbers = 1000000000;

  /**
   * What a mesh file holds, whatever its format: points, elements with the
   * groups that they belong to, and the names of these groups. Each reader
   * fills one, and `bodies/continuum/file_cells.h` makes cells of it.
   */
  struct FileMesh
  {
    /**
     * A cell, or a face of cells that has groups. Nodes are points in Gmsh's
     * order: corners, and behind them for elements of second order the middles
     * of edges, of faces and of the cell, as many as the file has.
     */
    struct Element
    {
      unsigned int              dim;   ///< of a line 1, of a tetrahedron 3
      std::vector<unsigned int> nodes; ///< the corners
      std::set<unsigned int>    groups;
      std::vector<unsigned int> middles = {}; ///< empty: of first order
    };
    std::vector<Point<3>> points;
    std::vector<Element>  elements; ///< without points
    /** By dimension and number. */
    std::map<std::pair<unsigned int, unsigned int>, std::string> names;
    /** What the log says of it, such as what was not read. */
    std::vector<std::string> notes = {};
  };

  /** What is wrong with a file, without its name: "it ends in the middle". */
  struct FileFault
  {
    std::string why;
    std::string entry = {}; ///< of the mesh that asks for it; empty: the file
  };
} // namespace conetact

#endif
