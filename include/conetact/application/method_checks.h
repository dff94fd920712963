// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_method_checks_h
#define conetact_application_method_checks_h

#include "conetact/application/run_settings.h"
#include "conetact/application/scene_objects.h"

namespace conetact::application
{
  /**
   * Throws InputError where the solver's method does not know a law of a
   * contact. Friction that changes is one of increments, whose parts have no
   * speed: they are not divided then.
   */
  void
  settle_friction(const SceneObjects &scene, RunSettings &settings);

  /** Throws InputError where a load path does not know something, or where
   * something is one of load paths. */
  void
  check_path(const SceneObjects &scene, const RunSettings &settings);

  /**
   * Throws InputError where a load or a motion is not linear in t between
   * t = 0 and the first time, or from one time to the next.
   */
  void
  check_linear_stages(const SceneObjects        &scene,
                      const std::vector<double> &times);

  /** Whether Solver/Method = load path would take the scene, if it is run from
   * its start with the same supports all along. */
  bool
  may_follow_path(const SceneObjects &scene, const RunSettings &settings);

  /** Throws InputError where bodies are turned that cannot be. */
  void
  check_turning_supports(const SceneObjects &scene,
                         const RunSettings  &settings);

  /** Throws InputError where the force of a preload has no increment. */
  void
  check_preloads(const SceneObjects &scene, const std::vector<double> &times);
} // namespace conetact::application

#endif
