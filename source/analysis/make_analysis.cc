// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/make_analysis.h"

#include "conetact/analysis/increment_analysis.h"
#include "conetact/analysis/path_analysis.h"

namespace conetact::analysis
{
  std::unique_ptr<Analysis>
  make_analysis(const application::Scene &scene, Log &log)
  {
    if (!scene.path.follows)
      return std::make_unique<IncrementAnalysis>(scene, log);
    return std::make_unique<PathAnalysis>(scene, log);
  }
} // namespace conetact::analysis
