// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_stages_h
#define conetact_application_stages_h

#include "conetact/application/run_settings.h"
#include "conetact/base/expression.h"

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace conetact::application
{
  /** Supports that are there in some increments of a scene only. */
  class Stages
  {
  public:
    Stages() = default;
    /** Throws InputError where they change and the method cannot. */
    Stages(dealii::ParameterHandler       &prm,
           const std::vector<std::string> &supports,
           const RunSettings              &settings);

    /** Whether supports may change in the course of the scene. */
    bool
    may_change() const;
    /** Which supports are active at time t. */
    std::vector<bool>
    active(const double t) const;
    /** Ends of the stages in which the same supports are active: the last of
     * these times, and those after which others are. */
    std::vector<double>
    ends(const std::vector<double> &times) const;
    /** Those of these times that are in the last stage. */
    std::vector<double>
    times_of_last(const std::vector<double> &times) const;

  private:
    std::vector<Expression> activity; ///< of each support, of t
  };
} // namespace conetact::application

#endif
