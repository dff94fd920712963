// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_contact_body_coordinates_h
#define conetact_contact_body_coordinates_h

#include "conetact/contact/coordinates.h"

namespace conetact::contact
{
  /**
   * Unknowns p of each body by itself: @f$ u = B p @f$ but for what is
   * prescribed. What supports hold and hanging nodes are eliminated. Bodies
   * that are copies of each other have equal matrices @f$ B^T K B @f$. With
   * contact points, whose nodes face obstacles only, unknowns of these nodes
   * are along the directions of the points, those with a cone last.
   */
  class BodyCoordinates : public LinearMap
  {
  public:
    /** `coordinates` without contacts; references must outlive the object. */
    BodyCoordinates(const model::Bodies &bodies,
                    const Coordinates   &coordinates,
                    const ContactPoints *points = nullptr);

    /** First unknown of a body, and one past its last. */
    Eigen::Index
    begin(const std::size_t body) const
    {
      return first_unknown[body];
    }
    Eigen::Index
    end(const std::size_t body) const
    {
      return first_unknown[body + 1];
    }
    /** Nodes of unknowns p, in numbers as Coordinates has them. */
    unsigned int
    node_of(const Eigen::Index p) const
    {
      return unknowns[static_cast<std::size_t>(p)].node;
    }
    /** First unknown of a node, and one past its last. */
    std::pair<Eigen::Index, Eigen::Index>
    unknowns_of(const unsigned int body, const unsigned int node) const
    {
      const std::size_t n = coordinates.number(body, node);
      return {static_cast<Eigen::Index>(first_of_node[n]),
              static_cast<Eigen::Index>(end_of_node[n])};
    }
    /** First unknown of a contact point along its directions. */
    Eigen::Index
    first_of(const ContactPoint &point) const
    {
      return unknowns_of(point.node->body, point.node->node).first +
             static_cast<Eigen::Index>(point.frictionless.size());
    }
    /** p of displacements of all dofs, as far as they have one. */
    Eigen::VectorXd
    values(const Eigen::VectorXd &u) const;

  private:
    /** p = direction . u, of components of u from a dof on. */
    struct Unknown
    {
      unsigned int node;
      Eigen::Index dof;
      unsigned int n_components;
      Tensor<1, 3> direction;
    };

    void
    take(const ContactPoints &points);
    void
    add_node(const unsigned int body, const unsigned int node);
    void
    add_translations(const unsigned int body, const unsigned int node);
    void
    add_rotations(const unsigned int body, const unsigned int node);
    void
    append_row(const unsigned int body,
               const unsigned int node,
               const unsigned int component,
               const double       factor);

    const model::Bodies &bodies;
    const Coordinates   &coordinates;
    /** By numbers of nodes; null: none of the point's directions. */
    std::vector<const ContactPoint *> point_of_node;
    std::vector<Eigen::Index>         first_unknown; ///< of each body
    /** By numbers of nodes. */
    std::vector<std::size_t> first_of_node, end_of_node;
    std::vector<Unknown>     unknowns;
  };
} // namespace conetact::contact

#endif
