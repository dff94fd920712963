// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_stages_h
#define conetact_application_stages_h

#include "conetact/bodies/supports.h"
#include "conetact/pairing/contact_nodes.h"

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace conetact::application
{
  /** Those that are there at some times of a scene only; `activity` is that of
   * each. */
  std::vector<bodies::Support>
  changing_supports(dealii::ParameterHandler           &prm,
                    const std::vector<Expression>      &activity,
                    const std::vector<bodies::Support> &supports);

  /** Contact nodes must have the same unknowns in all stages: throws InputError
   * where supports that change hold one. */
  void
  refuse_changing_contacts(const std::vector<bodies::Support>      &changing,
                           const std::vector<pairing::ContactNode> &nodes,
                           const std::vector<pairing::Contact>     &contacts);
} // namespace conetact::application

#endif
