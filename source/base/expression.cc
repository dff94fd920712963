// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/expression.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"

#include <muParser.h>

#include <cctype>
#include <cmath>

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

    [[noreturn]] void
    fail(const std::string &entry,
         const std::string &text,
         const std::string &why)
    {
      if (has_decimal_comma(text))
        throw InputError(entry + ": '" + text +
                         "' is not one expression: it has a comma. Decimals "
                         "have a point; expressions are separated by ';'.");
      const std::string reason =
        !why.empty() && why.back() == '.' ? why.substr(0, why.size() - 1) : why;
      throw InputError(entry + ": '" + text + "' is not an expression in " +
                       "x, y, z, t (" + reason +
                       "). Check names, brackets and " +
                       "operators; powers are written x^2.");
    }
  } // namespace

  Expression::Expression(const std::string &text, const std::string &entry)
    : parser(std::make_shared<Parser>())
  {
    Parser &p = *parser;
    p.text    = trim(text);
    p.entry   = entry;
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
        p.mu.DefineConst("pi", M_PI);
        p.mu.DefineFun("if", choose);
        p.mu.DefineFun("floor", static_cast<double (*)(double)>(std::floor));
        p.mu.DefineFun("ceil", static_cast<double (*)(double)>(std::ceil));
        p.mu.DefineFun("pow",
                       static_cast<double (*)(double, double)>(std::pow));
        p.mu.SetExpr(p.text);
        for (const auto &[name, address] : p.mu.GetUsedVar())
          {
            (void)address;
            (name == "t" ? p.uses_time : p.uses_space) = true;
          }
        // That list has names, too, that nothing defines, and only this call
        // asks for them: the next one takes what the list was made of.
        p.mu.Eval();
        int n_values = 0;
        p.mu.Eval(n_values);
        if (n_values != 1)
          fail(entry, p.text, "one value is expected");
      }
    catch (const mu::Parser::exception_type &error)
      {
        fail(entry, p.text, one_line(error.GetMsg()));
      }
  }

  double
  Expression::operator()(const dealii::Point<3> &point, const double t) const
  {
    Parser &p    = *parser;
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
        fail(p.entry, p.text, one_line(error.GetMsg()));
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
  Expression::is_constant() const
  {
    return !parser->uses_time && !parser->uses_space;
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
