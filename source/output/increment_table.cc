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
    std::array<unsigned int, 3>
    count_states(const std::vector<model::ContactRow> &rows)
    {
      std::array<unsigned int, 3> n{};
      for (const model::ContactRow &row : rows)
        if (!row.master)
          ++n.at(static_cast<std::size_t>(row.state));
      return n;
    }

    /** The sum of value(row) over the rows of a contact. */
    template <typename Value>
    double
    sum_over(const std::vector<model::ContactRow> &rows,
             const unsigned int                    contact,
             const Value                          &value)
    {
      double sum = 0;
      for (const model::ContactRow &row : rows)
        if (row.contact == contact)
          sum += value(row);
      return sum;
    }

    /** What is rubbed off both sides at a contact node [length^3]. */
    double
    worn_volume(const model::ContactRow &row)
    {
      return row.removed;
    }

    /** Work against its bond [force x length]. */
    double
    fracture(const model::ContactRow &row)
    {
      return row.fracture;
    }

    /** Entry k of a list that may be shorter, as that of a load path. */
    template <typename T>
    T
    entry(const std::vector<T> &list, const std::size_t k)
    {
      return k < list.size() ? list[k] : T();
    }
  } // namespace

  /** Columns of an increment: the name of each, and its cell. */
  class IncrementTable::Columns
  {
  public:
    explicit Columns(const model::IncrementRecord &record)
      : csv(cells, "Increment " + std::to_string(record.increment))
      , forces(noise_of_forces(record))
      , moments(noise_of_moments(record))
    {}
    Columns(const Columns &) = delete;
    Columns &
    operator=(const Columns &) = delete;

    void
    add(const std::string &name, const double number)
    {
      add_name(name);
      csv.add(name.c_str(), number);
    }
    /** A count or a word. */
    template <typename Cell>
    void
    add(const std::string &name, const Cell &cell)
    {
      add_name(name);
      csv.add(cell);
    }
    /** Columns NAMEx, NAMEy, NAMEz. */
    void
    add_vector(const std::string &name, const Tensor<1, 3> &v)
    {
      for (unsigned int d = 0; d < 3; ++d)
        add(name + "xyz"[d], v[d]);
    }
    /** A force and its moment, what is noise as 0. Different names may be equal
     * in letters that are safe. */
    void
    add_resultant(const std::string &name, const model::Resultant &resultant)
    {
      std::string unique = name;
      for (unsigned int i = 2; !taken.insert(unique).second; ++i)
        unique = name + '_' + std::to_string(i);
      add_vector(unique + "_f_", clean(forces, resultant.force));
      add_vector(unique + "_m_", clean(moments, resultant.moment));
    }

    std::string names, cells;

  private:
    void
    add_name(const std::string &name)
    {
      names += (names.empty() ? "" : ",") + name;
    }
    static Tensor<1, 3>
    clean(const NoiseFloor &noise, Tensor<1, 3> v)
    {
      for (unsigned int d = 0; d < 3; ++d)
        v[d] = noise.clean(v[d]);
      return v;
    }

    CsvRow                csv;
    const NoiseFloor      forces, moments;
    std::set<std::string> taken;
  };



  IncrementTable::IncrementTable(const RunDescription &description)
    : run(description)
  {}



  void
  IncrementTable::fill(const model::IncrementRecord &record,
                       Columns                      &columns) const
  {
    Assert(record.contacts.size() <= run.contacts.size(),
           dealii::ExcMessage("Each contact has its columns."));
    Assert(record.each_load.size() <= run.loads.size(),
           dealii::ExcMessage("Each load has its columns."));
    Assert(record.obstacles.size() <= run.obstacles.size(),
           dealii::ExcMessage("Each free obstacle has its columns."));
    Assert(record.preloads.size() <= run.preloads.size(),
           dealii::ExcMessage("Each preload has its columns."));
    columns.add("increment", record.increment);
    columns.add("time", record.time);
    columns.add("solver", record.report.solver);
    columns.add("substeps", record.report.substeps);
    columns.add("iterations", record.report.iterations);
    columns.add("residual", record.report.residual);
    columns.add("equilibrium", record.equilibrium);
    columns.add("err1", record.errors.err1);
    columns.add("err2", record.errors.err2);
    const auto n = count_states(record.rows);
    columns.add("open", n[0]);
    columns.add("stick", n[1]);
    columns.add("slip", n[2]);
    for (std::size_t c = 0; c < run.contacts.size(); ++c)
      columns.add_resultant(safe_name(run.contacts[c]),
                            entry(record.contacts, c));
    columns.add_resultant("supports", record.supports);
    columns.add_resultant("loads", record.loads);
    const std::vector<std::string> bodies = safe_names(run.bodies);
    for (std::size_t b = 0; b < bodies.size() && bodies.size() > 1; ++b)
      columns.add("balance_" + bodies[b], entry(record.body_balance, b));
    columns.add("balance", record.balance);
    fill_external(record, columns);
    fill_further(record, columns);
  }



  /* One by one, and energies. */
  void
  IncrementTable::fill_external(const model::IncrementRecord &record,
                                Columns                      &columns) const
  {
    for (std::size_t k = 0; k < run.supports.size(); ++k)
      columns.add_resultant("support_" + safe_name(run.supports[k]),
                            entry(record.each_support, k));
    for (std::size_t k = 0; k < run.loads.size(); ++k)
      columns.add_resultant("load_" + safe_name(run.loads[k]),
                            entry(record.each_load, k));
    columns.add("strain_energy", record.strain_energy);
    columns.add("external_work", record.external_work);
    columns.add("dissipation", record.dissipation);
    columns.add("contact_work_normal", record.contact_work_normal);
    columns.add("determinate", std::string(record.determinate ? "yes" : "no"));
  }



  /* What only some scenes have comes last. */
  void
  IncrementTable::fill_further(const model::IncrementRecord &record,
                               Columns                      &columns) const
  {
    for (std::size_t k = 0; k < run.obstacles.size(); ++k)
      {
        const std::string name = "obstacle_" + safe_name(run.obstacles[k]);
        const model::ObstacleRecord obstacle = entry(record.obstacles, k);
        columns.add_vector(name + "_u_", obstacle.displacement);
        columns.add_vector(name + "_rot_", obstacle.rotation);
        columns.add_resultant(name, obstacle.contacts);
      }
    const std::vector<std::string> preloads = safe_names(run.preloads);
    for (std::size_t k = 0; k < preloads.size(); ++k)
      {
        const model::PreloadRecord preload = entry(record.preloads, k);
        columns.add("preload_" + preloads[k] + "_force", preload.force);
        columns.add("preload_" + preloads[k] + "_shortening",
                    preload.shortening);
      }
    for (const unsigned int contact : run.wearing)
      columns.add(safe_name(run.contacts[contact]) + "_worn",
                  sum_over(record.rows, contact, worn_volume));
    for (const unsigned int contact : run.breaking)
      columns.add(safe_name(run.contacts[contact]) + "_fracture",
                  sum_over(record.rows, contact, fracture));
    if (run.judges_uniqueness)
      columns.add("unique", record.unique);
  }



  std::string
  IncrementTable::header() const
  {
    const model::IncrementRecord nothing;
    Columns                      columns(nothing);
    fill(nothing, columns);
    return columns.names + '\n';
  }



  std::string
  IncrementTable::row(const model::IncrementRecord &record) const
  {
    Columns columns(record);
    fill(record, columns);
    return columns.cells + '\n';
  }
} // namespace conetact::output
