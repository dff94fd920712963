// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/wear_error.h"

#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace conetact::analysis
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    constexpr double much = .05; // of the largest depth

    bool
    is_accelerated(const pairing::ContactNode &node)
    {
      return node.layer && node.layer->wears() &&
             node.layer->acceleration() != 1;
    }

    std::string
    percent(const double part)
    {
      std::ostringstream text;
      text.precision(2);
      text << 100 * part << " %";
      return text.str();
    }
  } // namespace

  WearError::WearError(const contact::ContactPoints &p)
    : points(p)
    , error(VectorXd::Zero(static_cast<Index>(points.size())))
    , depth(error)
  {
    for (const contact::ContactPoint &point : points)
      if (const unsigned int contact = point.node->contact;
          is_accelerated(*point.node) &&
          std::find(accelerated.begin(), accelerated.end(), contact) ==
            accelerated.end())
        accelerated.push_back(contact);
  }

  void
  WearError::set(const contact::Wear &sum, const contact::Wear &by_halves)
  {
    AssertDimension(sum.worn().size(), error.size());
    AssertDimension(by_halves.worn().size(), error.size());
    depth          = sum.worn();
    error          = by_halves.worn() - depth;
    error_of_sides = by_halves.of_sides() - sum.of_sides();
  }

  void
  WearError::report(const std::vector<std::string> &contacts, Log &log) const
  {
    for (const unsigned int contact : accelerated)
      report(contact, contacts.at(contact), log);
  }

  void
  WearError::report(const unsigned int contact,
                    const std::string &name,
                    Log               &log) const
  {
    double deepest = 0, worst = 0, volume = 0, off = 0, N = 1;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (const pairing::ContactNode &node = *points[k].node;
          node.contact == contact)
        {
          const auto i = static_cast<Index>(k);
          deepest      = std::max(deepest, depth[i]);
          worst        = std::max(worst, std::abs(error[i]));
          volume += depth[i] * node.area;
          off += error[i] * node.area;
          N = node.layer->acceleration();
        }
    if (!(deepest > 0))
      return;
    const double part = worst / deepest;
    const double rest = volume > 0 ? std::abs(off) / volume : 0.;
    std::string  line = "Contact '" + name +
                       "': Wear acceleration = " + to_text(N) +
                       ", half of it would change depths of wear "
                       "by about " +
                       percent(part) + " of the largest, the volume by " +
                       percent(rest) + " of itself";
    if (n_missed > 0)
      line += " (" + std::to_string(n_missed) +
              " increments are not in this estimate)";
    if (part > much)
      log.say("warning: " + line + ". Take a smaller one, for more cycles.");
    else
      log.say(line + ".");
  }

  void
  WearError::save(Archive &archive) const
  {
    if (!is_asked())
      return;
    archive.put("wear/error", error);
    archive.put("wear/depth", depth);
    archive.put("wear/error of sides", error_of_sides);
    archive.put("wear/missed", static_cast<double>(n_missed));
  }

  void
  WearError::restore(const Archive &archive)
  {
    if (!is_asked() || !archive.has("wear/error"))
      return;
    archive.fill("wear/error", error);
    archive.fill("wear/depth", depth);
    archive.fill_any("wear/error of sides", error_of_sides);
    double missed = 0;
    archive.fill("wear/missed", missed);
    n_missed = static_cast<unsigned int>(missed);
  }
} // namespace conetact::analysis
