// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/increment_table.h"

#include "conetact/output/csv.h"

#include <deal.II/base/exceptions.h>

#include <array>
#include <set>

namespace conetact::output
{
  namespace
  {
    // Different names may be equal in letters that are safe.
    std::string
    resultant_columns(const std::string &name, std::set<std::string> &taken)
    {
      std::string unique = name;
      for (unsigned int i = 2; !taken.insert(unique).second; ++i)
        unique = name + '_' + std::to_string(i);
      std::string columns;
      for (const char *component :
           {"_f_x", "_f_y", "_f_z", "_m_x", "_m_y", "_m_z"})
        columns += unique + component + ',';
      return columns;
    }

    std::array<unsigned int, 3>
    count_states(const std::vector<ContactRow> &rows)
    {
      std::array<unsigned int, 3> n{};
      for (const ContactRow &row : rows)
        if (!row.master)
          ++n.at(static_cast<std::size_t>(row.state));
      return n;
    }

    /** The sum of value(row) over the rows of a contact. */
    template <typename Value>
    double
    sum_over(const std::vector<ContactRow> &rows,
             const unsigned int             contact,
             const Value                   &value)
    {
      double sum = 0;
      for (const ContactRow &row : rows)
        if (row.contact == contact)
          sum += value(row);
      return sum;
    }

    /** What is rubbed off both sides of a contact node [length^3]. */
    double
    worn_volume(const ContactRow &row)
    {
      return (row.wear + row.wear_opposite) * row.area;
    }

    /** Work against its bond [force x length]. */
    double
    fracture(const ContactRow &row)
    {
      return row.fracture;
    }

    /** Adds forces and moments, those that are noise as 0. */
    class ResultantCells
    {
    public:
      ResultantCells(CsvRow &row, const IncrementRecord &record)
        : csv(row)
        , forces(noise_of_forces(record))
        , moments(noise_of_moments(record))
      {}

      void
      add(const Resultant &resultant)
      {
        for (unsigned int d = 0; d < 3; ++d)
          csv.add("a force resultant", forces.clean(resultant.force[d]));
        for (unsigned int d = 0; d < 3; ++d)
          csv.add("a moment resultant", moments.clean(resultant.moment[d]));
      }

      /** As many as there are columns for, whatever is known. */
      void
      add(std::vector<Resultant> resultants, const std::size_t n)
      {
        resultants.resize(n);
        for (const Resultant &resultant : resultants)
          add(resultant);
      }

    private:
      CsvRow          &csv;
      const NoiseFloor forces, moments;
    };
  } // namespace



  IncrementTable::IncrementTable(const RunDescription &description)
    : run(description)
  {}



  std::string
  IncrementTable::header() const
  {
    std::set<std::string> taken;
    std::string           text =
      "increment,time,solver,substeps,iterations,residual,equilibrium,"
      "err1,err2,open,stick,slip,";
    for (const std::string &contact : run.contacts)
      text += resultant_columns(safe_name(contact), taken);
    text += resultant_columns("supports", taken);
    text += resultant_columns("loads", taken);
    if (run.bodies.size() > 1)
      for (const std::string &body : safe_names(run.bodies))
        text += "balance_" + body + ',';
    text += "balance,";
    for (const std::string &support : run.supports)
      text += resultant_columns("support_" + safe_name(support), taken);
    for (const std::string &load : run.loads)
      text += resultant_columns("load_" + safe_name(load), taken);
    text += "strain_energy,external_work,dissipation,contact_work_normal,"
            "determinate";
    for (const std::string &obstacle : run.obstacles)
      {
        const std::string name = "obstacle_" + safe_name(obstacle);
        for (const char *component :
             {"_u_x", "_u_y", "_u_z", "_rot_x", "_rot_y", "_rot_z"})
          text += ',' + name + component;
        std::string columns = resultant_columns(name, taken);
        columns.pop_back(); // the comma at the end
        text += ',' + columns;
      }
    for (const std::string &preload : safe_names(run.preloads))
      text +=
        ",preload_" + preload + "_force,preload_" + preload + "_shortening";
    for (const unsigned int contact : run.wearing)
      text += ',' + safe_name(run.contacts[contact]) + "_worn";
    for (const unsigned int contact : run.breaking)
      text += ',' + safe_name(run.contacts[contact]) + "_fracture";
    if (run.judges_uniqueness)
      text += ",unique";
    return text + '\n';
  }



  std::string
  IncrementTable::row(const IncrementRecord &record) const
  {
    Assert(record.contacts.size() <= run.contacts.size(),
           dealii::ExcMessage("Each contact has its columns."));
    Assert(record.each_load.size() <= run.loads.size(),
           dealii::ExcMessage("Each load has its columns."));
    Assert(record.obstacles.size() <= run.obstacles.size(),
           dealii::ExcMessage("Each free obstacle has its columns."));
    Assert(record.preloads.size() <= run.preloads.size(),
           dealii::ExcMessage("Each preload has its columns."));
    Assert(record.body_balance.empty() ||
             record.body_balance.size() == run.bodies.size(),
           dealii::ExcMessage("Each body has its column."));
    const std::string where = "Increment " + std::to_string(record.increment);
    std::string       text;
    CsvRow            csv(text, where);
    ResultantCells    resultants(csv, record);
    csv.add(record.increment);
    csv.add("time", record.time);
    csv.add(record.report.solver);
    csv.add(record.report.substeps);
    csv.add(record.report.iterations);
    csv.add("residual", record.report.residual);
    csv.add("equilibrium", record.equilibrium);
    csv.add("err1", record.errors.err1);
    csv.add("err2", record.errors.err2);
    for (const unsigned int n : count_states(record.rows))
      csv.add(n);
    resultants.add(record.contacts, run.contacts.size());
    resultants.add(record.supports);
    resultants.add(record.loads);
    for (const double balance : record.body_balance)
      csv.add("the balance of a body", balance);
    csv.add("balance", record.balance);
    resultants.add(record.each_support, run.supports.size());
    resultants.add(record.each_load, run.loads.size());
    csv.add("the strain energy", record.strain_energy);
    csv.add("the external work", record.external_work);
    csv.add("the dissipation", record.dissipation);
    csv.add("the work of normal reactions", record.contact_work_normal);
    csv.add(std::string(record.determinate ? "yes" : "no"));
    for (std::size_t k = 0; k < run.obstacles.size(); ++k)
      {
        const ObstacleRecord obstacle =
          k < record.obstacles.size() ? record.obstacles[k] : ObstacleRecord();
        for (const Tensor<1, 3> &motion :
             {obstacle.displacement, obstacle.rotation})
          for (unsigned int d = 0; d < 3; ++d)
            csv.add("the motion of an obstacle", motion[d]);
        resultants.add(obstacle.contacts);
      }
    for (std::size_t k = 0; k < run.preloads.size(); ++k)
      {
        const PreloadRecord preload =
          k < record.preloads.size() ? record.preloads[k] : PreloadRecord();
        csv.add("the force of a preload", preload.force);
        csv.add("the shortening by a preload", preload.shortening);
      }
    for (const unsigned int contact : run.wearing)
      csv.add("the worn volume", sum_over(record.rows, contact, worn_volume));
    for (const unsigned int contact : run.breaking)
      csv.add("the work of fracture", sum_over(record.rows, contact, fracture));
    if (run.judges_uniqueness)
      csv.add(record.unique);
    csv.end();
    return text;
  }
} // namespace conetact::output
