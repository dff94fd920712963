// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_overlap_h
#define conetact_pairing_overlap_h

#include "conetact/bodies/structure.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace conetact::pairing
{
  /** A node of one body that is inside of another one. */
  struct Overlap
  {
    Point<3> position;
    double   depth = 0; ///< to the nearest face [length]
    double   edge  = 0; ///< longest of that face [length]
  };

  /**
   * The boundary of a body by its nodes, wherever these stand. Bodies without
   * an inside, which are frames, have no faces. Planes of symmetry and other
   * sides count as faces.
   */
  struct Boundary
  {
    explicit Boundary(const bodies::Structure &body);
    /** Segments, whose third node is the second one, or triangles. */
    using Face = std::array<unsigned int, 3>;
    std::vector<unsigned int> nodes;
    std::vector<Face>         faces;
    bool                      are_segments = false;
  };

  /** What is inside of a body where it stands. */
  class Solid
  {
  public:
    /** Both must outlive the object. */
    Solid(const Boundary &boundary, const bodies::Structure &body);

    /** The node of `other` that is deepest inside; none: there is none. */
    std::optional<Overlap>
    deepest_inside(const Solid &other) const;

  private:
    struct Tree;
    std::vector<Point<3>>
    corners(const std::size_t face) const;
    bool
    has_inside(const Point<3> &p, const Tree &tree) const;
    Overlap
    overlap_at(const Point<3> &p, const Tree &tree) const;
    const Tree &
    tree_of_faces() const;

    const Boundary                     &boundary;
    const bodies::Structure            &body;
    mutable std::shared_ptr<const Tree> tree; ///< once it is asked for
  };
} // namespace conetact::pairing

#endif
