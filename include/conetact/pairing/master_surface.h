// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_master_surface_h
#define conetact_pairing_master_surface_h

#include "conetact/pairing/face_net.h"
#include "conetact/pairing/foot_tree.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /**
   * The faces of a body that nodes of another one may touch: node to segment
   * in the plane, node to bilinear face in space. Linearised at the undeformed
   * bodies. A node is paired with the nearest feature (face, edge, vertex)
   * whose normal opposes its own; it stays free beside the rim of the surface,
   * and behind the surface unless it is inside the body.
   */
  class MasterSurface
  {
  public:
    /** What may be paired. */
    struct Limits
    {
      double reach;        ///< largest distance [length]
      double cosine;       ///< of the largest angle between opposing normals
      double interference; ///< through a surface without inside [length]
      bool   inside;       ///< whether a node may be inside the body at all
    };

    MasterSurface(const bodies::Structure   &body,
                  const bodies::BoundaryIds &ids);

    const FaceNet &
    net() const
    {
      return faces;
    }

    /**
     * Whether a point may meet a face although it is behind it: inside the
     * body, or beside an interference that ends at its side. Chords tell that:
     * behind a bent face all is inside that is less behind than its sagitta.
     * `size`: of the face or of that of the point, whichever is larger.
     */
    bool
    may_be_behind(const Point<3>      &p,
                  const double         gap,
                  const FaceNet::Face &face,
                  const double         size,
                  const Limits        &limits) const;

    struct Foot
    {
      double       gap;    ///< negative: interference [length]
      Tensor<1, 3> normal; ///< unit, from the master to the slave node
      double       size;   ///< longest edge of the face [length]
      /** Nodes of the face that is met, with its shape functions. */
      std::vector<std::pair<unsigned int, double>> masters;
    };
    /**
     * The nearest admissible foot of a perpendicular from p, a node whose
     * faces have these outward normals; none if p is to stay free. A foot on
     * an edge or a vertex takes the direction to p as normal.
     */
    std::optional<Foot>
    foot(const Point<3>                  &p,
         const std::vector<Tensor<1, 3>> &slave_normals,
         const Limits                    &limits) const;

  private:
    using Feature = std::vector<FaceNet::Closest>;
    struct Meeting
    {
      double       gap;
      Tensor<1, 3> normal;
    };
    Foot
    foot_on(const FaceNet::Face         &face,
            const Point<3>              &p,
            const Meeting               &meeting,
            const std::array<double, 2> &at) const;
    std::optional<Foot>
    nearest_foot(const Point<3>                  &p,
                 const std::vector<Tensor<1, 3>> &slave_normals,
                 const Limits                    &limits,
                 const std::vector<std::size_t>  &among) const;
    std::optional<Tensor<1, 3>>
    arm_over(const Feature &feature, const Tensor<1, 3> &arm) const;
    std::optional<Meeting>
    meet_face(const Feature                   &feature,
              const Tensor<1, 3>              &arm,
              const std::vector<Tensor<1, 3>> &slave_normals,
              const Limits                    &limits) const;
    std::optional<Meeting>
    meet_edge(const Feature                   &feature,
              const Tensor<1, 3>              &arm,
              const std::vector<Tensor<1, 3>> &slave_normals,
              const Limits                    &limits) const;
    std::optional<Meeting>
                             meet(Feature                          feature,
                                  const Point<3>                  &p,
                                  const std::vector<Tensor<1, 3>> &slave_normals,
                                  const Limits                    &limits) const;
    FaceNet                  faces;
    FootTree                 feet;
    double                   typical_size = 0; ///< mean [length]
    std::unique_ptr<FaceNet> whole; ///< boundary; none: the surface has no side
  };
} // namespace conetact::pairing

#endif
