// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_make_analysis_h
#define conetact_analysis_make_analysis_h

#include "conetact/analysis/analysis.h"

namespace conetact::analysis
{
  /** The analysis that the scene's Solver/Method asks for. */
  std::unique_ptr<Analysis>
  make_analysis(const application::Scene &scene, Log &log);
} // namespace conetact::analysis

#endif
