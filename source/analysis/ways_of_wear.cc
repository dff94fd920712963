// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/ways_of_wear.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>

namespace conetact::analysis
{
  namespace
  {
    double
    slip_of(const model::ContactRow &row)
    {
      return std::hypot(row.du[1], row.du[2]);
    }
  } // namespace

  void
  WaysOfWear::see(const contact::ContactPoints         &points,
                  const std::vector<model::ContactRow> &rows)
  {
    constexpr double                many = 2; // cells
    std::map<unsigned int, Pressed> pressed;
    for (std::size_t i = 0; i < points.size() && i < rows.size(); ++i)
      {
        const pairing::ContactNode &node = *points[i].node;
        const model::ContactRow    &row  = rows[i];
        if (!node.layer || !node.layer->wears() ||
            node.layer->share_of_slave() >= 1)
          continue;
        if (node.obstacle != nullptr)
          {
            const double way = std::hypot(row.u[1], row.u[2]);
            if (row.removed > 0 && way > many * node.spacing)
              on_obstacles[row.contact] =
                std::max(on_obstacles[row.contact], way);
          }
        else if (row.reaction[0] > 0)
          {
            Pressed &of = pressed[row.contact];
            of.rows.push_back(&row);
            of.spacing = std::max(of.spacing, node.spacing);
            if (of.farthest == nullptr || slip_of(row) > slip_of(*of.farthest))
              of.farthest = &row;
          }
      }
    for (const auto &[contact, of] : pressed)
      see_steps(contact, of);
  }

  /* A groove has all of its depth where all of what presses has passed. In
     steps that are long beside it, some places are passed once more than
     others. */
  void
  WaysOfWear::see_steps(const unsigned int contact, const Pressed &pressed)
  {
    constexpr double   few  = .5; // of what presses
    const double       way  = slip_of(*pressed.farthest);
    const Tensor<1, 3> slip = pressed.farthest->in_space(
      Tensor<1, 3>({0, pressed.farthest->du[1], pressed.farthest->du[2]}));
    if (!(way > 0))
      return;
    double first = 0, last = 0;
    for (const model::ContactRow *const row : pressed.rows)
      {
        const double at =
          slip * (row->position - pressed.farthest->position) / way;
        first = std::min(first, at);
        last  = std::max(last, at);
      }
    const double length = last - first + pressed.spacing;
    auto        &worst  = steps[contact];
    if (way > few * length && way > worst.first)
      worst = {way, length};
  }

  /* Its gap is that of the drawn surface. */
  void
  WaysOfWear::say_unseen(const unsigned int contact, Log &log) const
  {
    const pairing::Contact &of = scene.contacts[contact];
    if (of.kind != pairing::ContactKind::contact || of.obstacle != nullptr ||
        (of.layer && of.layer->wears()))
      return;
    for (const auto &[c, step] : steps)
      {
        const pairing::Contact &worn = scene.contacts[c];
        if (worn.master == of.master &&
            std::any_of(of.master_ids.begin(),
                        of.master_ids.end(),
                        [&](const unsigned int id) {
                          return worn.master_ids.count(id) > 0;
                        }))
          {
            log.say("warning: contact '" + of.name +
                    "' is on a side of body '" + scene.bodies.names[of.master] +
                    "' that contact '" + worn.name +
                    "' wears, and does not see what is worn off there: with "
                    "Wear coefficient = 0 it does.");
            return;
          }
      }
  }

  void
  WaysOfWear::say(Log &log) const
  {
    for (unsigned int c = 0; c < scene.contacts.size(); ++c)
      say_unseen(c, log);
    for (const auto &[c, way] : on_obstacles)
      log.say(
        "warning: contact '" + scene.contact_names[c] +
        "': what wears off obstacle '" + scene.contacts[c].obstacle->name +
        "' stays with the nodes of body '" +
        scene.bodies.names[scene.contacts[c].body] +
        "', which have slid along it by " + to_text(way) +
        ", several cells: depths and pressures are right where slips are "
        "short, as in fretting, not here. Make it a body, as Master body, "
        "or set Wear share = 1.");
    for (const auto &[c, step] : steps)
      if (step.first > 0)
        log.say("warning: contact '" + scene.contact_names[c] +
                "': it slides by up to " + to_text(step.first) +
                " in an increment, and what presses is " +
                to_text(step.second) + " long: the depth that body '" +
                scene.bodies.names[scene.contacts[c].master] +
                "' loses goes up and down along the way; the volume is right. "
                "Use smaller increments.");
  }
} // namespace conetact::analysis
