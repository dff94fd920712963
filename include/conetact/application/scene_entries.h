// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_entries_h
#define conetact_application_scene_entries_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace conetact::application
{
  /** The lists that a scene begins with: each name has its subsection. */
  struct SceneNames
  {
    std::vector<std::string> bodies, obstacles, contacts, supports, loads;
  };

  /** The lists alone, which are read before anything else. */
  void
  declare_lists(dealii::ParameterHandler &prm);

  /** Every entry of a scene with these names. */
  void
  declare_scene(dealii::ParameterHandler &prm, const SceneNames &names);
} // namespace conetact::application

#endif
