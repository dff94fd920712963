// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_bent_edges_h
#define conetact_base_bent_edges_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /** Edges of elements of second order whose middle nodes lie beside the
   * straight line between their ends. */
  struct BentEdges
  {
    std::size_t n        = 0;
    double      distance = 0; ///< of the middle node furthest off [length]
    Point<3>    place;        ///< of that node
  };
  BentEdges
  bent_edges(const FileMesh                               &mesh,
             const std::vector<const FileMesh::Element *> &elements);
  /** What a user must know of them, a sentence; empty: there are none. The
   * distance times `scale`, `place` in the scene. */
  std::string
  to_sentence(const BentEdges   &edges,
              const std::string &file,
              const double       scale,
              const Point<3>    &place);
} // namespace conetact

#endif
