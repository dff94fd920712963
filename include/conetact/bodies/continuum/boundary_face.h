// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_boundary_face_h
#define conetact_bodies_continuum_boundary_face_h

#include <vector>

namespace conetact::bodies
{
  /** A face of a body's boundary. */
  struct BoundaryFace
  {
    unsigned int              id;      ///< boundary id
    unsigned int              active;  ///< index of its cell
    unsigned int              number;  ///< in the cell
    std::vector<unsigned int> nodes;   ///< in deal.II's order of faces
    std::vector<unsigned int> in_cell; ///< their places among the cell's
  };
} // namespace conetact::bodies

#endif
