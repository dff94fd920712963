// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_scene_objects_h
#define conetact_application_scene_objects_h

#include "conetact/bodies/loads.h"
#include "conetact/model/bodies.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/obstacles.h"

#include <vector>

namespace conetact::application
{
  /** What a scene is made of. */
  struct SceneObjects
  {
    model::Bodies                  bodies; ///< with supports, contact nodes
    std::vector<pairing::Obstacle> obstacles;
    std::vector<pairing::Contact>  contacts;
    std::vector<bodies::Load>      loads;
  };
} // namespace conetact::application

#endif
