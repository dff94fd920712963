// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_reaction_table_h
#define conetact_output_reaction_table_h

#include "conetact/output/csv.h"
#include "conetact/output/output.h"

#include <string>

namespace conetact
{
  /**
   * `reactions.csv`: one row for each contact node and increment. Coordinates
   * are those of the undeformed node, displacements relative to the obstacle:
   * u since the start, du of the increment [length]; r nodal forces on the
   * body [force], components along n, t1, t2. In 2D the t2 columns are 0.
   *
   * The file is rewritten after each increment from the text of all finished
   * ones. The constructor writes it without rows, so that an old table does
   * not pass for one of this run.
   */
  class ReactionTable : public Output
  {
  public:
    explicit ReactionTable(const RunDescription &description);
    void
    write(const IncrementRecord &record) override;

  private:
    void
    append(std::string           &rows,
           const IncrementRecord &record,
           const ContactRow      &row) const;

    const RunDescription run;
    std::string          text;
    NoiseFloor           forces;
  };
} // namespace conetact

#endif
