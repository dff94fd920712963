// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/application/adaptive_settings.h"

#include "conetact/base/errors.h"

#include <algorithm>

namespace conetact::application
{
  void
  declare_adaptive(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Adaptive refinement",
                      "0",
                      Integer(0, 12),
                      "How many times the whole history is run again on a "
                      "mesh that is refined where the last increment has "
                      "the largest errors, as the jumps of the displacement "
                      "gradients between cells tell (Kelly's estimator). "
                      "Results are those of the last mesh; refinement.csv "
                      "has a row for each. [-]");
    prm.declare_entry("Adaptive fraction",
                      "0.3",
                      Double(0.001, 1),
                      "Part of the cells of all bodies that each Adaptive "
                      "refinement divides in 4 (2D) or 8 (3D). [-]");
  }

  AdaptiveSettings
  create_adaptive(const dealii::ParameterHandler &prm)
  {
    AdaptiveSettings settings;
    settings.cycles =
      static_cast<unsigned int>(prm.get_integer("Adaptive refinement"));
    settings.fraction = prm.get_double("Adaptive fraction");
    return settings;
  }

  void
  check_adaptive(const AdaptiveSettings                       &settings,
                 const std::vector<const bodies::Structure *> &bodies)
  {
    if (settings.cycles > 0 &&
        std::all_of(bodies.begin(),
                    bodies.end(),
                    [](const bodies::Structure *body) {
                      return body->elements().count().elements == 0;
                    }))
      throw InputError("Adaptive refinement: no body has a mesh to refine, "
                       "frames keep their members. Set it to 0.");
    if (settings.cycles > 0 && std::none_of(bodies.begin(),
                                            bodies.end(),
                                            [](const bodies::Structure *body) {
                                              return body->can_be_refined();
                                            }))
      throw InputError("Adaptive refinement: no body has cells that can be "
                       "divided one by one, triangles and tetrahedra are "
                       "refined everywhere only. Set it to 0 and use Global "
                       "refinements, or use quadrilaterals or hexahedra.");
  }
} // namespace conetact::application
