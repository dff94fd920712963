// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/increment_table.h"

#include <array>

namespace conetact
{
  namespace
  {
    std::string
    resultant_columns(const std::string &name)
    {
      std::string columns;
      for (const char *component :
           {"_f_x", "_f_y", "_f_z", "_m_x", "_m_y", "_m_z"})
        columns += name + component + ',';
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

    template <typename Function>
    void
    for_each_resultant(const IncrementRecord &record, const Function &f)
    {
      for (const Resultant &contact : record.contacts)
        f(contact);
      f(record.supports);
      f(record.loads);
    }
  } // namespace



  IncrementTable::IncrementTable(const RunDescription &description)
    : run(description)
  {}



  std::string
  IncrementTable::header() const
  {
    std::string text =
      "increment,time,solver,substeps,iterations,residual,equilibrium,"
      "err1,err2,open,stick,slip,";
    for (const std::string &contact : run.contacts)
      text += resultant_columns(safe_name(contact));
    text += resultant_columns("supports") + resultant_columns("loads");
    if (run.bodies.size() > 1)
      for (const std::string &body : run.bodies)
        text += "balance_" + safe_name(body) + ',';
    return text + "balance\n";
  }



  // The noise of a moment is that of a nodal force times its lever, also where
  // all moments cancel.
  void
  IncrementTable::see(const IncrementRecord &record)
  {
    for (const ContactRow &row : record.rows)
      {
        forces.see(row.reaction.norm());
        moments.see(row.reaction.norm() * row.position.norm());
      }
    for_each_resultant(record, [&](const Resultant &resultant) {
      forces.see(resultant.force.norm());
      moments.see(resultant.moment.norm());
    });
  }



  void
  IncrementTable::add(CsvRow &csv, const Resultant &resultant) const
  {
    for (unsigned int d = 0; d < 3; ++d)
      csv.add("a force resultant", forces.clean(resultant.force[d]));
    for (unsigned int d = 0; d < 3; ++d)
      csv.add("a moment resultant", moments.clean(resultant.moment[d]));
  }



  std::string
  IncrementTable::row(const IncrementRecord &record)
  {
    see(record);
    const std::string where = "Increment " + std::to_string(record.increment);

    std::string text;
    CsvRow      csv(text, where);
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
    for_each_resultant(record, [&](const Resultant &r) { add(csv, r); });
    for (const double balance : record.body_balance)
      csv.add("the balance of a body", balance);
    csv.add("balance", record.balance);
    csv.end();
    return text;
  }
} // namespace conetact
