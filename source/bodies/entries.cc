// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/entries.h"

#include "conetact/base/errors.h"
#include "conetact/base/nearest.h"
#include "conetact/base/numbers.h"
#include "conetact/base/text.h"
#include "conetact/bodies/groups.h"

#include <algorithm>

namespace conetact::bodies
{
  unsigned int
  find_body(const std::string              &body,
            const std::vector<std::string> &bodies,
            const std::string              &entry)
  {
    const auto found = std::find(bodies.begin(), bodies.end(), body);
    if (found == bodies.end())
      throw InputError(
        entry + ": " +
        (body.empty() ? "it is empty" : "there is no body '" + body + "'") +
        ". Give one of: " + join(bodies) + "." + did_you_mean(body, bodies));
    return static_cast<unsigned int>(found - bodies.begin());
  }

  void
  refuse_given(const dealii::ParameterHandler &prm,
               const std::vector<std::string> &entries,
               const std::string              &in,
               const std::string              &why)
  {
    for (const std::string &entry : entries)
      if (!prm.get(entry).empty())
        throw InputError(in + entry + ": " + why);
  }

  BoundaryIds
  find_boundary(const std::string &text,
                const Structure   &structure,
                const std::string &body,
                const std::string &entry)
  {
    const auto       &groups = structure.boundary_groups();
    const BoundaryIds ids    = to_ids(text, groups, "a boundary id", entry);
    const BoundaryIds known  = structure.boundary_ids();
    for (const unsigned int id : ids)
      if (known.count(id) == 0)
        throw InputError(entry + ": body '" + body + "' has no boundary id " +
                         std::to_string(id) +
                         ". It has: " + join_names(known, groups) +
                         "; more are given by Boundary ids of its Mesh or "
                         "Frame.");
    return ids;
  }

  Tensor<1, 3>
  turn_axis(const std::string &text,
            const unsigned int dim,
            const std::string &in)
  {
    const std::string entry = in + "Turn axis";
    if (dim == 2)
      {
        const Tensor<1, 3> axis = to_vector(text, 3, entry);
        if (axis[0] != 0 || axis[1] != 0 || axis[2] <= 0)
          throw InputError(entry + ": in 2D everything turns about z, and '" +
                           text + "' is another axis. Remove the entry.");
        return Tensor<1, 3>({0., 0., 1.});
      }
    const Tensor<1, 3> axis = to_vector(text, 3, entry);
    if (axis.norm() == 0)
      throw InputError(entry + ": the vector " + text +
                       " has no length. Give a direction other than zero.");
    return axis / axis.norm();
  }

  std::vector<Expression>
  parse_components(const std::string &text,
                   const std::size_t  n,
                   const std::string &entry)
  {
    if (n > 1 && text.find(';') == text.npos && split(text, ',').size() > 1)
      throw InputError(entry + ": '" + text + "' has commas. Separate the " +
                       std::to_string(n) + " expressions by ';'.");
    std::vector<Expression> expressions = parse_expressions(text, entry);
    if (expressions.size() == 1 && expressions[0].is_zero())
      while (expressions.size() < n)
        expressions.push_back(Expression("0", entry));
    if (expressions.size() != n)
      throw InputError(entry + ": '" + text + "' has " +
                       std::to_string(expressions.size()) +
                       (expressions.size() == 1 ? " expression. Give " :
                                                  " expressions. Give ") +
                       std::to_string(n) + ", separated by ';'.");
    return expressions;
  }

  std::optional<Expression>
  read_active(const dealii::ParameterHandler &prm,
              const std::string              &in,
              const std::string              &instead)
  {
    Expression active(prm.get("Active"), in + "Active");
    if (active.uses_space())
      throw InputError(in + "Active: it depends on the place. Use t only" +
                       instead + ".");
    if (!active.uses_time() && active(Point<3>()) != 0)
      return {};
    return active;
  }
} // namespace conetact::bodies
