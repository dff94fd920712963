// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/expression_bounds.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace conetact
{
  namespace
  {
    using Part = ExpressionBounds;

    /** What this arithmetic does not know. */
    struct NotUnderstood
    {};

    Bounds
    around(const std::initializer_list<double> values)
    {
      for (const double value : values)
        if (std::isnan(value))
          return {};
      return {std::min(values), std::max(values)};
    }

    /** Parts that have one value depend on nothing. */
    Part
    made_of(const Bounds &values, const std::vector<Part> &parts)
    {
      Part result{values, {}};
      if (std::isnan(values.low) || std::isnan(values.high))
        result.values = {};
      if (!result.values.is_point())
        for (const Part &part : parts)
          result.names.insert(part.names.begin(), part.names.end());
      return result;
    }

    /** Zero times what is never infinite, but has no bound. */
    double
    times(const double a, const double b)
    {
      return a == 0 || b == 0 ? 0. : a * b;
    }

    Bounds
    product(const Bounds &a, const Bounds &b)
    {
      return around({times(a.low, b.low),
                     times(a.low, b.high),
                     times(a.high, b.low),
                     times(a.high, b.high)});
    }

    Bounds
    inverse(const Bounds &a)
    {
      if (a.low < 0 && a.high > 0)
        return {};
      if (a.low == 0 && a.high == 0)
        return {};
      constexpr double far = std::numeric_limits<double>::infinity();
      return {a.high == 0 ? -far : 1 / a.high, a.low == 0 ? far : 1 / a.low};
    }

    Bounds
    power(const Bounds &a, const Bounds &b)
    {
      if (a.is_point() && b.is_point())
        return around({std::pow(a.low, b.low)});
      if (a.low >= 0) // monotone in each of both
        return around({std::pow(a.low, b.low),
                       std::pow(a.low, b.high),
                       std::pow(a.high, b.low),
                       std::pow(a.high, b.high)});
      if (!b.is_point() || b.low != 2)
        return {};
      const double most = std::max(a.low * a.low, a.high * a.high);
      return {a.high > 0 ? 0 : a.high * a.high, most};
    }

    /** Functions that rise all the way. */
    const std::map<std::string, double (*)(double)> &
    rising_functions()
    {
      static const std::map<std::string, double (*)(double)> functions = {
        {"exp", [](const double x) { return std::exp(x); }},
        {"sqrt", [](const double x) { return std::sqrt(std::max(x, 0.)); }},
        {"ln", [](const double x) { return std::log(std::max(x, 0.)); }},
        {"log", [](const double x) { return std::log(std::max(x, 0.)); }},
        {"log10", [](const double x) { return std::log10(std::max(x, 0.)); }},
        {"atan", [](const double x) { return std::atan(x); }},
        {"tanh", [](const double x) { return std::tanh(x); }},
        {"floor", [](const double x) { return std::floor(x); }},
        {"ceil", [](const double x) { return std::ceil(x); }},
      };
      return functions;
    }

    Bounds
    hull(const std::vector<Part>::const_iterator begin,
         const std::vector<Part>::const_iterator end)
    {
      Bounds all = begin->values;
      for (auto part = begin; part != end; ++part)
        all = {std::min(all.low, part->values.low),
               std::max(all.high, part->values.high)};
      return all;
    }

    Part
    choice(const std::vector<Part> &parts)
    {
      const Bounds &condition = parts.at(0).values;
      if (condition.is_point())
        return parts.at(condition.low != 0 ? 1 : 2);
      return made_of(hull(parts.begin() + 1, parts.end()), parts);
    }

    Bounds
    extreme(const std::vector<Part> &parts, const bool is_least)
    {
      Bounds result = parts.at(0).values;
      for (const Part &part : parts)
        result = is_least ? Bounds{std::min(result.low, part.values.low),
                                   std::min(result.high, part.values.high)} :
                            Bounds{std::max(result.low, part.values.low),
                                   std::max(result.high, part.values.high)};
      return result;
    }

    Bounds
    magnitude(const Bounds &a)
    {
      const double most = std::max(-a.low, a.high);
      if (a.low <= 0 && a.high >= 0)
        return {0, most};
      return {std::min(std::abs(a.low), std::abs(a.high)), most};
    }

    /** Linear from point to point, constant beyond. */
    double
    table_at(const double x, const std::vector<Part> &parts)
    {
      const auto number = [&](const std::size_t k) {
        return parts.at(k).values.low;
      };
      std::size_t i = 1;
      while (i + 2 < parts.size() && x > number(i + 2))
        i += 2;
      if (x <= number(1))
        return number(2);
      if (i + 2 >= parts.size())
        return number(parts.size() - 1);
      return number(i + 1) + (x - number(i)) / (number(i + 2) - number(i)) *
                               (number(i + 3) - number(i + 1));
    }

    /** Its extremes are at the ends of the variable's bounds or at points. */
    Bounds
    table(const std::vector<Part> &parts)
    {
      for (std::size_t i = 1; i < parts.size(); ++i)
        if (!parts[i].values.is_point())
          throw NotUnderstood();
      const Bounds &x = parts[0].values;
      Bounds all = around({table_at(x.low, parts), table_at(x.high, parts)});
      for (std::size_t i = 1; i + 1 < parts.size(); i += 2)
        if (parts[i].values.low > x.low && parts[i].values.low < x.high)
          all = around({all.low, all.high, parts[i + 1].values.low});
      return all;
    }

    Part
    call(const std::string &name, const std::vector<Part> &parts)
    {
      if (parts.empty())
        throw NotUnderstood();
      const Bounds &x = parts[0].values;
      if (const auto rising = rising_functions().find(name);
          rising != rising_functions().end() && parts.size() == 1)
        return made_of(around({rising->second(x.low), rising->second(x.high)}),
                       parts);
      if (name == "if" && parts.size() == 3)
        return choice(parts);
      if (name == "min" || name == "max")
        return made_of(extreme(parts, name == "min"), parts);
      if (name == "abs" && parts.size() == 1)
        return made_of(magnitude(x), parts);
      if (name == "pow" && parts.size() == 2)
        return made_of(power(x, parts[1].values), parts);
      if ((name == "sin" || name == "cos") && parts.size() == 1)
        return made_of({-1, 1}, parts);
      if (name == "table" && parts.size() % 2 == 1 && parts.size() > 2)
        return made_of(table(parts), parts);
      throw NotUnderstood();
    }

    /** Of a comparison: 1 always, 0 never, either. */
    Bounds
    truth(const bool always, const bool never)
    {
      return always ? Bounds{1, 1} : never ? Bounds{0, 0} : Bounds{0, 1};
    }

    Bounds
    compare(const std::string &sign, const Bounds &a, const Bounds &b)
    {
      if (sign == "<")
        return truth(a.high < b.low, a.low >= b.high);
      if (sign == "<=")
        return truth(a.high <= b.low, a.low > b.high);
      if (sign == ">" || sign == ">=")
        return compare(sign == ">" ? "<" : "<=", b, a);
      const bool same  = a.is_point() && b.is_point() && a.low == b.low;
      const bool apart = a.high < b.low || b.high < a.low;
      return sign == "==" ? truth(same, apart) : truth(apart, same);
    }

    /** Reads what muParser reads, from the weakest operators to the strongest.
     */
    class BoundsReader
    {
    public:
      BoundsReader(const std::string                   &expression,
                   const std::map<std::string, Bounds> &given)
        : text(expression)
        , variables(given)
      {}

      Part
      read()
      {
        Part all = conditional();
        skip();
        if (at != text.size())
          throw NotUnderstood();
        return all;
      }

    private:
      void
      skip()
      {
        while (at < text.size() &&
               std::isspace(static_cast<unsigned char>(text[at])) != 0)
          ++at;
      }

      bool
      takes(const std::string &sign)
      {
        skip();
        if (text.compare(at, sign.size(), sign) != 0)
          return false;
        at += sign.size();
        return true;
      }

      void
      must_take(const std::string &sign)
      {
        if (!takes(sign))
          throw NotUnderstood();
      }

      Part
      conditional()
      {
        const Part condition = comparison();
        // not in what muParser reads otherwise than it looks
        if (takes("&&") || takes("||"))
          throw NotUnderstood();
        if (!takes("?"))
          return condition;
        const Part yes = conditional();
        must_take(":");
        return choice({condition, yes, conditional()});
      }

      Part
      comparison()
      {
        Part left = sum();
        for (const char *sign : {"<=", ">=", "==", "!=", "<", ">"})
          if (takes(sign))
            {
              const Part right = sum();
              left = made_of(compare(sign, left.values, right.values),
                             {left, right});
              break;
            }
        return left;
      }

      Part
      sum()
      {
        Part left = product_of();
        for (;;)
          if (takes("+"))
            left = plus(left, product_of(), 1);
          else if (takes("-"))
            left = plus(left, product_of(), -1);
          else
            return left;
      }

      static Part
      plus(const Part &left, const Part &right, const double sign)
      {
        const Bounds other = product({sign, sign}, right.values);
        return made_of({left.values.low + other.low,
                        left.values.high + other.high},
                       {left, right});
      }

      Part
      product_of()
      {
        Part left = factor();
        for (;;)
          if (takes("*"))
            {
              const Part right = factor();
              left = made_of(product(left.values, right.values), {left, right});
            }
          else if (takes("/"))
            {
              const Part right = factor();
              left = made_of(product(left.values, inverse(right.values)),
                             {left, right});
            }
          else
            return left;
      }

      /** A sign is weaker than a power. */
      Part
      factor()
      {
        if (takes("-"))
          {
            const Part part = factor();
            return made_of(product({-1, -1}, part.values), {part});
          }
        if (takes("+"))
          return factor();
        const Part base = primary();
        if (!takes("^"))
          return base;
        const Part exponent = factor();
        return made_of(power(base.values, exponent.values), {base, exponent});
      }

      Part
      primary()
      {
        skip();
        if (takes("("))
          {
            Part whole = conditional();
            must_take(")");
            return whole;
          }
        const char first = at < text.size() ? text[at] : '\0';
        return is_letter(first) ? named() : number();
      }

      Part
      number()
      {
        char        *end   = nullptr;
        const char  *begin = text.c_str() + at;
        const double value = std::strtod(begin, &end);
        if (end == begin)
          throw NotUnderstood();
        at += static_cast<std::size_t>(end - begin);
        return {{value, value}, {}};
      }

      Part
      named()
      {
        const std::size_t begin = at;
        while (at < text.size() &&
               (is_letter(text[at]) ||
                std::isdigit(static_cast<unsigned char>(text[at])) != 0))
          ++at;
        const std::string name = text.substr(begin, at - begin);
        if (takes("("))
          return call(name, arguments());
        if (name == "pi")
          return {{M_PI, M_PI}, {}};
        const auto variable = variables.find(name);
        if (variable == variables.end())
          throw NotUnderstood();
        const Part self{variable->second, {name}};
        return made_of(self.values, {self});
      }

      /** With those of tables, which have other signs between them. */
      std::vector<Part>
      arguments()
      {
        std::vector<Part> parts;
        do
          parts.push_back(conditional());
        while (takes(",") || takes(";") || takes(":"));
        must_take(")");
        return parts;
      }

      static bool
      is_letter(const char c)
      {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
      }

      const std::string                   &text;
      const std::map<std::string, Bounds> &variables;
      std::size_t                          at = 0;
    };
  } // namespace



  ExpressionBounds
  bounds_of(const std::string                   &text,
            const std::map<std::string, Bounds> &variables)
  {
    try
      {
        return BoundsReader(text, variables).read();
      }
    catch (const NotUnderstood &)
      {
        ExpressionBounds all;
        for (const auto &[name, bounds] : variables)
          all.names.insert(name);
        return all;
      }
  }
} // namespace conetact
