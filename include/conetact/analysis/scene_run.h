// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_scene_run_h
#define conetact_analysis_scene_run_h

#include "conetact/application/command_line.h"

namespace conetact::analysis
{
  /**
   * Runs a scene, or tells of it what the line asks for. Throws InputError,
   * AnalysisError, WriteError, Interrupted, and EndedByOther in one of many
   * processes.
   */
  void
  run_scene(const application::CommandLine &line);
} // namespace conetact::analysis

#endif
