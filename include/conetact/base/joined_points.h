// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_joined_points_h
#define conetact_base_joined_points_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /**
   * Makes one point of points that lie at one place: nearer to each other than
   * this part of the size of the smallest cell, by its longest edge. Says how
   * many points fell away.
   */
  std::size_t
  join_points(FileMesh &mesh, const double part);
} // namespace conetact

#endif
