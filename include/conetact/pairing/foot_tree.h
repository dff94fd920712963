// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_foot_tree_h
#define conetact_pairing_foot_tree_h

#include "conetact/pairing/face_net.h"

#include <vector>

namespace conetact::pairing
{
  /**
   * Clusters of faces with the cones of their normals, so that the faces which
   * may have a foot of a point, however far away, are found without looking at
   * all of them: most faces look elsewhere.
   */
  class FootTree
  {
  public:
    explicit FootTree(const FaceNet &net);

    /** Numbers of all faces of the net, which must be that of the constructor,
     * that may have a foot of p, sorted. */
    std::vector<std::size_t>
    faces_with_foot(const FaceNet &net, const Point<3> &p) const;

  private:
    struct Cluster
    {
      std::size_t  begin = 0, end = 0; ///< of `order`
      std::size_t  first = 0; ///< of two parts, one behind the other; 0: none
      Point<3>     centre;
      double       spread = 0; ///< of centres of faces about it [length]
      Tensor<1, 3> axis;
      double       angle  = 0; ///< of normals from the axis [rad]
      double       beside = 0; ///< how far p may stand beside a normal [length]
      double       turn   = 0; ///< and how much more, over its distance
    };
    void
    measure(const FaceNet &net, Cluster &cluster) const;
    std::size_t
    part(const FaceNet &net, const Cluster &cluster);
    void
    split(const FaceNet &net, const std::size_t number);

    static bool
    may_have_foot(const Cluster &cluster, const Point<3> &p);

    std::vector<std::size_t> order;  ///< of faces in clusters
    std::vector<std::size_t> single; ///< faces that are asked one by one
    std::vector<Cluster>     clusters;
    bool                     has_lines = false; ///< and no other faces
  };
} // namespace conetact::pairing

#endif
