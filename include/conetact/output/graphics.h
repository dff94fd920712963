// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_graphics_h
#define conetact_output_graphics_h

#include "conetact/output/output.h"

#include <string>

namespace conetact::output
{
  /**
   * A ParaView collection: which file shows which time. Rewritten with each
   * file, so that it lists finished files only.
   */
  class PvdFile
  {
  public:
    explicit PvdFile(const std::filesystem::path &path);
    /** Files of one time, each with the name of its block. */
    void
    add(const double                                            time,
        const std::vector<std::pair<std::string, std::string>> &blocks);

  private:
    const std::filesystem::path file;
    std::string                 entries;
  };

  /**
   * Pictures of every `vtu_every`-th increment for ParaView:
   * - `solution.pvd` and `solution-BODY-0001.vtu`, drawn by the bodies;
   * - `contact.pvd` and `contact-0001.vtu`: the contact nodes as points at
   *   their undeformed places, with the vectors reaction [force], traction
   *   (reaction over tributary area, [stress]), slip (of the increment), u
   *   (total, relative to the obstacle) and normal in global coordinates and
   *   the scalars gap, state (0 open, 1 stick, 2 slip) and contact (its place
   *   in the list of contacts). Single precision.
   */
  class Graphics : public Output
  {
  public:
    /** Removes files of these names that an earlier run left. */
    explicit Graphics(const RunDescription &description);
    void
    write(const std::vector<IncrementRecord> &finished) override;
    OutputWork
    work() const override;

  private:
    void
    write_bodies(const IncrementRecord &record);
    void
    write_contacts(const IncrementRecord &record);

    const RunDescription run;
    PvdFile              solution;
    PvdFile              contact;
    unsigned int         drawings = 0;
  };
} // namespace conetact::output

#endif
