// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/contact_nodes.h"

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <tuple>

namespace conetact::pairing
{
  namespace
  {
    /**
     * The point of an obstacle that a node faces, where that stood at the
     * start: x - g n with x = X + moved and g = gap + n . moved, of a node that
     * slides as it was found last.
     */
    Point<3>
    foot_found(const ContactNode &node)
    {
      return node.position + node.moved -
             (node.gap + node.n * node.moved) * node.n;
    }

  } // namespace

  Tensor<1, 3>
  undeformed_distance(const ContactNode                            &node,
                      const std::vector<const bodies::Structure *> &structures)
  {
    Tensor<1, 3> distance;
    // Arms from the node are summed, not positions, whose digits would be lost
    // far from the origin; weights of both sides cancel.
    ContactNode sides = node; // what opens a cut is at no place
    sides.opening.reset();
    for_each_side(
      sides,
      [&](const unsigned int body, const unsigned int i, const double weight) {
        distance += weight * (structures[body]->position(i) - node.position);
      });
    return distance;
  }

  /* A mean over bent faces has a gap of its own: by how much it differs from
     that of its node at the start. */
  double
  gap_beside_own(const ContactNode &node)
  {
    Assert(node.obstacle != nullptr,
           dealii::ExcMessage("Only obstacles have shapes."));
    if (node.slaves.empty())
      return 0;
    return node.gap -
           node.obstacle->shape->closest(node.position, node.spacing).gap;
  }

  std::pair<Tensor<1, 3>, Tensor<1, 3>>
  tangents(const Tensor<1, 3> &n, const unsigned int dim)
  {
    Assert(std::abs(n.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    Tensor<1, 3> e_y, e_z;
    e_y[1] = e_z[2] = 1;
    if (dim == 2)
      return {Tensor<1, 3>({n[1], -n[0], 0.}), e_z};
    Tensor<1, 3> t1 =
      // On a floor n x e_z has no length.
      std::abs(n[2]) > .9 ? cross_product_3d(e_y, n) : cross_product_3d(n, e_z);
    t1 /= t1.norm();
    return {t1, cross_product_3d(n, t1)};
  }

  const std::vector<KindRow> &
  contact_kinds()
  {
    static const std::vector<KindRow> rows = {
      {ContactKind::contact,
       "contact",
       "the sides press each other and open, with friction",
       "mortar"},
      {ContactKind::tie,
       "tie",
       "they are joined, without any relative motion, and may pull",
       "mortar"},
      {ContactKind::bilateral,
       "bilateral",
       "they slide without friction and never lift off",
       "mortar"},
      {ContactKind::spring,
       "spring",
       "two points, with a Stiffness between them; see Point",
       "node to face"}};
    return rows;
  }

  Tensor<1, 3>
  ContactNode::opponent_displacement(const double t) const
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    Tensor<1, 3> d = obstacle_displacement(*this, t);
    if (growth)
      d -= growth(t) * n;
    return d;
  }

  void
  set_frame(ContactNode        &node,
            const Tensor<1, 3> &normal,
            const unsigned int  dim)
  {
    Assert(std::abs(normal.norm() - 1) < 1e-6,
           dealii::ExcMessage("Normals have unit length."));
    const double c             = std::cos(node.friction_angle);
    const double s             = std::sin(node.friction_angle);
    node.n                     = normal;
    std::tie(node.t1, node.t2) = tangents(node.n, dim);
    // Axes of the elliptic cone, [K] remark 3.3: t1 and t2 turned about n.
    node.axis_1 = c * node.t1 + s * node.t2;
    node.axis_2 = c * node.t2 - s * node.t1;
  }

  Tensor<1, 3>
  obstacle_displacement(const ContactNode &node, const double t)
  {
    Assert(std::isfinite(t), dealii::ExcMessage("Times are finite."));
    return node.obstacle != nullptr ?
             node.obstacle->motion_at(t).displacement(foot_found(node)) :
             Tensor<1, 3>();
  }

  bool
  has_nodes_as_masters(const Contact                                &contact,
                       const std::vector<const bodies::Structure *> &structures)
  {
    return contact.obstacle == nullptr && structures[contact.master]
                                            ->surface(contact.master_ids)
                                            .faces.empty();
  }

} // namespace conetact::pairing
