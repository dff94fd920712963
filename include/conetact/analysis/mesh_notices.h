// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_mesh_notices_h
#define conetact_analysis_mesh_notices_h

#include "conetact/application/scene.h"
#include "conetact/base/log.h"

namespace conetact::analysis
{
  /**
   * Warns of nodes of a body that are at one place and are not joined, unless
   * a contact of the body with itself is between them.
   */
  void
  say_doubled_nodes(const application::Scene &scene, Log &log);
  /** Warns of bodies that stay as they are where meshes are refined. */
  void
  say_what_is_not_refined(const application::Scene &scene, Log &log);
} // namespace conetact::analysis

#endif
