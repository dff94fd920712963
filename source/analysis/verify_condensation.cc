// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/verify_condensation.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

namespace conetact::analysis
{
  namespace
  {
    /** Rounding of a body as slender as meshes allow stays well below. */
    constexpr double largest_difference = 1e-10;

    std::string
    name(const std::vector<unsigned int> &which, const model::Bodies &bodies)
    {
      std::vector<std::string> names;
      for (const unsigned int body : which)
        names.push_back("'" + bodies.names[body] + "'");
      return (names.size() > 1 ? "bodies " : "body ") + join(names, ", ");
    }
  } // namespace



  void
  verify_condensation(contact::ContactModel      &model,
                      const condensed::Condenser &own,
                      const condensed::Condenser &other,
                      Log                        &log)
  {
    const auto found = model.compare_stiffness(other);
    if (found.empty())
      log.say("verify: no node may touch anything, nothing was condensed");
    for (const auto &[which, difference] : found)
      {
        const std::string body = name(which, model.bodies);
        log.say("verify: condensed stiffness of " + body + ", " + own.name +
                " against " + other.name + ": largest relative difference " +
                to_text(difference));
        if (!(difference <= largest_difference)) // nor if it is not a number
          throw AnalysisError(
            "The condensed stiffness of " + body + " by " + own.name +
            " differs from that by " + other.name + " by " +
            to_text(difference) + " of its largest entry, more than " +
            to_text(largest_difference) +
            ": digits are lost in its factorisation. Check its mesh for cells "
            "that are nearly flat, and contrasts of its stiffness.");
      }
  }
} // namespace conetact::analysis
