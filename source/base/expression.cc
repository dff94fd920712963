// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/expression.h"

#include "conetact/base/errors.h"
#include "conetact/base/nearest.h"
#include "conetact/base/text.h"

#include <deal.II/base/exceptions.h>

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace conetact
{
  struct Expression::Parser
  {
    std::string text;
    std::string entry;
    double      x = 0, y = 0, z = 0, t = 0;
    mu::Parser  mu;
    bool        uses_space = false;
    bool        uses_time  = false;

    std::vector<std::string> names;  ///< of further variables
    std::vector<double>      others; ///< their values
    std::set<std::string>    used;   ///< those that values depend on
  };

  namespace
  {
    /** Squares of what is larger, and stiffnesses times it, may overflow. */
    constexpr double largest_value = 1e100;

    double
    choose(const double condition, const double yes, const double no)
    {
      return condition != 0 ? yes : no;
    }

    /** Whether a comma stands between two digits. */
    bool
    has_decimal_comma(const std::string &text)
    {
      const auto is_digit = [&](const std::size_t i) {
        return i < text.size() &&
               std::isdigit(static_cast<unsigned char>(text[i])) != 0;
      };
      for (std::size_t i = 1; i < text.size(); ++i)
        if (text[i] == ',' && is_digit(i - 1) && is_digit(i + 1))
          return true;
      return false;
    }

    /** Whether a single equals sign stands there, which would assign. */
    bool
    assigns(const std::string &text)
    {
      for (std::size_t i = text.find('='); i != text.npos;
           i             = text.find('=', i + 1))
        if (i + 1 < text.size() && text[i + 1] == '=')
          ++i;
        else if (i == 0 ||
                 std::string("<>!").find(text[i - 1]) == std::string::npos)
          return true;
      return false;
    }

    /** x, then x0, y0, x1, y1, ...: linear from point to point. */
    double
    interpolate(const double *values, const int n)
    {
      if (n < 3 || n % 2 == 0)
        throw mu::ParserError("table() takes a variable and points x : y");
      for (int i = 3; i < n; i += 2)
        if (!(values[i] > values[i - 2]))
          throw mu::ParserError("the points of table() do not ascend");
      const double x = values[0];
      int          i = 1;
      while (i + 2 < n && x > values[i + 2])
        i += 2;
      if (x <= values[1] || i + 2 >= n)
        return values[x <= values[1] ? 2 : n - 1];
      return values[i + 1] + (x - values[i]) / (values[i + 2] - values[i]) *
                               (values[i + 3] - values[i + 1]);
    }

    /** Where the bracket that is open at `begin` closes; the end: nowhere. */
    std::size_t
    closing(const std::string &text, const std::size_t begin)
    {
      int         depth = 1;
      std::size_t i     = begin;
      for (; i < text.size() && depth > 0; ++i)
        depth += (text[i] == '(' ? 1 : 0) - (text[i] == ')' ? 1 : 0);
      return i;
    }

    /** Points of tables become arguments: ';' and ':' are commas there. */
    std::string
    with_tables_as_functions(std::string text)
    {
      const std::string name = "table(";
      for (std::size_t i = text.find(name); i != text.npos;
           i             = text.find(name, i + 1))
        {
                      const std::size_t begin = i + name.size();
                      const std::size_t end   = closing(text, begin);
                      for (std::size_t k = begin; k < end; ++k)
            if (text[k] == ';' || text[k] == ':')
              text[k] = ',';
        }
      return text;
    }

    /** A name in front of a bracket that is none of these; empty: there is
     * none. */
    std::string
    unknown_function(const std::string              &text,
                     const std::vector<std::string> &functions)
    {
      const auto is_letter = [&](const std::size_t i) {
        return std::isalnum(static_cast<unsigned char>(text[i])) != 0 ||
               text[i] == '_';
      };
      for (std::size_t i = text.find('('); i != text.npos;
           i             = text.find('(', i + 1))
        {
                      std::size_t begin = i, end = i;
                      while (end > 0 && text[end - 1] == ' ')
            --end;
          for (begin = end; begin > 0 && is_letter(begin - 1);)
            --begin;
          const std::string name = text.substr(begin, end - begin);
                      if (!name.empty() &&
              std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
              std::count(functions.begin(), functions.end(), name) == 0)
            return name;
        }
      return {};
    }

    [[noreturn]] void
    fail(const std::string              &entry,
         const std::string              &text,
         const std::string              &why,
         const std::vector<std::string> &others = {})
    {
      if (has_decimal_comma(text))
        throw InputError(entry + ": '" + text +
                         "' is not one expression: it has a comma. Decimals "
                         "have a point; expressions are separated by ';'.");
      const std::string reason =
        !why.empty() && why.back() == '.' ? why.substr(0, why.size() - 1) : why;
      throw InputError(entry + ": '" + text +
                       "' is not an expression in x, y, z, t (" + reason +
                       "). Check names, brackets and operators; powers are "
                       "written x^2." +
                       (others.empty() ? "" :
                                         " Variables here are " +
                                           join(others, ", ") + ", too."));
    }
  } // namespace

  namespace
  {
    /** Throws InputError where the text calls a function that is not there. */
    void
    refuse_unknown_functions(const std::string              &text,
                             const std::string              &entry,
                             const mu::Parser               &parser,
                             const std::vector<std::string> &variables)
    {
      std::vector<std::string> functions;
      for (const auto &[function, call] : parser.GetFunDef())
        functions.push_back(function);
      std::vector<std::string> known = functions;
      known.insert(known.end(), variables.begin(), variables.end());
      const std::string name = unknown_function(text, known);
      if (name.empty())
        return;
      // letters are forgotten within a word rather than at its begin
      std::vector<std::string> alike;
      for (const std::string &function : functions)
        if (function[0] == name[0])
          alike.push_back(function);
      std::string other = did_you_mean(name, alike);
      if (other.empty())
        other = did_you_mean(name, functions);
      throw InputError(
        entry + ": '" + text + "': there is no function '" + name + "'." +
        (other.empty() ? " There are " + join(functions) + "." : other));
    }
  } // namespace

  namespace
  {
    std::set<std::string>
    others_in(const std::vector<std::string> &others,
              const std::set<std::string>    &names)
    {
      std::set<std::string> found;
      for (const std::string &name : others)
        if (names.count(name) > 0)
          found.insert(name);
      return found;
    }
  } // namespace

  Expression::Expression(const std::string              &text,
                         const std::string              &entry,
                         const std::vector<std::string> &others)
    : parser(std::make_shared<Parser>())
  {
    Parser &p = *parser;
    p.text    = trim(text);
    p.entry   = entry;
    p.names   = others;
    p.others.resize(others.size());
    if (p.text.empty())
      throw InputError(entry + ": an expression is missing. Give a number or " +
                       "a function of x, y, z, t.");
    if (assigns(p.text))
      fail(entry, p.text, "a single '=' compares nothing, write '=='");
    try
      {
        p.mu.DefineVar("x", &p.x);
        p.mu.DefineVar("y", &p.y);
        p.mu.DefineVar("z", &p.z);
        p.mu.DefineVar("t", &p.t);
        for (std::size_t i = 0; i < others.size(); ++i)
          p.mu.DefineVar(others[i], &p.others[i]);
        p.mu.DefineConst("pi", M_PI);
        p.mu.DefineFun("table", interpolate);
        p.mu.DefineFun("if", choose);
        p.mu.DefineFun("floor", static_cast<double (*)(double)>(std::floor));
        p.mu.DefineFun("ceil", static_cast<double (*)(double)>(std::ceil));
        p.mu.DefineFun("pow",
                       static_cast<double (*)(double, double)>(std::pow));
        std::vector<std::string> variables = {"x", "y", "z", "t", "pi"};
        variables.insert(variables.end(), others.begin(), others.end());
        refuse_unknown_functions(p.text, entry, p.mu, variables);
        p.mu.SetExpr(with_tables_as_functions(p.text));
        for (const auto &[name, address] : p.mu.GetUsedVar())
          {
            (void)address;
            if (std::count(others.begin(), others.end(), name) == 0)
              (name == "t" ? p.uses_time : p.uses_space) = true;
          }
        // That list has names, too, that nothing defines, and only this call
        // asks for them: the next one takes what the list was made of.
        p.mu.Eval();
        int n_values = 0;
        p.mu.Eval(n_values);
        if (n_values != 1)
          fail(entry, p.text, "one value is expected");
        std::map<std::string, Bounds> anywhere;
        for (const auto &[name, address] : p.mu.GetVar())
          anywhere[name] = {};
        p.used = others_in(others, bounds_of(p.text, anywhere).names);
      }
    catch (const mu::Parser::exception_type &error)
      {
        fail(entry, p.text, one_line(error.GetMsg()), others);
      }
  }

  Bounds
  Expression::bounds(const dealii::Point<3>    &point,
                     const double               t,
                     const std::vector<Bounds> &others) const
  {
    AssertDimension(others.size(), parser->names.size());
    std::map<std::string, Bounds> variables = {
      {"x", {point[0], point[0]}},
      {"y", {point[1], point[1]}},
      {"z", {point[2], point[2]}},
      {"t", {t, t}},
    };
    for (std::size_t i = 0; i < others.size(); ++i)
      variables[parser->names[i]] = others[i];
    return bounds_of(parser->text, variables).values;
  }

  double
  Expression::operator()(const dealii::Point<3> &point, const double t) const
  {
    return (*this)(point, t, std::vector<double>(parser->names.size(), 0.));
  }

  double
  Expression::operator()(const dealii::Point<3>    &point,
                         const double               t,
                         const std::vector<double> &others) const
  {
    AssertDimension(others.size(), parser->names.size());
    Parser &p = *parser;
    // muParser knows the places of these numbers: they stay where they are.
    std::copy(others.begin(), others.end(), p.others.begin());
    p.x          = point[0];
    p.y          = point[1];
    p.z          = point[2];
    p.t          = t;
    double value = NAN;
    try
      {
        value = p.mu.Eval();
      }
    catch (const mu::Parser::exception_type &error)
      {
        fail(p.entry, p.text, one_line(error.GetMsg()), p.names);
      }
    if (!std::isfinite(value))
      throw InputError(p.entry + ": '" + p.text + "' is not finite at " +
                       to_text(point) + ", t = " + to_text(t) +
                       ". Change the expression so that it is defined there.");
    if (std::abs(value) > largest_value)
      throw InputError(p.entry + ": '" + p.text + "' is " + to_text(value) +
                       (p.uses_space || p.uses_time ?
                          " at " + to_text(point) + ", t = " + to_text(t) :
                          "") +
                       ", too large to compute with. Choose other units.");
    return value;
  }

  bool
  Expression::uses_time() const
  {
    return parser->uses_time;
  }

  bool
  Expression::uses_space() const
  {
    return parser->uses_space;
  }

  bool
  Expression::uses(const std::string &other) const
  {
    return parser->used.count(other) > 0;
  }

  bool
  Expression::is_constant() const
  {
    return !parser->uses_time && !parser->uses_space && parser->used.empty();
  }

  bool
  Expression::is_zero() const
  {
    return is_constant() && (*this)(dealii::Point<3>()) == 0;
  }

  std::vector<Expression>
  parse_expressions(const std::string &text, const std::string &entry)
  {
    std::vector<Expression> expressions;
    for (const std::string &part : split(text, ';'))
      expressions.emplace_back(part, entry);
    return expressions;
  }
} // namespace conetact
