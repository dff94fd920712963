// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

// Every output that there is, and the columns of the tables one by one.

#include "conetact/output/increment_table.h"
#include "conetact/output/output_table.h"
#include "conetact/output/reaction_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

using namespace conetact;
using namespace conetact::output;
using namespace conetact::solvers;

namespace
{
  std::vector<std::string>
  cells(const std::string &line)
  {
    std::vector<std::string> result;
    std::istringstream       in(line);
    for (std::string cell; std::getline(in, cell, ',');)
      {
        cell.erase(std::remove(cell.begin(), cell.end(), '\n'), cell.end());
        result.push_back(cell);
      }
    return result;
  }

  /** One line by the names of the columns, which must all be different. */
  std::map<std::string, std::string>
  table_of(const std::string &header, const std::string &line)
  {
    const auto names = cells(header), values = cells(line);
    EXPECT_EQ(names.size(), values.size());
    std::map<std::string, std::string> result;
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i)
      EXPECT_TRUE(result.emplace(names[i], values[i]).second) << names[i];
    return result;
  }

  RunDescription
  description()
  {
    RunDescription run;
    run.dim      = 3;
    run.contacts = {"bottom", "joint", "joint_master"};
    run.supports = {"top", "top-"};
    run.loads    = {"top", "weight"};
    run.bodies   = {"block 1", "block_1"};
    return run;
  }

  model::IncrementRecord
  record(const RunDescription &run)
  {
    model::IncrementRecord result;
    result.increment = 7;
    result.contacts.resize(run.contacts.size());
    result.each_support.resize(run.supports.size());
    result.each_load.resize(run.loads.size());
    result.body_balance = {1e-12, 2e-12};
    return result;
  }
} // namespace



TEST(OutputTable, KindsHaveNamesOfTheirOwn)
{
  std::set<std::string> names;
  for (const OutputRow &row : output_table())
    {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_GT(std::string(row.description).size(), 10u);
      EXPECT_NE(row.create, nullptr);
    }
  // tables first, for a picture may fill the disk
  EXPECT_STREQ(output_table().front().name, "tables");
}



TEST(IncrementTable, AsManyCellsAsColumnsWhateverIsKnown)
{
  const RunDescription   run = description();
  const IncrementTable   table(run);
  model::IncrementRecord r = record(run);
  table_of(table.header(), table.row(r));
  r.each_support.clear(); // not known of a load path
  r.each_load.resize(1);
  table_of(table.header(), table.row(r));
  RunDescription alone = run;
  alone.bodies         = {"block"};
  r.body_balance.clear();
  const IncrementTable shorter(alone);
  EXPECT_EQ(table_of(shorter.header(), shorter.row(r)).count("balance_block"),
            0u);
}



TEST(IncrementTable, NodesAreCountedOnceByTheirStates)
{
  const RunDescription   run = description();
  const IncrementTable   table(run);
  model::IncrementRecord r = record(run);
  r.rows.resize(6);
  const NodeState states[] = {NodeState::slip,
                              NodeState::open,
                              NodeState::slip,
                              NodeState::stick,
                              NodeState::slip,
                              NodeState::open};
  for (std::size_t i = 0; i < 6; ++i)
    r.rows[i].state = states[i];
  r.rows[5].master = true; // the other side of one of them
  auto found       = table_of(table.header(), table.row(r));
  EXPECT_EQ(found["increment"], "7");
  EXPECT_EQ(found["open"], "1");
  EXPECT_EQ(found["stick"], "1");
  EXPECT_EQ(found["slip"], "3");
}



TEST(IncrementTable, ResultantsStandUnderTheirNames)
{
  const RunDescription   run = description();
  const IncrementTable   table(run);
  model::IncrementRecord r    = record(run);
  double                 next = 1;
  const auto             fill = [&next](model::Resultant &resultant) {
    for (unsigned int d = 0; d < 3; ++d)
      {
        resultant.force[d]  = next++;
        resultant.moment[d] = next++;
      }
  };
  for (auto *list : {&r.contacts, &r.each_support, &r.each_load})
    for (model::Resultant &resultant : *list)
      fill(resultant);
  auto found = table_of(table.header(), table.row(r));
  EXPECT_EQ(found["bottom_f_x"], "1");
  EXPECT_EQ(found["bottom_m_x"], "2");
  EXPECT_EQ(found["joint_m_z"], "12");
  EXPECT_EQ(found["joint_master_f_x"], "13");
  EXPECT_EQ(found["support_top_f_x"], "19");
  EXPECT_EQ(found["support_top-_f_x"], "25");
  EXPECT_EQ(found["load_top_f_y"], "33");
  EXPECT_EQ(found["load_weight_m_z"], "42");
  EXPECT_EQ(found["supports_f_x"], "0");
}



// bodies whose names are equal in letters that are safe
TEST(IncrementTable, EachBodyHasItsBalance)
{
  const RunDescription run = description();
  const IncrementTable table(run);
  auto                 found = table_of(table.header(), table.row(record(run)));
  EXPECT_EQ(found["balance_block_1"], "1e-12");
  EXPECT_EQ(found["balance_block_1_2"], "2e-12");
}



// components in a right-handed frame keep the length of a vector, and
// pressures are forces over the area
TEST(ReactionTable, RowsOfNodes)
{
  const RunDescription   run = description();
  const ReactionTable    table(run);
  model::IncrementRecord r = record(run);
  r.time                   = .5;
  r.rows.resize(2);
  for (unsigned int i = 0; i < 2; ++i)
    {
      model::ContactRow &row = r.rows[i];
      row.contact            = 1 + i;
      row.node               = 40 + i;
      row.position           = Point<3>(1, 2, 3);
      row.normal             = Tensor<1, 3>({0, .6, .8});
      row.area               = .25;
      row.reaction           = Tensor<1, 3>({8, 3, -4});
      row.u                  = Tensor<1, 3>({.1, .2, .3});
      row.du                 = Tensor<1, 3>({.01, .02, .03});
      row.acts               = row.position;
      row.state              = NodeState::slip;
      row.master             = i == 1;
    }
  const std::string rows  = table.rows(r);
  const std::size_t end   = rows.find('\n') + 1;
  auto              found = table_of(table.header(), rows.substr(0, end));
  EXPECT_EQ(found["contact"], "joint");
  EXPECT_EQ(found["node"], "40");
  EXPECT_EQ(found["n_z"], "0.8");
  EXPECT_EQ(found["u_t2"], "0.3");
  EXPECT_EQ(found["du_t1"], "0.02");
  EXPECT_EQ(found["pressure"], "32");
  EXPECT_EQ(found["traction_t1"], "12");
  EXPECT_EQ(found["traction_t2"], "-16");
  EXPECT_EQ(found["acts_z"], "3");
  found = table_of(table.header(), rows.substr(end));
  EXPECT_EQ(found["contact"], "joint_master");
  EXPECT_EQ(found["node"], "41");
}
