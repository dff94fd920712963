// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_verify_condensation_h
#define conetact_analysis_verify_condensation_h

#include "conetact/base/log.h"
#include "conetact/contact/contact_model.h"

namespace conetact::analysis
{
  /**
   * Condenses the bodies of `model`, which `own` condenses, once more by
   * `other`, and tells for each stiffness the largest difference of an entry
   * over the largest entry. Throws AnalysisError with the body where that is
   * more than 1e-10.
   */
  void
  verify_condensation(contact::ContactModel      &model,
                      const condensed::Condenser &own,
                      const condensed::Condenser &other,
                      Log                        &log);
} // namespace conetact::analysis

#endif
