// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_compare_runs_h
#define conetact_application_compare_runs_h

#include "conetact/application/command_line.h"

#include <string>

namespace conetact::application
{
  /** What `conetact compare` says. */
  struct RunComparison
  {
    std::string text;
    bool        are_equal = false;
  };

  /**
   * Compares the results in two folders. Residuals and balances are bounded by
   * the larger Solver/Tolerance of both runs. Throws InputError.
   */
  RunComparison
  compare_runs(const CommandLine &line);
} // namespace conetact::application

#endif
