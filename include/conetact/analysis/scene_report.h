// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_scene_report_h
#define conetact_analysis_scene_report_h

#include "conetact/analysis/backend_table.h"
#include "conetact/application/scene.h"
#include "conetact/base/log.h"
#include "conetact/contact/contact_model.h"

namespace conetact::analysis
{
  /** Sizes and what will be skipped, to the log. */
  void
  report_sizes(const application::Scene    &scene,
               const contact::ContactModel &model,
               Log                         &log);

  /**
   * Area, shape and place of the faces that each boundary id of each body has,
   * to the log: drawings number their faces themselves.
   */
  void
  report_boundaries(const model::Bodies &bodies, Log &log);

  /** What each body is, and its boundaries: of a scene that is refused. */
  void
  report_meshes(const model::Bodies &bodies, Log &log);

  /**
   * Sums of the nodal forces of each load, as far as they are known, to the
   * log: what is meant for one node may act on several.
   */
  void
  report_loads(const bodies::NodalLoads &loads, Log &log);

  /** Memory and time it will take, to the log; nothing is factorised. */
  void
  report_cost(const application::Scene    &scene,
              const contact::ContactModel &model,
              const Backend               &backend,
              Log                         &log);

  /** That `n_shared` bodies equal others and are not condensed. */
  void
  report_shared_bodies(const model::Bodies &bodies,
                       const unsigned int   n_shared,
                       Log                 &log);

  /** What the increments were spared, to the log. */
  void
  report_skips(const application::Scene &scene,
               contact::ContactModel    &model,
               const bodies::NodalLoads &loads,
               Log                      &log);
} // namespace conetact::analysis

#endif
