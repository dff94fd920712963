// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/contact_notices.h"

#include "conetact/base/joined_warnings.h"
#include "conetact/base/text.h"
#include "conetact/bodies/face_nodes.h"
#include "conetact/pairing/adjusted_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace conetact::analysis
{
  namespace
  {
    using pairing::Contact;
    using pairing::ContactNode;

    /** Facets that stand off by more, in parts of a gap, change pressures. */
    constexpr double large_facet = .1;
    /** Over the spacing of nodes: coordinates of files have as many digits. */
    constexpr double digits = 1e-6;
    /** Nodes of faces of second degree that are no corners, at least. */
    constexpr double of_middles = .3;
    /** Cosine of the angle that normals spread by where surfaces conform. */
    constexpr double conforming = .94;

    bool
    has_second_degree(const bodies::Structure   &body,
                      const bodies::BoundaryIds &ids)
    {
      const auto faces = body.surface(ids).faces;
      return !faces.empty() && bodies::is_of_second_degree(body, faces[0]);
    }

    std::string
    other_side(const Contact &contact, const std::vector<std::string> &names)
    {
      return contact.obstacle != nullptr ?
               "obstacle '" + contact.obstacle->name + "'" :
               "body '" + names[contact.master] + "'";
    }

    /** What a part of the values exceed at most: not what a few nodes have, as
     * where a plane face ends at a fillet. */
    double
    exceeded_by(const double part, std::vector<double> values)
    {
      const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(
                           (1 - part) * static_cast<double>(values.size()));
      std::nth_element(values.begin(), place, values.end());
      return *place;
    }

    /**
     * What closes the gaps of nodes that touch: the interference; the largest
     * gap, where normals differ so much that no motion of one body closes it
     * everywhere; else the differences of gaps, for bodies may come as near as
     * they like.
     */
    double
    closed_gap(const std::vector<double>       &gaps,
               const std::vector<Tensor<1, 3>> &normals)
    {
      const auto [least, largest] =
        std::minmax_element(gaps.begin(), gaps.end());
      Tensor<1, 3> sum;
      for (const Tensor<1, 3> &n : normals)
        sum += n;
      const bool is_flat =
        std::all_of(normals.begin(), normals.end(), [&](const auto &n) {
          return n * sum > conforming * sum.norm();
        });
      return std::max(-*least, is_flat ? *largest - *least : *largest);
    }
  } // namespace

  ContactNotices::ContactNotices(const application::Scene    &s,
                                 const contact::ContactModel &m)
    : scene(s)
    , model(m)
    , contacts(s.sliding_contacts())
    , has_closed(scene.contact_names.size(), false)
    , least_gaps(scene.contact_names.size(), 0.)
    , ways_of_wear(scene)
    , facet_moments(scene)
  {
    for (unsigned int c = 0; c < scene.contact_names.size(); ++c)
      {
        const Contact &contact = contacts.contact(c);
        facets.emplace_back(contact, scene.bodies.structures);
        const auto &structures = scene.bodies.structures;
        if (contact.kind == pairing::ContactKind::contact)
          patterns.try_emplace(c, *structures[contact.body], contact.ids);
        second_degree.push_back(
          has_second_degree(*structures[contact.body], contact.ids) ||
          (contact.obstacle == nullptr &&
           has_second_degree(*structures[contact.master], contact.master_ids)));
      }
    find_what_could_press();
  }

  /* What supports hold has given its share to the nodes beside it. */
  void
  ContactNotices::find_what_could_press()
  {
    for (const auto &[c, pattern] : patterns)
      {
        if (contacts.contact(c).obstacle != nullptr)
          continue; // those have no faces of their own
        std::set<unsigned int> &nodes = could_press[c];
        for (const ContactNode &node : scene.bodies.contact_nodes)
          if (node.contact == c && !node.meets_nothing())
            nodes.insert(node.node);
        for (const bodies::Support &support : scene.bodies.supports)
          if (support.body == contacts.contact(c).body && !support.stiffness)
            for (const bodies::SurfaceNode &node : support.surface.nodes)
              nodes.insert(node.node);
      }
  }

  void
  ContactNotices::say_start(Log &log) const
  {
    std::vector<std::string> warned;
    for (unsigned int c = 0; c < facets.size(); ++c)
      {
        const double one   = facets[c].largest_of_slave();
        const double other = facets[c].largest_of_master();
        if (std::max(one, other) > 0)
          log.note("Contact " + scene.contact_names[c] +
                   ": facets stand off curved surfaces by up to " +
                   to_text(one) + " on the body and " + to_text(other) +
                   " on the other side");
        for (const std::string &sentence : {interference(c, log), hinge(c)})
          if (!sentence.empty())
            warned.push_back(sentence);
      }
    warn(warned, log);
  }

  /* Of two polygons that may not part one does not turn in the other. */
  std::string
  ContactNotices::hinge(const unsigned int c) const
  {
    const double off =
      std::max(facets[c].largest_of_slave(), facets[c].largest_of_master());
    if (contacts.contact(c).kind != pairing::ContactKind::bilateral || off == 0)
      return "";
    return "contact '" + contacts.contact(c).name +
           "': facets stand off its curved surfaces by up to " + to_text(off) +
           ", and sides that may not part do not slide freely on facets: a "
           "joint passes a moment about its own axis. Use bent cells of second "
           "degree (Order = 2 of a drawing), or smaller cells until results "
           "stay the same.";
  }

  std::string
  ContactNotices::interference(const unsigned int c, Log &log) const
  {
    const Contact &contact = contacts.contact(c);
    if (contact.kind != pairing::ContactKind::contact || contact.gap ||
        (contact.obstacle && contact.obstacle->shape->states_gaps()))
      return "";
    unsigned int       n       = 0;
    const ContactNode *deepest = nullptr;
    for (const ContactNode &node : scene.bodies.contact_nodes)
      if (node.contact == c && !node.meets_nothing() &&
          pairing::gap_at_start(node) <
            -pairing::facet_margin * facets[c].allowance(node) -
              digits * node.spacing)
        {
          ++n;
          if (deepest == nullptr || node.gap < deepest->gap)
            deepest = &node;
        }
    if (deepest == nullptr)
      return "";
    const std::string depth = to_text(-deepest->gap);
    const std::string what  = "nodes of contact '" + contact.name +
                             "' start up to " + depth + " inside " +
                             other_side(contact, scene.bodies.names) + " (" +
                             std::to_string(n) + " of them, the deepest at " +
                             to_text(deepest->position) + ")";
    if (contact.interference)
      {
        log.say(what + ", an interference that Largest interference = " +
                to_text(*contact.interference) + " lets pass");
        return "";
      }
    return what +
           ": that is taken for an interference, which presses without any "
           "load. Move them apart, or, where it is meant, say so by a "
           "Largest interference of at least " +
           depth + ".";
  }

  void
  ContactNotices::see(const model::IncrementRecord &record)
  {
    constexpr double    rounding = 1e-9; // of the largest force; of a cell
    const auto         &points   = model.points.all();
    const auto         &start    = scene.bodies.contact_nodes;
    std::vector<double> largest(facets.size(), 0.);
    const auto         &rows = record.rows;
    const std::size_t   n    = std::min(points.size(), rows.size());
    for (std::size_t i = 0; i < n; ++i)
      largest[rows[i].contact] =
        std::max(largest[rows[i].contact], rows[i].reaction[0]);
    std::vector<Closed> closed(facets.size());
    least_gaps.assign(facets.size(), std::numeric_limits<double>::max());
    for (std::size_t i = 0; i < n; ++i)
      {
        const unsigned int c = rows[i].contact;
        least_gaps[c]        = std::min(least_gaps[c], rows[i].gap);
        if (rows[i].gap <= rounding * points[i].node->spacing ||
            rows[i].bonded || rows[i].reaction[0] < 0)
          has_closed[c] = true; // with or without force
        if (rows[i].reaction[0] <= rounding * largest[c])
          continue;
        has_closed[c]           = true;
        const ContactNode &node = start[static_cast<std::size_t>(
          points[i].node - model.points.nodes().data())];
        closed[c].gaps.push_back(pairing::gap_at_start(node));
        const double facet = facets[c].in_gap(node);
        closed[c].facets.push_back(facet > digits * node.spacing ? facet : 0);
        closed[c].normals.push_back(node.n);
        closed[c].pressures[node.node] =
          rows[i].reaction[0] / (rows[i].area > 0 ? rows[i].area : 1.);
      }
    ways_of_wear.see(model.points, rows);
    facet_moments.see(model.points, rows);
    of_facets.clear();
    sentences.clear();
    for (unsigned int c = 0; c < closed.size(); ++c)
      if (!closed[c].gaps.empty())
        {
          judge_facets(c, closed[c]);
          judge_lonely(c, closed[c]);
          judge_thin(c, closed[c]);
        }
  }

  std::string
  ContactNotices::uneven(const unsigned int c, const Closed &closed) const
  {
    const double some = model.bodies.dim == 2 ? .05 : .1; // of those that press
    constexpr std::size_t few     = 6; // nodes have no pattern
    const auto            pattern = patterns.find(c);
    if (pattern == patterns.end() || contacts.contact(c).obstacle != nullptr)
      return "";
    const unsigned int n        = pattern->second.n_pits(closed.pressures);
    const std::size_t  n_closed = closed.pressures.size();
    if (n < 2 || n_closed < few || n < some * static_cast<double>(n_closed))
      return "";
    return "pressures go up and down from node to node (" + std::to_string(n) +
           " nodes in pits, " + std::to_string(n_closed) +
           " that press), as where small cells meet the straight faces of "
           "larger ones. Exchange the sides where the other one has larger "
           "cells, or use smaller cells.";
  }

  /* The geometry of faces, not of bodies: chords of cells of different lengths
     are apart where bodies bend, and beside a support that takes force. */
  void
  ContactNotices::judge_lonely(const unsigned int c, const Closed &closed)
  {
    constexpr double large   = .1; // of the largest pressure
    const auto       pattern = patterns.find(c);
    if (contacts.contact(c).obstacle != nullptr || pattern == patterns.end() ||
        sentences.count(c) > 0 || closed.pressures.size() < 2)
      return;
    const unsigned int body = contacts.contact(c).body;
    double             most = 0;
    for (const auto &[node, pressure] : closed.pressures)
      most = std::max(most, pressure);
    for (const unsigned int node :
         pattern->second.lonely(closed.pressures, could_press.at(c)))
      if (closed.pressures.at(node) > large * most)
        {
          sentences[c] =
            "contact '" + contacts.contact(c).name + "': the node at " +
            to_text(scene.bodies.structures[body]->position(node)) +
            " of body '" + scene.bodies.names[body] +
            "' presses alone, as where bodies bend and their faces, which "
            "stay straight, do not match: what it carries may be due to "
            "the mesh. Use matching meshes or smaller cells, or exchange the "
            "sides.";
          of_facets.insert(c);
          return;
        }
  }

  bool
  ContactNotices::is_curved(const unsigned int c) const
  {
    constexpr double    parallel = 1 - 1e-5; // cosine of a quarter degree
    const Tensor<1, 3> *first    = nullptr;
    for (const ContactNode &node : scene.bodies.contact_nodes)
      if (node.contact == c && !node.meets_nothing())
        {
          if (first != nullptr && node.n * *first < parallel)
            return true;
          first = first == nullptr ? &node.n : first;
        }
    return facets[c].largest_of_slave() > 0 ||
           facets[c].largest_of_master() > 0 || patterns.at(c).is_bent();
  }

  void
  ContactNotices::judge_thin(const unsigned int c, const Closed &closed)
  {
    const auto pattern = patterns.find(c);
    if (pattern == patterns.end() || sentences.count(c) > 0 ||
        !pattern->second.is_thin(closed.pressures) || !is_curved(c))
      return;
    const std::size_t n = closed.pressures.size();
    sentences[c] =
      "contact '" + contacts.contact(c).name + "': what presses is narrower " +
      "than cells resolve: only " + std::to_string(n) +
      (n == 1 ? " node presses" : " nodes press, none of them between others") +
      ". You can rely on the sum of its forces. Its pressures, and how it "
      "resists rolling, depend on the mesh: where you need them use smaller "
      "cells, at least four across what presses.";
  }

  /* The side, or both, whose nodes in the middle are meant. */
  std::string
  ContactNotices::of_second_degree(const unsigned int c) const
  {
    const Contact           &contact = contacts.contact(c);
    const auto              &names   = scene.bodies.names;
    const bodies::Structure &own     = *scene.bodies.structures[contact.body];
    if (has_second_degree(own, contact.ids))
      return "body '" + names[contact.body] + "'";
    return "body '" + names[contact.master] + "'";
  }

  std::string
  ContactNotices::of_facet(const unsigned int c,
                           const Closed      &closed,
                           const double       facet) const
  {
    const bool   is_given    = contacts.contact(c).gap.has_value();
    const bool   is_adjusted = std::count(scene.adjusted_contacts.begin(),
                                        scene.adjusted_contacts.end(),
                                        c) > 0;
    const double widest =
      *std::max_element(closed.gaps.begin(), closed.gaps.end());
    if (!is_given && is_adjusted)
      return facet > large_facet * widest && widest > 0 ?
               "Gap = adjust closes what facets leave where sides are drawn to "
               "touch, but gaps of up to " +
                 to_text(widest) + " close as well, and facets stand off by " +
                 to_text(facet) +
                 ", more than a tenth of that. Use smaller cells." :
               uneven(c, closed);
    if (second_degree[c])
      return "nodes in the middle of edges of both sides together lie up to " +
             to_text(facet) + " off its curved faces, as " +
             of_second_degree(c) +
             " has edges that are straight in the mesh and elements of second "
             "degree: pressures go up and down from node to node. Give it bent "
             "cells (Order = 2 of a drawing or a mesh of second order), or, if "
             "its cells are quadrilaterals or hexahedra, Element = Q1.";
    const double gap = closed_gap(closed.gaps, closed.normals);
    if (!is_given && facet > large_facet * gap)
      return "facets stand off its curved surfaces by " + to_text(facet) +
             ", more than a tenth of the gaps or interferences that close "
             "there (" +
             to_text(gap) +
             "): pressures of single nodes are those of facets. Use smaller "
             "cells, or give Gap = adjust where they are drawn to touch, or "
             "its Gap.";
    return uneven(c, closed);
  }

  void
  ContactNotices::judge_facets(const unsigned int c, const Closed &closed)
  {
    if (contacts.contact(c).kind != pairing::ContactKind::contact)
      return;
    const double facet =
      exceeded_by(second_degree[c] ? of_middles : .5, closed.facets);
    const std::string why =
      facet > 0 ? of_facet(c, closed, facet) : uneven(c, closed);
    if (why.empty())
      return;
    sentences[c] = "contact '" + contacts.contact(c).name + "': " + why;
    of_facets.insert(c);
  }

  void
  ContactNotices::say_end(const bool is_whole, Log &log) const
  {
    std::vector<std::string> all;
    for (const auto &[contact, sentence] : sentences)
      all.push_back(sentence);
    warn(all, log);
    ways_of_wear.say(log);
    facet_moments.say(log);
    if (is_whole)
      say_never_closed(log);
  }

  void
  ContactNotices::say_never_closed(Log &log) const
  {
    std::vector<std::string> names, gaps; // equal ones once
    for (unsigned int c = 0; c < has_closed.size(); ++c)
      if (!has_closed[c] && scene.pairings[c].n_paired > 0 &&
          least_gaps[c] < std::numeric_limits<double>::max() && // it has nodes
          contacts.contact(c).kind == pairing::ContactKind::contact)
        {
          names.push_back("'" + scene.contact_names[c] + "'");
          gaps.push_back(to_text(least_gaps[c]));
        }
    if (std::set<std::string>(gaps.begin(), gaps.end()).size() == 1)
      gaps.resize(1);
    if (names.empty())
      return;
    const bool one = names.size() == 1;
    log.say("warning: " + std::string(one ? "contact " : "contacts ") +
            join(names) + (one ? " never closes" : " never close") +
            ": no node presses in the whole run, and the least gap at its end "
            "is " +
            join(gaps) + (gaps.size() < 2 ? "" : ", in this order") +
            ". Where that is not meant, check places, loads and boundary ids.");
  }
} // namespace conetact::analysis
