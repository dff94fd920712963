// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_reaction_table_h
#define conetact_output_reaction_table_h

#include "conetact/output/csv.h"
#include "conetact/output/output.h"

#include <string>

namespace conetact::output
{
  /**
   * `reactions.csv`: one row for each contact node and increment. Coordinates
   * are those of the undeformed node, displacements relative to the obstacle:
   * u since the start, du of the increment [length]; r nodal forces on the
   * body [force], components along n, t1, t2; pressure and tractions are these
   * over the tributary area (0 where it is 0); the foot is where the reaction
   * acts on the other side, and it acts on the body at the node but where the
   * contact sees a mean of nodes (mortar). In 2D the t2 columns are 0.
   */
  class ReactionTable
  {
  public:
    explicit ReactionTable(const RunDescription &description);
    std::string
    header() const;
    /** Throws AnalysisError at a number that is not finite. */
    std::string
    rows(const model::IncrementRecord &record) const;

  private:
    void
    append(std::string                  &text,
           const model::IncrementRecord &record,
           const model::ContactRow      &row,
           const NoiseFloor             &forces) const;

    const RunDescription run;
  };
} // namespace conetact::output

#endif
