// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_middle_nodes_h
#define conetact_base_middle_nodes_h

#include "conetact/base/file_mesh.h"

#include <cstdint>
#include <unordered_map>

namespace conetact
{
  /**
   * Nodes of second order by the two corners that they are halfway between: the
   * ends of an edge, or of a diagonal of a quadrilateral or a hexahedron. Nodes
   * inside faces and cells that a file leaves out (quadrilaterals of 8 nodes,
   * hexahedra of 20) are where the shape functions of the others put them.
   */
  class MiddleNodes
  {
  public:
    MiddleNodes(const FileMesh                               &mesh,
                const std::vector<const FileMesh::Element *> &cells);

    /** Whether all cells are of first order. */
    bool
    empty() const
    {
      return places.empty();
    }
    /** Where no element has a node it is the mean of both. */
    Point<3>
    between(const unsigned int a, const unsigned int b) const;

  private:
    void
    add_edges(const FileMesh::Element &cell);
    void
    add_quads(const FileMesh::Element &cell);
    void
    add_centre(const FileMesh::Element &cell);

    const FileMesh                             &file;
    std::unordered_map<std::uint64_t, Point<3>> places; ///< of pairs
  };
} // namespace conetact

#endif
