// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_cell_splitting_h
#define conetact_base_cell_splitting_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /** Whether simplices and other cells stand side by side, or wedges, pyramids
   * or cells of which several corners are the same node. */
  bool
  are_mixed(const std::vector<const FileMesh::Element *> &cells);

  /** "6 hexahedra, 2 wedges", also collapsed ones. */
  std::string
  count_of_kinds(const std::vector<const FileMesh::Element *> &cells);

  /**
   * Triangles or tetrahedra in place of elements of any kind, with their groups
   * and without middle nodes, which stay those of the elements: each edge of
   * the pieces is an edge of the element, or a diagonal. Diagonals of
   * quadrilaterals go through the node with the smallest number, so that
   * neighbours fit each other. Throws FileFault where an element is folded, or
   * is a simplex that has a node twice, unless nodes have been joined: nothing
   * is left of such a one then.
   */
  std::vector<FileMesh::Element>
  split_into_simplices(const FileMesh                               &mesh,
                       const std::vector<const FileMesh::Element *> &elements,
                       const bool                                    joined);
} // namespace conetact

#endif
