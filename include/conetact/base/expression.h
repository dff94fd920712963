// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_expression_h
#define conetact_base_expression_h

#include "conetact/base/expression_bounds.h"

#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace conetact
{
  /**
   * A function of position and time that a user wrote: muParser's syntax with
   * the variables x, y, z (undeformed position) and t (time), the constant pi,
   * if(condition, a, b), and table(x; x0 : y0; x1 : y1; ...), which is linear
   * from point to point and constant beyond.
   */
  class Expression
  {
  public:
    /**
     * `entry` is named in messages, e.g. "Load 'wind', Value"; `others` are the
     * names of further variables. Throws InputError if the text does not parse.
     */
    Expression(const std::string              &text,
               const std::string              &entry,
               const std::vector<std::string> &others = {});

    /** Throws InputError if the value is not finite. */
    double
    operator()(const dealii::Point<3> &p, const double t = 0) const;
    /** With values of the further variables. */
    double
    operator()(const dealii::Point<3>    &p,
               const double               t,
               const std::vector<double> &others) const;

    bool
    uses_time() const;
    bool
    uses_space() const;
    /** Whether values depend on the further variable of that name: on v, those
     * of 0.3 + 0*v do not. */
    bool
    uses(const std::string &other) const;
    /** Of values at a point and a time, while further variables are anywhere in
     * bounds of theirs. */
    Bounds
    bounds(const dealii::Point<3>    &p,
           const double               t,
           const std::vector<Bounds> &others) const;
    /** Whether the value is the same at all points and times. */
    bool
    is_constant() const;
    /** The text is a constant zero. */
    bool
    is_zero() const;

  private:
    struct Parser;
    std::shared_ptr<Parser> parser; ///< copies share it
  };

  /** Several expressions, separated by ';'. */
  std::vector<Expression>
  parse_expressions(const std::string &text, const std::string &entry);
} // namespace conetact

#endif
