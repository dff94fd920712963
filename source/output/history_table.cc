// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/history_table.h"

#include "conetact/base/atomic_file.h"
#include "conetact/output/csv.h"
#include "conetact/output/extremes.h"
#include "conetact/output/former_rows.h"

#include <deal.II/base/exceptions.h>

namespace conetact::output
{
  namespace
  {
    std::string
    header(const RunDescription &run)
    {
      std::string text =
        "increment,time,largest_displacement,largest_displacement_body,"
        "largest_displacement_x,largest_displacement_y,largest_displacement_z,"
        "largest_pressure,largest_pressure_contact,largest_pressure_x,"
        "largest_pressure_y,largest_pressure_z";
      for (const std::string &probe : run.probes)
        for (const char *component : {"_u_x", "_u_y", "_u_z"})
          text += ',' + probe + component;
      return text + '\n';
    }

    template <class Vector>
    void
    add(CsvRow &csv, const char *what, const Vector &v)
    {
      for (unsigned int d = 0; d < 3; ++d)
        csv.add(what, v[d]);
    }
  } // namespace



  HistoryTable::HistoryTable(const RunDescription &description)
    : run(description)
  {
    const std::string text =
      header(run) + former_rows(run, "history.csv", header(run));
    write_atomically(run.folder / "history.csv", text);
    n_bytes = text.size();
  }



  void
  HistoryTable::write(const std::vector<model::IncrementRecord> &finished)
  {
    std::string text;
    for (const model::IncrementRecord &record : finished)
      append(record, text);
    append_to_file(run.folder / "history.csv", text);
    n_bytes += text.size();
  }



  OutputWork
  HistoryTable::work() const
  {
    return {0, n_bytes};
  }



  void
  HistoryTable::append(const model::IncrementRecord &record,
                       std::string                  &text) const
  {
    Assert(record.probes.empty() || record.probes.size() == run.probes.size(),
           dealii::ExcMessage("Each probe has its columns."));
    const std::string where = "Increment " + std::to_string(record.increment);
    const model::LargestDisplacement &moved   = record.largest_displacement;
    const LargestPressure             pressed = largest_pressure(record);
    CsvRow                            csv(text, where);
    csv.add(record.increment);
    csv.add("time", record.time);
    csv.add("the largest displacement", moved.size);
    csv.add(moved.size > 0 ? run.bodies.at(moved.body) : "");
    add(csv, "the place of the largest displacement", moved.position);
    csv.add("the largest pressure", pressed.pressure);
    csv.add(pressed.pressure > 0 ? run.contacts.at(pressed.contact) : "");
    add(csv, "the place of the largest pressure", pressed.position);
    std::vector<Tensor<1, 3>> probes = record.probes;
    probes.resize(run.probes.size());
    for (const Tensor<1, 3> &displacement : probes)
      add(csv, "the displacement of a probe", displacement);
    csv.end();
  }
} // namespace conetact::output
