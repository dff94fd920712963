// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/small_kinematics.h"

#include "conetact/base/text.h"
#include "conetact/bodies/displaced.h"
#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/face_net.h"
#include "conetact/pairing/true_gap.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    /** Over the spacing of nodes: beyond, a foot is on another face. */
    constexpr double farthest_slide = 1;
    /** The same: what is further off does not touch whatever its foot is. */
    constexpr double nearby = .5;
    /** The same: an open node may seem so deep inside its master. */
    constexpr double depth_of_facets = .01;
    /** The same: how far a slip may be off because a node is not at its foot.
     */
    constexpr double largest_false_slip = .01;
    /** Of bodies [rad]: linear motions lengthen them by half of its square. */
    constexpr double largest_turn = .05;
    /** Of normals [rad]: forces are askew by it, friction by some times that.
     */
    constexpr double largest_tilt = .01, largest_tilt_of_friction = .004;

    /** Normal of a face, with its size, from positions of its corners. */
    Tensor<1, 3>
    normal_of(const std::vector<Point<3>> &corners)
    {
      Tensor<1, 3> n;
      if (corners.size() == 2)
        {
          const Tensor<1, 3> along = corners[1] - corners[0];
          n                        = Tensor<1, 3>({along[1], -along[0], 0.});
        }
      else if (corners.size() == 3)
        n = cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
      else
        n = cross_product_3d(corners[3] - corners[0], corners[2] - corners[1]);
      return n / n.norm();
    }

    /** The master sides of contacts, displaced; made when they are asked for.
     */
    class DisplacedMasters
    {
    public:
      DisplacedMasters(const application::Scene    &s,
                       const contact::ContactModel &m,
                       const Eigen::VectorXd       &displacements)
        : scene(s)
        , model(m)
        , u(displacements)
      {}

      /** Negative: inside [length]. Of a node where it is now. */
      double
      distance(const pairing::ContactNode &node, const Point<3> &now)
      {
        const pairing::FaceNet &faces = faces_of(node);
        const auto              foot  = faces.nearest(now);
        return faces.side(foot, now) * foot.distance;
      }

    private:
      const pairing::FaceNet &
      faces_of(const pairing::ContactNode &node)
      {
        const auto found = known.find(node.contact);
        if (found != known.end())
          return found->second;
        const bodies::Structure  &body = *model.bodies.structures[node.master];
        std::vector<Tensor<1, 3>> moved;
        for (unsigned int i = 0; i < body.n_nodes(); ++i)
          moved.push_back(model.displacement(u, node.master, i));
        const bodies::Displaced now(body, std::move(moved));
        return known
          .emplace(node.contact,
                   pairing::FaceNet(
                     now, now.surface(scene.contacts[node.contact].master_ids)))
          .first->second;
      }

      const application::Scene                &scene;
      const contact::ContactModel             &model;
      const Eigen::VectorXd                   &u;
      std::map<unsigned int, pairing::FaceNet> known; // by contact
    };
  } // namespace

  SmallKinematics::SmallKinematics(const application::Scene    &s,
                                   const contact::ContactModel &m)
    : scene(s)
    , model(m)
    , facets(s, m)
  {
    for (unsigned int c = 0; c < scene.contact_names.size(); ++c)
      {
        const pairing::Contact &contact = scene.contacts[c];
        if (contact.slides || contact.obstacle != nullptr ||
            !scene.kinematics[c].may_tilt())
          continue;
        const bodies::Structure &body = *model.bodies.structures[contact.body];
        for (const bodies::SurfaceFace &face : body.surface(contact.ids).faces)
          {
            std::vector<unsigned int> corners(
              face.nodes.begin(),
              face.nodes.begin() +
                static_cast<std::ptrdiff_t>(bodies::n_corners(body, face)));
            for (const unsigned int i : face.nodes)
              faces_at[{c, i}].push_back(corners);
          }
      }
  }

  SmallKinematics::Found
  SmallKinematics::left(const IncrementEnd &end) const
  {
    Found found;
    add_wrong_gaps(end, found);
    add_wrong_feet(end, found);
    add_wrong_turns(end, found);
    add_turned_springs(end, found);
    add_rolled(end, found);
    add_beside_sliding(end, found);
    return found;
  }

  void
  SmallKinematics::add_wrong_gaps(const IncrementEnd &end, Found &found) const
  {
    std::map<unsigned int, std::vector<pairing::MovedNode>> moved; // contacts
    double                                                  indentation = 0;
    const auto at = [&](const Eigen::VectorXd      &x,
                        const pairing::ContactNode &node) {
      return pairing::own_displacement(node, [&](const unsigned int i) {
        return model.displacement(x, node.body, i);
      });
    };
    const contact::ContactPoints &points = model.points;
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const contact::ContactPoint &point = points.all()[i];
        const pairing::ContactNode  &node  = *point.node;
        const bool open = i < points.size() && end.increment.state.node[i] ==
                                                 solvers::NodeState::open;
        // A node that is tied to an obstacle goes with it, wherever that goes.
        // A mean that slides is found anew over all of its faces.
        if (node.obstacle == nullptr || node.spring ||
            node.kind == pairing::ContactKind::tie ||
            (node.slides && !node.slaves.empty()))
          continue;
        // A closed node claims a gap of zero, but for what gives way.
        moved[node.contact].push_back(
          {&node,
           at(*end.finding.u, node),
           obstacle_motion(node, end.amounts, end.increment.record.time),
           open || node.is_bound() || node.layer || node.active ?
             node.gap + end.finding.displacements[point.normal()] :
             0.});
        if (!open)
          // Only what deforms counts: a body that is carried along is not
          // indented.
          indentation =
            std::max(indentation,
                     std::abs(
                       model.bodies.in_space(node.body, at(end.w, node)) *
                       node.n));
      }
    for (const auto &[contact, nodes] : moved)
      if (const auto worst = pairing::worst_gap_error(nodes, indentation))
        found.emplace(contact, Left{pairing::to_sentence(*worst)});
  }

  /** Prescribed, or found with that of the bodies. */
  pairing::RigidMotion
  SmallKinematics::obstacle_motion(const pairing::ContactNode &node,
                                   const Eigen::VectorXd      &amounts,
                                   const double                t) const
  {
    if (node.masters.empty())
      return node.obstacle->motion_at(t);
    return pairing::RigidMotion::turned(
      model.motions.at(amounts, node.master, 0),
      model.motions.turn(amounts, node.master),
      node.obstacle->reference);
  }

  void
  SmallKinematics::add_wrong_feet(const IncrementEnd &end, Found &found) const
  {
    const contact::ContactPoints &points = model.points;
    const auto at = [&](const unsigned int body, const unsigned int i) {
      return model.displacement(*end.finding.u, body, i);
    };
    DisplacedMasters masters(scene, model, *end.finding.u);
    // What has no force does no harm until it is inside the master.
    const auto stays_open = [&](const std::size_t i) {
      const pairing::ContactNode &node = *points.all()[i].node;
      return i < points.size() &&
             end.increment.state.node[i] == solvers::NodeState::open &&
             masters.distance(node, node.position + at(node.body, node.node)) >
               -depth_of_facets * node.spacing;
    };
    for (std::size_t i = 0; i < points.all().size(); ++i)
      {
        const contact::ContactPoint &point = points.all()[i];
        const pairing::ContactNode  &node  = *point.node;
        const double                 gap =
          node.is_bound() ? 0. : end.increment.state.v[point.normal()];
        // The weights of the masters belong to the foot at the start.
        // What an obstacle's shape does beside the foot add_wrong_gaps() knows.
        if (node.masters.empty() || node.obstacle != nullptr || node.spring ||
            node.slides || gap > nearby * node.spacing)
          continue;
        Tensor<1, 3> slid =
          contact::relative_displacement(node, at, end.increment.record.time);
        // Opening does not move the foot, sliding does.
        slid -= (slid * node.n) * node.n;
        constexpr double far = 10; // cells: what holds bodies lets go of them
        const bool       is_let_go = slid.norm() > far * node.spacing;
        if (node.spacing > 0 && slid.norm() > farthest_slide * node.spacing &&
            found.count(node.contact) == 0 && !stays_open(i))
          found.emplace(node.contact,
                        Left{"the contact node at " + to_text(node.position) +
                               " of " + model.bodies.called(node.body) +
                               " has slid by " + to_text(slid.norm()) +
                               " along its master, more than a cell (" +
                               to_text(node.spacing) + ")" +
                               (is_let_go ?
                                  ", as where loads are beyond what friction "
                                  "can hold" :
                                  ""),
                             is_let_go});
      }
  }

  void
  SmallKinematics::add_turned_springs(const IncrementEnd &end,
                                      Found              &found) const
  {
    const auto at = [&](const unsigned int body, const unsigned int i) {
      return model.displacement(*end.finding.u, body, i);
    };
    for (const contact::ContactPoint &point : model.points)
      if (const pairing::ContactNode &node = *point.node; node.spring)
        {
          const Tensor<1, 3> moved =
            contact::relative_displacement(node, at, end.increment.record.time);
          const double across = (moved - (moved * node.n) * node.n).norm();
          const double length =
            node.spring->point().distance(node.spring->end());
          if (across > largest_turn * length && length > 0)
            found.emplace(node.contact,
                          Left{"the spring at " + to_text(node.position) +
                               " turns by " +
                               to_text(std::atan2(across, length)) +
                               " rad, and pulls or pushes along its undeformed "
                               "direction"});
        }
  }

  /* Friction acts between a node and its foot, which are apart before they
     touch: bodies that turn together slip there although nothing slides. */
  void
  SmallKinematics::add_wrong_turns(const IncrementEnd &end, Found &found) const
  {
    for (std::size_t i = 0; i < model.points.all().size(); ++i)
      {
        const pairing::ContactNode &node = *model.points.all()[i].node;
        const bool                  acts =
          i < model.points.size() ?
                             node.mu_1 + node.mu_2 > 0 &&
              end.increment.state.node[i] != solvers::NodeState::open :
                             node.kind == pairing::ContactKind::tie;
        if (node.masters.empty() || node.slides || !acts)
          continue;
        const Tensor<1, 3> apart =
          pairing::undeformed_distance(node, model.bodies.structures);
        const double turn = model.motions.rotation(end.amounts, node.master);
        if (turn * apart.norm() > largest_false_slip * node.spacing)
          found.emplace(node.contact,
                        Left{model.bodies.called(node.master) + " turns by " +
                             to_text(turn) + " rad, and the contact node at " +
                             to_text(node.position) + " of " +
                             model.bodies.called(node.body) + " was " +
                             to_text(apart.norm()) +
                             " away from it, so that the slip there is off "
                             "by " +
                             to_text(turn * apart.norm())});
      }
  }

  std::vector<unsigned int>
  SmallKinematics::contacts_of(const unsigned int body) const
  {
    std::vector<unsigned int> found;
    for (unsigned int c = 0; c < scene.contact_names.size(); ++c)
      if (const pairing::Contact &contact = scene.contacts[c];
          (contact.kind != pairing::ContactKind::tie || contact.may_part()) &&
          (contact.body == body ||
           (contact.obstacle == nullptr && contact.master == body)))
        found.push_back(c);
    return found;
  }

  std::vector<SmallKinematics::Turned>
  SmallKinematics::turned(const Eigen::VectorXd &amounts) const
  {
    AssertDimension(amounts.size(),
                    model.motions
                      .of_free(Eigen::VectorXd::Zero(model.motions.n_free()))
                      .size());
    std::vector<Turned> found;
    for (unsigned int b = 0; b < model.bodies.n_elastic(); ++b)
      {
        const double angle = model.motions.rotation(amounts, b);
        if (!(angle > largest_turn) || model.frames.has(b))
          continue;
        Turned turned{model.bodies.called(b) + " turns by " + to_text(angle) +
                        " rad",
                      angle,
                      {},
                      false,
                      // elements that turn have no frame
                      model.bodies.structures[b]->n_components() <=
                        model.bodies.dim};
        for (const unsigned int c : contacts_of(b))
          {
            const pairing::ContactKinematics &of     = scene.kinematics[c];
            const bool                        slides = scene.contacts[c].slides;
            if (!slides)
              turned.small.push_back(c);
            turned.is_automatic |= of.asked == pairing::Kinematics::automatic;
            turned.could_turn &= slides || of.may_slide();
          }
        turned.could_turn &= !turned.small.empty();
        found.push_back(std::move(turned));
      }
    return found;
  }

  Tensor<1, 3>
  SmallKinematics::turn_of_normal(const pairing::ContactNode &node,
                                  const IncrementEnd         &end) const
  {
    Tensor<1, 3> change;
    if (node.spring)
      return change;
    if (node.obstacle != nullptr)
      {
        const auto motion =
          obstacle_motion(node, end.amounts, end.increment.record.time);
        const Tensor<1, 3> own = motion.relative(
          node.position,
          model.displacement(*end.finding.u, node.body, node.node));
        if (const auto there =
              node.obstacle->shape->closest_if_any(node.position + own,
                                                   node.spacing))
          change = motion.direction_to_space(there->normal) - node.n;
        return change;
      }
    const auto faces = faces_at.find({node.contact, node.node});
    if (faces == faces_at.end())
      return change;
    const bodies::Structure &body = *model.bodies.structures[node.body];
    for (const std::vector<unsigned int> &corners : faces->second)
      {
        std::vector<Point<3>> then, now;
        for (const unsigned int i : corners)
          {
            then.push_back(body.position(i));
            now.push_back(then.back() +
                          model.displacement(*end.finding.u, node.body, i));
          }
        change += (normal_of(now) - normal_of(then)) /
                  static_cast<double>(faces->second.size());
      }
    return change;
  }

  std::optional<std::pair<unsigned int, std::string>>
  SmallKinematics::tilted(const IncrementEnd &end) const
  {
    const auto                    &points = model.points;
    std::map<unsigned int, double> largest; // force of a contact
    const auto force_of = [&](const contact::ContactPoint &point) {
      return contact::force_of(point, end.increment.state.r).norm();
    };
    for (const contact::ContactPoint &point : points)
      if (!point.node->slides &&
          scene.kinematics[point.node->contact].may_tilt())
        {
          double &most = largest[point.node->contact];
          most         = std::max(most, force_of(point));
        }
    for (const contact::ContactPoint &point : points)
      {
        const pairing::ContactNode &node  = *point.node;
        const auto                  found = largest.find(node.contact);
        if (found == largest.end() || !(found->second > 0))
          continue;
        const double tilt =
          std::max(turn_of_normal(node, end).norm(),
                   node.obstacle != nullptr ? rolled(node, end) : 0.);
        if (tilt * force_of(point) > (node.mu_1 + node.mu_2 > 0 ?
                                        largest_tilt_of_friction :
                                        largest_tilt) *
                                       found->second)
          return std::make_pair(node.contact,
                                "the contact normal at " +
                                  to_text(node.position) + " of " +
                                  model.bodies.called(node.body) +
                                  " has turned by " + to_text(tilt) + " rad");
      }
    return {};
  }
} // namespace conetact::analysis
