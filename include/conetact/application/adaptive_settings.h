// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_adaptive_settings_h
#define conetact_application_adaptive_settings_h

#include "conetact/bodies/structure.h"

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace conetact::application
{
  /** How a scene is refined where its errors are large. */
  struct AdaptiveSettings
  {
    unsigned int cycles   = 0;  ///< meshes after the scene's own one
    double       fraction = .3; ///< of all cells, divided in each cycle
  };

  /** Entries at the top level. */
  void
  declare_adaptive(dealii::ParameterHandler &prm);
  AdaptiveSettings
  create_adaptive(const dealii::ParameterHandler &prm);

  /** Throws InputError where there is nothing to refine. */
  void
  check_adaptive(const AdaptiveSettings                       &settings,
                 const std::vector<const bodies::Structure *> &bodies);
} // namespace conetact::application

#endif
