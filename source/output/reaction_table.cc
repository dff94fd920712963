// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/output/reaction_table.h"

#include <deal.II/base/exceptions.h>

namespace conetact::output
{
  namespace
  {
    void
    add(CsvRow             &csv,
        const Tensor<1, 3> &v,
        const char         *first,
        const char         *second,
        const char         *third)
    {
      csv.add(first, v[0]);
      csv.add(second, v[1]);
      csv.add(third, v[2]);
    }
  } // namespace



  ReactionTable::ReactionTable(const RunDescription &description)
    : run(description)
  {}



  std::string
  ReactionTable::header() const
  {
    return "increment,time,contact,node,x,y,z,n_x,n_y,n_z,gap,u_n,u_t1,u_t2,"
           "du_t1,du_t2,r_n,r_t1,r_t2,state,pressure,traction_t1,traction_t2,"
           "area,foot_x,foot_y,foot_z,acts_x,acts_y,acts_z" +
           std::string(run.wearing.empty() ? "\n" : ",wear\n");
  }



  std::string
  ReactionTable::rows(const model::IncrementRecord &record) const
  {
    const NoiseFloor forces = noise_of_forces(record);
    std::string      text;
    text.reserve(384 * record.rows.size());
    for (const model::ContactRow &row : record.rows)
      append(text, record, row, forces);
    return text;
  }



  void
  ReactionTable::append(std::string                  &text,
                        const model::IncrementRecord &record,
                        const model::ContactRow      &row,
                        const NoiseFloor             &forces) const
  {
    AssertIndexRange(row.contact, run.contacts.size());
    const std::string &contact = run.contacts.at(row.contact);
    const std::string  where = "Increment " + std::to_string(record.increment) +
                              ", contact '" + contact + "', node " +
                              std::to_string(row.node);
    const bool   has_t2 = run.dim == 3;
    Tensor<1, 3> r, traction;
    const auto [pressing, area] = row.pressed();
    for (unsigned int d = 0; d < (has_t2 ? 3 : 2); ++d)
      {
        r[d] = forces.clean(row.reaction[d]);
        if (area > 0)
          traction[d] = forces.clean(pressing[d]) / area;
      }

    CsvRow csv(text, where);
    csv.add(record.increment);
    csv.add("time", record.time);
    csv.add(contact);
    csv.add(row.node);
    add(csv, row.position, "x", "y", "z");
    add(csv, row.normal, "n_x", "n_y", "n_z");
    if (row.faces)
      csv.add("gap", row.gap);
    else
      csv.add("nan");
    csv.add("u_n", row.u[0]);
    csv.add("u_t1", row.u[1]);
    csv.add("u_t2", has_t2 ? row.u[2] : 0.);
    csv.add("du_t1", row.du[1]);
    csv.add("du_t2", has_t2 ? row.du[2] : 0.);
    add(csv, r, "r_n", "r_t1", "r_t2");
    csv.add(row.wet ? "wet" : row.bonded ? "bonded" : state_name(row.state));
    add(csv, traction, "pressure", "traction_t1", "traction_t2");
    csv.add("area", row.area);
    add(csv, row.foot, "foot_x", "foot_y", "foot_z");
    add(csv, row.acts, "acts_x", "acts_y", "acts_z");
    if (!run.wearing.empty())
      csv.add("wear", row.wear);
    csv.end();
  }
} // namespace conetact::output
