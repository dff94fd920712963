// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/reaction_table.h"

namespace conetact
{
  ReactionTable::ReactionTable(const RunDescription &description)
    : run(description)
  {}



  std::string
  ReactionTable::header() const
  {
    return "increment,time,contact,node,x,y,z,n_x,n_y,n_z,gap,u_n,u_t1,u_t2,"
           "du_t1,du_t2,r_n,r_t1,r_t2,state\n";
  }



  std::string
  ReactionTable::rows(const IncrementRecord &record)
  {
    for (const ContactRow &row : record.rows)
      for (unsigned int d = 0; d < 3; ++d)
        forces.see(row.reaction[d]);

    std::string text;
    text.reserve(256 * record.rows.size());
    for (const ContactRow &row : record.rows)
      append(text, record, row);
    return text;
  }



  void
  ReactionTable::append(std::string           &text,
                        const IncrementRecord &record,
                        const ContactRow      &row) const
  {
    const std::string &contact = run.contacts.at(row.contact);
    const std::string  where = "Increment " + std::to_string(record.increment) +
                              ", contact '" + contact + "', node " +
                              std::to_string(row.node);
    const bool has_t2 = run.dim == 3;

    CsvRow csv(text, where);
    csv.add(record.increment);
    csv.add("time", record.time);
    csv.add(contact);
    csv.add(row.node);
    csv.add("x", row.position[0]);
    csv.add("y", row.position[1]);
    csv.add("z", row.position[2]);
    csv.add("n_x", row.normal[0]);
    csv.add("n_y", row.normal[1]);
    csv.add("n_z", row.normal[2]);
    csv.add("gap", row.gap);
    csv.add("u_n", row.u[0]);
    csv.add("u_t1", row.u[1]);
    csv.add("u_t2", has_t2 ? row.u[2] : 0.);
    csv.add("du_t1", row.du[1]);
    csv.add("du_t2", has_t2 ? row.du[2] : 0.);
    csv.add("r_n", forces.clean(row.reaction[0]));
    csv.add("r_t1", forces.clean(row.reaction[1]));
    csv.add("r_t2", has_t2 ? forces.clean(row.reaction[2]) : 0.);
    csv.add(state_name(row.state));
    csv.end();
  }
} // namespace conetact
