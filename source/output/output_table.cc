// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/output_table.h"

#include "conetact/output/graphics.h"
#include "conetact/output/history_table.h"
#include "conetact/output/problem_files.h"
#include "conetact/output/problem_texts.h"
#include "conetact/output/tables.h"

namespace conetact::output
{
  namespace
  {
    template <typename T>
    std::unique_ptr<Output>
    create(const RunDescription &run)
    {
      return std::make_unique<T>(run);
    }
  } // namespace



  // In this order they write: tables first, for a picture may fill the disk.
  const std::vector<OutputRow> &
  output_table()
  {
    static const std::vector<OutputRow> table = {
      {"tables",
       "reactions.csv: gap, displacements, reactions and state of each contact "
       "node; increments.csv: iterations, residuals, numbers of states, "
       "resultants and energies",
       create<Tables>,
       false},
      {"history",
       "history.csv: largest displacement and pressure, displacements of chosen "
       "points",
       create<HistoryTable>,
       false},
      {"problems",
       "problem-0001.hdf5: condensed problems of chosen increments for FCLib",
       create<ProblemFiles>,
       false},
      {"problem texts",
       "problem-0001.txt: condensed problems of chosen increments as plain "
       "text",
       create<ProblemTexts>,
       false},
      {"graphics",
       "scene.pvd, surface.pvd, contact.pvd and VTU files of bodies, their "
       "surfaces and contact nodes",
       create<Graphics>,
       true}};
    return table;
  }
} // namespace conetact::output
