// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_contact_nodes_h
#define conetact_pairing_contact_nodes_h

#include "conetact/base/expression.h"
#include "conetact/bodies/structure.h"
#include "conetact/pairing/bond_law.h"
#include "conetact/pairing/fluid_law.h"
#include "conetact/pairing/friction_law.h"
#include "conetact/pairing/layer_law.h"
#include "conetact/pairing/obstacles.h"
#include "conetact/pairing/spring_law.h"

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace conetact::pairing
{
  /** What holds between the two sides of a contact. */
  enum class ContactKind
  {
    contact,   ///< they touch or not, with friction
    tie,       ///< no relative motion
    bilateral, ///< none along the normal, all of it across
    spring     ///< of two points, along the line through them
  };

  /** What `Kind` in a contact may be; the first one is the default. */
  struct KindRow
  {
    ContactKind kind;
    std::string name, description, pairing; ///< where none is chosen
  };
  const std::vector<KindRow> &
  contact_kinds();

  /** A force that draws the sides of a tie together. */
  struct Preload
  {
    Expression            force;       ///< of t, tension is positive [force]
    Tensor<1, 3>          axis;        ///< unit; 0: the normal of the faces
    std::optional<double> locked_from; ///< time; none: it stays prescribed
  };

  /**
   * Boundary ids of a body that may touch an obstacle or another body, with
   * friction.
   */
  struct Contact
  {
    std::string         name;
    ContactKind         kind = ContactKind::contact;
    unsigned int        body = 0; ///< index
    bodies::BoundaryIds ids;
    const Obstacle     *obstacle = nullptr; ///< none: a master body
    unsigned int        master   = 0;       ///< index of the master body
    bodies::BoundaryIds master_ids;
    double              reach = 0; ///< of the search for master faces [length]
    /** Between a normal of the node and that of the master, reversed [rad]. */
    double largest_angle = M_PI / 3;
    /** Overlap at the start; none: a quarter of a face. [length] */
    std::optional<double>     interference;
    std::optional<Expression> gap;                      ///< prescribed [length]
    std::optional<Preload>    preload;                  ///< of a tie
    std::string               pairing = "node to face"; ///< row of pairings()
    double sharp_edge = 2 * M_PI / 9; ///< of a slave surface [rad]
    bool   slides     = false; ///< far: its nodes are found again and again
    /** Faces of a rigid load: each node by itself, in place of means over faces
     * of second degree at their corners. It has forces, and no pressure. */
    bool couples = false;

    /** None: bound contacts. */
    std::shared_ptr<const FrictionLaw> friction;
    /** Of t: 0 where both sides do not see each other; none: they do. */
    std::shared_ptr<const Expression> active;
    /** What gives way or wears; none. */
    std::shared_ptr<const LayerLaw> layer;
    /** What holds its sides together; none. */
    std::shared_ptr<const BondLaw> bond;
    /** What presses its sides apart; none. */
    std::shared_ptr<const FluidLaw> fluid;
    /** What is between its points, where it is a spring. */
    std::shared_ptr<const SpringLaw> spring;
    double friction_angle = 0; ///< first axis of an ellipse from t1 [rad]
    /** At each node, functions of position [force]; cohesion of a load path
     * only. */
    std::optional<Expression> prestress, path_cohesion;

    /** Whether it is a tie that begins or ends. */
    bool
    may_part() const
    {
      return kind == ContactKind::tie && active;
    }
    /** Whether its reactions may have any sign, as a law and not an equation
     * has it. */
    bool
    is_joined() const
    {
      return may_part() || (spring && spring->acts_both_ways());
    }
  };

  /**
   * A node that may touch, with its frame: normal n from the obstacle to the
   * body; tangents t1 = n x e_z (e_y x n where |n_z| > .9) and t2 = n x t1; in
   * 2D t1 = (n_y, -n_x).
   */
  struct ContactNode
  {
    unsigned int contact = 0; ///< index
    unsigned int body    = 0; ///< index
    unsigned int node    = 0; ///< number in its body
    Point<3>     position;
    Tensor<1, 3> n, t1, t2;
    /** Of its body there, one for each smooth patch; empty: it has no side. */
    std::vector<Tensor<1, 3>> outward;
    double                    area = 0; ///< tributary [length^2]
    double spacing                 = 0; ///< longest edge of its faces [length]
    double gap = 0; ///< undeformed, negative: interference [length]
    /** Of a mean over faces of second degree: the least gap on them. */
    std::optional<double> least_gap;
    const Obstacle       *obstacle = nullptr; ///< none: a pair of bodies
    ContactKind           kind     = ContactKind::contact;
    /** Of those that are bound: whether the gap is closed, or kept. */
    bool closes = false;
    /** Change of a Gap since t = 0; none: it stays [length]. */
    std::function<double(const double t)> growth;

    /** The point that it faces. */
    Point<3>
    foot() const
    {
      return position - gap * n;
    }

    /**
     * What the node meets there is a mean over nodes of the master body, the
     * weights sum to 1: shape functions of the face that it faces, or of all
     * faces around (mortar; some are negative), or its foot on an obstacle
     * that is free and has become a rigid body.
     */
    unsigned int                                 master = 0;
    std::vector<std::pair<unsigned int, double>> masters;
    /** No obstacle, and no master within reach: it may slide to one. */
    bool
    meets_nothing() const
    {
      return obstacle == nullptr && masters.empty();
    }
    /**
     * What it meets that with, where that is not the node alone: a mean over
     * nodes of its own body, the weights sum to 1 (mortar, where neighbours
     * have no contact node of their own).
     */
    std::vector<std::pair<unsigned int, double>> slaves;
    /**
     * The rigid body whose motion opens its tie, a third side: what stands in
     * the way of closing it, and takes part in no balance of the others.
     */
    std::optional<unsigned int> opening;
    /** Whether the nodes of its contact are means over faces (mortar). */
    bool is_mean = false;
    /** Whether it is one of the faces of a rigid load. */
    bool couples = false;
    /**
     * Of the normals of bent faces with its own one, the mean that the node
     * is: of a way along all these normals it sees so much. Of dual functions
     * it is above 1.
     */
    double mean_cosine = 1;

    /** Finite sliding: it is found again where its bodies are. */
    bool slides = false;
    /**
     * The relative displacement at which it was found last: the gap there is
     * `gap` + n . moved. [length]
     */
    Tensor<1, 3> moved;

    /**
     * Principal friction coefficients and their axes in the tangent plane
     * ([K] remark 3.3): |(r_1/mu_1, r_2/mu_2)| <= r_n. Isotropic: equal.
     */
    double mu_1 = 0, mu_2 = 0;
    /** In place of them, where coefficients vary; they are those of the start
     * then, and above 0. */
    std::shared_ptr<const FrictionLaw> friction;
    std::shared_ptr<const LayerLaw>    layer;  ///< or none
    std::shared_ptr<const BondLaw>     bond;   ///< or none
    std::shared_ptr<const FluidLaw>    fluid;  ///< or none
    std::shared_ptr<const SpringLaw>   spring; ///< or none
    std::shared_ptr<const Expression>  active; ///< of the contact; or none
    double       friction_angle = 0;           ///< of axis_1 from t1 [rad]
    Tensor<1, 3> axis_1, axis_2;

    /** Presses the two sides together from the start [force]. */
    double prestress = 0;
    /** Friction that needs no pressure, of a load path: |r_t| <= mu r_n +
     * cohesion [force]. */
    double cohesion = 0;

    /** Tributary area of what it meets: 0 where it meets nothing [length^2]. */
    double
    covered_area() const
    {
      return meets_nothing() ? 0. : area;
    }
    /** What strengths of a bond count for: areas, or forces of single nodes. */
    double
    bonded_area() const
    {
      return outward.empty() && !meets_nothing() ? 1. :
                                                   std::max(covered_area(), 0.);
    }
    /** Where a bond is still whole [length]. */
    double
    least_opening() const
    {
      return 1e-9 * spacing;
    }
    /** Whether both sides see each other at time t. */
    bool
    is_active(const double t) const
    {
      return !active || (*active)(Point<3>(), t) != 0;
    }
    /** Whether an equation holds it to its opponent, whatever the reaction. */
    bool
    is_bound() const
    {
      return kind == ContactKind::bilateral || is_tied();
    }
    /** Whether it is tied at all times, */
    bool
    is_tied() const
    {
      return kind == ContactKind::tie && !active;
    }
    /** or while it is active, and free else. */
    bool
    may_part() const
    {
      return kind == ContactKind::tie && active;
    }
    /** Whether its reaction may have any sign, as a law and not an equation has
     * it. */
    bool
    is_joined() const
    {
      return may_part() || (spring && spring->acts_both_ways());
    }
    /** Of the opponent without any strain: obstacles move, Gaps grow. */
    Tensor<1, 3>
    opponent_displacement(const double t) const;
  };

  /** Calls visit(node, weight) for the nodes of a contact node's own body. */
  template <typename Visit>
  void
  for_each_slave(const ContactNode &node, const Visit &visit)
  {
    if (node.slaves.empty())
      visit(node.node, 1.);
    for (const auto &[slave, weight] : node.slaves)
      visit(slave, weight);
  }

  /** What a contact node's own body does there: of displacements at(node) the
   * mean that it stands for. */
  template <typename DisplacementAt>
  Tensor<1, 3>
  own_displacement(const ContactNode &node, const DisplacementAt &at)
  {
    Tensor<1, 3> mean;
    for_each_slave(node, [&](const unsigned int slave, const double weight) {
      mean += weight * at(slave);
    });
    return mean;
  }

  /** Of its own displacement in this mean. */
  inline double
  own_weight(const ContactNode &node)
  {
    double sum = 0;
    for_each_slave(node, [&](const unsigned int slave, const double weight) {
      sum += slave == node.node ? weight : 0.;
    });
    return sum;
  }

  /**
   * How far the point of an obstacle that a node faces has moved at time t by
   * what is prescribed [length]; nothing for a pair of bodies, to which an
   * obstacle that is free belongs.
   */
  Tensor<1, 3>
  obstacle_displacement(const ContactNode &node, const double t);

  /**
   * Calls visit(body, node, weight) for the nodes of bodies whose motions a
   * contact node sees: @f$v = \sum weight\,u@f$ (less that of an obstacle),
   * and on which its reaction acts, weight by weight. A tie that a force
   * tightens has a third side.
   */
  template <typename Visit>
  void
  for_each_side(const ContactNode &node, const Visit &visit)
  {
    for_each_slave(node, [&](const unsigned int slave, const double weight) {
      visit(node.body, slave, weight);
    });
    for (const auto &[master, weight] : node.masters)
      visit(node.master, master, -weight);
    if (node.opening)
      visit(*node.opening, 0, -1.);
  }

  /** From what a contact node meets on its master to what it meets that with,
   * where the bodies are undeformed [length]. */
  Tensor<1, 3>
  undeformed_distance(const ContactNode                            &node,
                      const std::vector<const bodies::Structure *> &structures);

  /**
   * Whether the master is single nodes, as the end of a frame's member that a
   * body may run against: no face or member of it is in the boundary ids.
   */
  bool
  has_nodes_as_masters(
    const Contact                                &contact,
    const std::vector<const bodies::Structure *> &structures);

  /** Whether `Gap = adjust` in the entries of a contact. */
  bool
  adjusts_gaps(const dealii::ParameterHandler &prm);

  /** Entries of a contact that do not name its sides. */
  void
  declare_contact_law(dealii::ParameterHandler &prm);
  /** On a load path, Cohesion is a force at each node, for ever. */
  void
  take_cohesion_of_path(dealii::ParameterHandler &prm,
                        const std::string        &in,
                        Contact                  &contact);
  /** A contact without sides. `in` is what an error begins with. */
  Contact
  read_contact_law(dealii::ParameterHandler &prm, const std::string &in);

  /** Entries of `subsection Contact NAME`. */
  void
  declare_contact(dealii::ParameterHandler &prm);
  Contact
  create_contact(dealii::ParameterHandler                     &prm,
                 const std::string                            &name,
                 const std::string                            &in,
                 const unsigned int                            dim,
                 const std::vector<std::string>               &bodies,
                 const std::vector<const bodies::Structure *> &structures,
                 const std::vector<Obstacle>                  &obstacles);

  /** Tangents of the convention above. */
  std::pair<Tensor<1, 3>, Tensor<1, 3>>
  tangents(const Tensor<1, 3> &n, const unsigned int dim);

  /** By how much the mean gap of an undeformed node differs from that of its
   * own place, to its obstacle [length]. */
  double
  gap_beside_own(const ContactNode &node);

  /** Sets the normal, the tangents and the axes of friction of a node. */
  void
  set_frame(ContactNode        &node,
            const Tensor<1, 3> &normal,
            const unsigned int  dim);

  /** What a pairing finds for a contact. */
  struct PairedNodes
  {
    std::vector<ContactNode> nodes; ///< `contact` and friction to be set
    unsigned int             n_nodes = 0, n_paired = 0;
    struct Deep
    {
      Point<3> position;
      double   gap, allowed; ///< [length]
    };
    std::optional<Deep> deepest; ///< of those deeper than allowed
  };

  /** A way to find what the nodes of a contact may touch. */
  struct PairingRow
  {
    std::string name, description;
    PairedNodes (*pair)(
      const Contact                                &contact,
      const std::vector<const bodies::Structure *> &structures);
    bool takes_means; ///< over faces; else each node by itself
  };

  /** What `Pairing` in a contact may be; the first one is the default. */
  const std::vector<PairingRow> &
  pairings();

  /**
   * How a contact is paired: as it says, but nodes that meet an obstacle, and
   * surfaces without faces or with two sides, one by one.
   */
  const PairingRow &
  pairing_of(const Contact                                &contact,
             const std::vector<const bodies::Structure *> &structures);

  /** What was found for a contact; gaps of its paired nodes [length]. */
  struct Pairing
  {
    unsigned int n_nodes = 0, n_paired = 0; ///< others stay free
    double       least_gap = 0, largest_gap = 0;
  };

  struct ContactNodes
  {
    std::vector<ContactNode> nodes;
    std::vector<Pairing>     pairings; ///< of each contact
  };

  /**
   * All nodes of all contacts, contact by contact; a node may stand in several.
   * Throws InputError where one starts too deep in its opponent, or friction is
   * negative.
   */
  ContactNodes
  find_contact_nodes(const std::vector<Contact>                   &contacts,
                     const std::vector<std::string>               &bodies,
                     const std::vector<const bodies::Structure *> &structures,
                     const unsigned int                            dim);

  /** Whether a law of a contact, or of a node of it, asks for the temperature
   * of the body. */
  template <class WithLaws>
  bool
  has_law_of_temperature(const WithLaws &of)
  {
    return (of.friction && of.friction->uses_temperature()) ||
           (of.layer && of.layer->uses_temperature()) ||
           (of.bond && of.bond->uses_temperature());
  }
} // namespace conetact::pairing

#endif
