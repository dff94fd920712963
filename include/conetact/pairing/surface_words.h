// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_surface_words_h
#define conetact_pairing_surface_words_h

#include "conetact/base/bent_edges.h"
#include "conetact/base/points.h"

#include <istream>
#include <string>
#include <vector>

namespace conetact::pairing
{
  /**
   * Faces of a file: segments, triangles or quadrilaterals, corners one after
   * the other around the face, counter-clockwise seen from outside.
   */
  struct SurfaceFaces
  {
    std::vector<Point<3>>                  points;
    std::vector<std::vector<unsigned int>> faces; ///< numbers of points
    BentEdges                              bent;  ///< of second order
  };

  // What readers of surfaces share. Nothing but Fault leaves them.

  /** What is wrong with a file, without its name: "it ends in the middle". */
  struct Fault
  {
    std::string why;
  };

  double
  read_number(std::istream &stream);
  /** Three numbers, which may be any. */
  Point<3>
  read_point(std::istream &stream);

  /** The contents of a Gmsh file; of dim = 2 the lines. */
  SurfaceFaces
  read_msh(const std::string &contents, const unsigned int dim);
} // namespace conetact::pairing

#endif
