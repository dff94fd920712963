// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_passages_h
#define conetact_pairing_passages_h

#include "conetact/bodies/structure.h"
#include "conetact/pairing/body_way.h"
#include "conetact/pairing/face_tree.h"

#include <optional>
#include <vector>

namespace conetact::pairing
{
  /** A way of a node into a body and perhaps out of it. */
  struct Passage
  {
    Tensor<1, 3> entered; ///< outward normal of the face, as it is at the end
    Tensor<1, 3> left;    ///< the same where it came out; 0: it did not
    double depth; ///< the largest, or if it is inside that at the end [length]
    double size;  ///< longest edge of the face that was entered
    /** If it is inside at the end: of the body there, across that face; of a
     * body much thicker than deep, any such number. */
    double thickness = 0;

    bool
    is_out() const
    {
      return left.norm_square() > 0;
    }
  };

  /**
   * The boundary of a body on its way, which nodes of other bodies go through.
   * Both ways are looked at in few places, straight lines between them.
   */
  class MovingBoundary
  {
  public:
    /** Of what enters elsewhere than at these ids nothing is told. */
    MovingBoundary(const bodies::Structure   &body,
                   const BodyWay             &way,
                   const bodies::BoundaryIds &entries);

    /**
     * Of a node of another body, one after the other. `inside_by`: the number
     * of the face by which it came to where it is inside, at the start and then
     * at the end; none: it is outside, or nobody knows.
     */
    std::vector<Passage>
    passages(const BodyWay               &way,
             const unsigned int           node,
             std::optional<unsigned int> &inside_by) const;

  private:
    static constexpr unsigned int n_places = 9; ///< with both ends

    struct Face
    {
      std::vector<unsigned int> corners;
      double                    side; ///< 1 or -1: of the corners' normal
      double                    size;
      bool                      may_be_entered;
    };
    /** Where a node goes through a face: inwards or outwards. */
    struct Crossing
    {
      double       when; ///< in places
      unsigned int face;
      bool         is_inwards;
    };
    using Places = std::vector<Point<3>>; ///< relative to the body's middle

    /** Of the way, from 0 to 1. */
    static double
    part(const unsigned int place);
    Places
    places_of(const BodyWay &way, const unsigned int node) const;
    void
    add_face(const bodies::Structure   &body,
             const bodies::SurfaceFace &from,
             const bool                 may_be_entered);
    std::vector<Point<3>>
    corners_of(const Face &face, const double when) const;
    Tensor<1, 3>
    normal_of(const Face &face, const double when) const;
    double
    height(const Face &face, const Places &node, const double when) const;
    bool
    is_inside(const Face &face, const Places &node, const double when) const;
    double
    time_of_crossing(const Face        &face,
                     const Places      &node,
                     const unsigned int k,
                     const double       height_before,
                     const double       height_now) const;
    void
    find_crossings(const unsigned int     face,
                   const Places          &node,
                   std::vector<Crossing> &crossings) const;
    bool
    slides_along(const Places &node, const double from, const double to) const;
    unsigned int
    nearest_entry(const Places &node) const;
    Passage
    passage_from_inside(const unsigned int entry, const Crossing &out) const;
    double
    thickness_at_end(const Passage &passage, const Point<3> &p) const;
    double
    depth_at_end(double depth, const Point<3> &p) const;
    Passage
    passage(const Crossing &in, const Crossing *out, const Places &node) const;

    std::vector<Face>         faces;
    std::vector<Places>       places; ///< of each node of the boundary
    std::vector<Tensor<1, 3>> middle; ///< of the body, in each place
    FaceTree                  tree;
  };
} // namespace conetact::pairing

#endif
