// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_closing_h
#define conetact_output_closing_h

#include "conetact/output/output.h"

namespace conetact::output
{
  /**
   * The end of a run on one screen: states of contact nodes, forces of
   * contacts, supports and loads, largest displacement and pressure, probes.
   * Long lists of contacts or probes are cut, with the table that has all.
   * `faceted`: contacts whose pressures are those of the facets of a mesh.
   */
  std::vector<std::string>
  closing_lines(const RunDescription         &run,
                const model::IncrementRecord &last,
                const std::set<unsigned int> &faceted = {});

  /** The tables and collections in the folder of a run, in a line. */
  std::string
  files_written(const std::filesystem::path &folder);
} // namespace conetact::output

#endif
