// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/problem_text.h"

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    const std::string head = "Conetact problem, ";

    std::string
    form_name(const Form form)
    {
      return form == Form::stiffness ? "stiffness form" : "compliance form";
    }

    /** Blocks by name; those that are read leave the map. */
    using Blocks = std::map<std::string, MatrixXd>;

    void
    write_block(std::ostream      &out,
                const std::string &name,
                const MatrixXd    &values)
    {
      // What is not there has its default.
      if (values.size() == 0)
        return;
      out << name << ' ' << values.rows() << ' ' << values.cols() << '\n';
      for (Index i = 0; i < values.rows(); ++i)
        for (Index j = 0; j < values.cols(); ++j)
          out << values(i, j) << (j + 1 < values.cols() ? ' ' : '\n');
    }

    MatrixXd
    scalar(const double value)
    {
      return value == 0 ? MatrixXd() : MatrixXd::Constant(1, 1, value);
    }

    [[noreturn]] void
    refuse(const std::string &what)
    {
      throw std::invalid_argument("This is no contact problem of Conetact: " +
                                  what);
    }

    /** The text without comments. */
    std::istringstream
    without_comments(std::istream &text)
    {
      std::string result;
      for (std::string line; std::getline(text, line);)
        result += line.substr(0, line.find('#')) + '\n';
      return std::istringstream(result);
    }

    MatrixXd
    read_block(std::istream &in, const std::string &name)
    {
      // A first number that is wrong must not ask for all memory there is.
      constexpr Index most = 1 << 28; // numbers, 2 GB
      Index           rows = 0, columns = 0;
      if (!(in >> rows >> columns) || rows < 1 || columns < 1 ||
          rows > most / columns)
        refuse("the block '" + name +
               "' does not begin with its numbers of "
               "rows and columns.");
      MatrixXd values(rows, columns);
      for (Index i = 0; i < rows; ++i)
        for (Index j = 0; j < columns; ++j)
          if (!(in >> values(i, j)) || !std::isfinite(values(i, j)))
            refuse("the block '" + name + "' has fewer numbers than it says, " +
                   "or one that is none.");
      return values;
    }

    Form
    read_form(std::istream &in)
    {
      std::string line;
      while (std::getline(in, line) && line.empty())
        ;
      for (const Form form : {Form::stiffness, Form::compliance})
        if (line.rfind(head + form_name(form), 0) == 0)
          return form;
      refuse("it does not begin with '" + head + form_name(Form::stiffness) +
             "' or '" + head + form_name(Form::compliance) + "'.");
    }

    Blocks
    read_blocks(std::istream &in)
    {
      Blocks blocks;
      for (std::string name; in >> name;)
        if (!blocks.emplace(name, read_block(in, name)).second)
          refuse("the block '" + name + "' stands there twice.");
      return blocks;
    }

    /** Takes a block of that size; without rows where it may be missing. */
    MatrixXd
    take(Blocks            &blocks,
         const std::string &name,
         const Index        rows,
         const Index        columns,
         const bool         needed)
    {
      const auto found = blocks.find(name);
      if (found == blocks.end())
        {
          if (needed)
            refuse("the block '" + name + "' is missing.");
          return MatrixXd(0, columns);
        }
      MatrixXd result = std::move(found->second);
      blocks.erase(found);
      if (result.rows() != rows || result.cols() != columns)
        refuse("the block '" + name + "' must have " + std::to_string(rows) +
               " rows and " + std::to_string(columns) + " columns.");
      return result;
    }

    double
    take_scalar(Blocks &blocks, const std::string &name)
    {
      const MatrixXd value = take(blocks, name, 1, 1, false);
      return value.size() == 0 ? 0. : value(0, 0);
    }

    /** Whole numbers, from 0 to the largest possible one. */
    Index
    whole(const double value, const double largest, const std::string &name)
    {
      if (!(value >= 0) || value > largest || value != std::floor(value))
        refuse("the block '" + name + "' holds something else than numbers " +
               "from 0 to " + std::to_string(static_cast<Index>(largest)) +
               ".");
      return static_cast<Index>(value);
    }

    void
    take_layout(Blocks &blocks, ContactSystem &system)
    {
      const auto found = blocks.find("tangents");
      if (found == blocks.end())
        refuse("the block 'tangents' is missing.");
      const Index    n        = found->second.rows();
      const VectorXd tangents = take(blocks, "tangents", n, 1, true);
      for (Index i = 0; i < n; ++i)
        system.first.push_back(system.first.back() + 1 +
                               whole(tangents(i), 2, "tangents"));
      system.n_motions = whole(take_scalar(blocks, "motions"), 1e6, "motions");
      if (system.n_motions > 0 && system.form == Form::stiffness)
        refuse("only the compliance form has motions.");
      for (Index j = 0; j < system.n_motions; ++j)
        system.first.push_back(system.first.back() + 1);
      system.mu = take(blocks, "friction", n, 1, true);
      if (system.mu.minCoeff() < 0)
        refuse("a friction coefficient is negative.");
    }

    std::shared_ptr<const ContactSystem>
    take_system(Blocks &blocks, const Form form)
    {
      auto system  = std::make_shared<ContactSystem>();
      system->form = form;
      take_layout(blocks, *system);
      const Index n     = system->n_unknowns();
      system->matrix    = take(blocks, "matrix", n, n, true);
      const auto  found = blocks.find("null_space");
      const Index k     = found == blocks.end() ? 0 : found->second.cols();
      system->null_space =
        take(blocks, "null_space", system->n_contact_unknowns(), k, false);
      return system;
    }
  } // namespace



  std::string
  to_problem_text(const StoredProblem &stored)
  {
    const ContactProblem &problem = stored.problem;
    const ContactSystem  &system  = *problem.system;
    VectorXd              tangents(system.n_nodes());
    for (Index i = 0; i < tangents.size(); ++i)
      tangents(i) = static_cast<double>(system.n_tangents(i));
    std::ostringstream out;
    // So many digits bring back every bit.
    out.precision(17);
    out << head << form_name(system.form) << '\n';
    write_block(out, "tangents", tangents);
    write_block(out, "motions", scalar(static_cast<double>(system.n_motions)));
    write_block(out, "friction", system.mu);
    write_block(out, "matrix", system.matrix);
    write_block(out, "null_space", system.null_space);
    write_block(out, "load", problem.load);
    write_block(out, "gap", problem.gap);
    write_block(out, "offset", problem.offset);
    write_block(out, "reference_force", scalar(problem.reference_force));
    write_block(out, "rate", stored.rate);
    if (stored.is_stage())
      write_block(out, "stage", Eigen::Vector2d(stored.begin, stored.end));
    write_block(out, "cohesion", stored.cohesion);
    return out.str();
  }



  StoredProblem
  read_problem_text(std::istream &text)
  {
    std::istringstream in     = without_comments(text);
    const Form         form   = read_form(in);
    Blocks             blocks = read_blocks(in);
    StoredProblem      stored;
    ContactProblem    &problem = stored.problem;
    problem.system             = take_system(blocks, form);
    const Index n              = problem.system->n_unknowns();
    const Index n_nodes        = problem.system->n_nodes();
    problem.load               = take(blocks, "load", n, 1, true);
    problem.gap                = take(blocks, "gap", n_nodes, 1, true);
    problem.offset             = take(blocks, "offset", n, 1, false);
    problem.reference_force    = take_scalar(blocks, "reference_force");
    stored.rate                = take(blocks, "rate", n, 1, false);
    if (const MatrixXd stage = take(blocks, "stage", 2, 1, stored.is_stage());
        stage.size() > 0)
      {
        stored.begin = stage(0, 0);
        stored.end   = stage(1, 0);
      }
    stored.cohesion = take(blocks, "cohesion", n_nodes, 1, false);
    if (!(stored.begin < stored.end))
      refuse("its stage does not end after its begin.");
    if (!blocks.empty())
      refuse("there is no block '" + blocks.begin()->first + "'.");
    return stored;
  }
} // namespace conetact::solvers
