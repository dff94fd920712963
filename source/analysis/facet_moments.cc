// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/facet_moments.h"

#include "conetact/base/text.h"

#include <cmath>

namespace conetact::analysis
{
  const std::optional<pairing::RoundSurface> &
  FacetMoments::round(const unsigned int c)
  {
    const auto known = rounds.find(c);
    if (known != rounds.end())
      return known->second;
    std::optional<pairing::RoundSurface> &found   = rounds[c];
    const pairing::Contact               &contact = scene.contacts[c];
    if (contact.obstacle != nullptr || contact.slides ||
        contact.kind != pairing::ContactKind::contact)
      return found;
    const auto side = [&](const unsigned int         body,
                          const bodies::BoundaryIds &ids) {
      return pairing::round_surface(*scene.bodies.structures[body],
                                    ids,
                                    scene.bodies.dim);
    };
    const auto own = side(contact.body, contact.ids);
    if (!own || !(own->axis.norm() > 0)) // balls turn about any axis
      return found;
    const auto other = side(contact.master, contact.master_ids);
    if (other && own->is_about_axis_of(*other))
      found = own;
    return found;
  }

  void
  FacetMoments::see(const contact::ContactPoints         &points,
                    const std::vector<model::ContactRow> &rows)
  {
    last.clear();
    for (std::size_t i = 0; i < points.size() && i < rows.size(); ++i)
      {
        const model::ContactRow &row = rows[i];
        if (!(row.reaction[0] > 0) || !round(row.contact))
          continue;
        const pairing::RoundSurface &about = *round(row.contact);
        const Tensor<1, 3>           arm   = row.acts - about.centre;
        const Tensor<1, 3>           all   = row.in_space(row.reaction);
        const Tensor<1, 3>           press = row.reaction[0] * row.normal;
        Moments                     &sum   = last[row.contact];
        sum.normal += cross_product_3d(arm, press) * about.axis;
        sum.friction += cross_product_3d(arm, all - press) * about.axis;
        sum.most += points[i].mu * row.reaction[0] * about.radius;
        sum.all_slip &= row.state == solvers::NodeState::slip;
      }
  }

  void
  FacetMoments::say(Log &log) const
  {
    constexpr double large = .05; // of what there is, and of what may be
    for (const auto &[contact, sum] : last)
      {
        const double size = std::abs(sum.normal);
        if (size <= large * std::abs(sum.normal + sum.friction) ||
            size <= large * sum.most || !(sum.most > 0))
          continue;
        log.say("warning: contact '" + scene.contact_names[contact] +
                "': normal forces turn one of its round sides in the other, by "
                "a moment of " +
                to_text(size) + " about their axis where friction bears " +
                to_text(std::abs(sum.friction)) +
                ": facets of both lock into each other, which round bodies do "
                "not. " +
                (sum.all_slip ? "All of its nodes slip: round bodies would "
                                "turn freely under this load. " :
                                "") +
                "Use Pairing = mortar, smaller cells, or cells that match.");
      }
  }
} // namespace conetact::analysis
