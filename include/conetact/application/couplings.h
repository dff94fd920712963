// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_couplings_h
#define conetact_application_couplings_h

#include "conetact/bodies/loads.h"
#include "conetact/bodies/supports.h"
#include "conetact/pairing/contact_nodes.h"

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace conetact::application
{
  /**
   * Faces of a body that move as one with a point, where loads act: an obstacle
   * that is free and tied to them. Both are written as a scene would have them.
   */
  struct Coupling
  {
    std::string              name; ///< of both, after the first load
    std::vector<std::size_t> loads;
    std::unique_ptr<dealii::ParameterHandler> obstacle, contact;
  };

  /**
   * Couplings of all loads that are rigid; those of the same faces and the same
   * point have one. Throws InputError where faces are held by something else,
   * too: by another one of them, by `supports` or by `contacts`.
   */
  std::vector<Coupling>
  find_couplings(const std::vector<bodies::Load>              &loads,
                 const std::vector<bodies::Support>           &supports,
                 const std::vector<pairing::Contact>          &contacts,
                 const std::vector<std::string>               &bodies,
                 const std::vector<const bodies::Structure *> &structures,
                 const unsigned int                            dim);
} // namespace conetact::application

#endif
