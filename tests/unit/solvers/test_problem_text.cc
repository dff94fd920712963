// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/problem_text.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "random_problem.h"

using namespace conetact;
using namespace conetact::solvers;

namespace
{
  StoredProblem
  read(const std::string &text)
  {
    std::istringstream stream(text);
    return read_problem_text(stream);
  }

  void
  expect_equal(const StoredProblem &a, const StoredProblem &b)
  {
    const ContactSystem &s = *a.problem.system, &t = *b.problem.system;
    EXPECT_EQ(s.form, t.form);
    EXPECT_EQ(s.first, t.first);
    EXPECT_EQ(s.n_motions, t.n_motions);
    EXPECT_EQ(s.mu, t.mu);
    EXPECT_EQ(s.matrix, t.matrix);
    EXPECT_EQ(s.null_space.cols(), t.null_space.cols());
    if (s.null_space.cols() > 0)
      {
        EXPECT_EQ(s.null_space, t.null_space);
      }
    EXPECT_EQ(a.problem.load, b.problem.load);
    EXPECT_EQ(a.problem.gap, b.problem.gap);
    EXPECT_EQ(a.problem.offset, b.problem.offset);
    EXPECT_EQ(a.problem.reference_force, b.problem.reference_force);
    EXPECT_EQ(a.rate, b.rate);
    EXPECT_EQ(a.begin, b.begin);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.cohesion, b.cohesion);
  }

  const std::string one_node = "Conetact problem, stiffness form\n"
                               "tangents 1 1\n1\n"
                               "friction 1 1\n0.5 # mu\n"
                               "matrix 2 2\n2 0\n0 2\n"
                               "load 2 1\n1\n-1\n"
                               "gap 1 1\n0\n";

  std::string
  refusal(const std::string &text)
  {
    try
      {
        read(text);
      }
    catch (const std::invalid_argument &error)
      {
        return error.what();
      }
    return {};
  }
} // namespace

TEST(ProblemText, LosesNoDigit)
{
  for (const Form form : {Form::stiffness, Form::compliance})
    for (const int tangents : {0, 1, 2, -1})
      {
        RandomOptions o;
        o.form     = form;
        o.tangents = tangents;
        o.motions  = form == Form::compliance ? 2 : 0;
        StoredProblem stored;
        stored.problem                 = random_problem(o).problem;
        stored.problem.reference_force = 1. / 3;
        expect_equal(read(to_problem_text(stored)), stored);
        stored.rate     = stored.problem.load / 3;
        stored.begin    = 1. / 7;
        stored.end      = 2.1;
        stored.cohesion = Eigen::VectorXd::Constant(o.n_nodes, .1);
        if (form == Form::stiffness)
          stored.problem.offset = .1 * stored.problem.load;
        expect_equal(read(to_problem_text(stored)), stored);
      }
}

TEST(ProblemText, ReadsWhatAHandWrites)
{
  const StoredProblem stored = read("# by hand\n" + one_node);
  EXPECT_FALSE(stored.is_stage());
  EXPECT_EQ(stored.problem.system->n_tangents(0), 1);
  EXPECT_EQ(stored.problem.system->mu(0), .5);
  EXPECT_EQ(stored.problem.load(1), -1);
}

TEST(ProblemText, RefusesInWords)
{
  EXPECT_NE(refusal("").find("does not begin with"), std::string::npos);
  EXPECT_NE(refusal(one_node + "gap 1 1\n0\n").find("twice"),
            std::string::npos);
  EXPECT_NE(refusal(one_node + "stuff 1 1\n0\n").find("no block 'stuff'"),
            std::string::npos);
  EXPECT_NE(refusal(one_node + "rate 2 1\n0 nan\n").find("fewer numbers"),
            std::string::npos);
  EXPECT_NE(refusal(one_node + "rate 2 1\n0 1\n").find("'stage' is missing"),
            std::string::npos);
  EXPECT_NE(refusal(one_node + "rate -2 1\n").find("numbers of rows"),
            std::string::npos);
  EXPECT_NE(refusal(one_node + "offset 3 1\n0 0 0\n").find("must have 2 rows"),
            std::string::npos);
  EXPECT_NE(refusal(one_node + "motions 1 1\n1\n").find("only the compliance"),
            std::string::npos);
  EXPECT_NE(refusal("Conetact problem, stiffness form\ntangents 1 1\n3\n")
              .find("from 0 to 2"),
            std::string::npos);
  EXPECT_NE(
    refusal(one_node.substr(0, one_node.size() - 2)).find("fewer numbers"),
    std::string::npos);
}
