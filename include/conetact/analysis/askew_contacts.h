// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_askew_contacts_h
#define conetact_analysis_askew_contacts_h

#include "conetact/contact/contact_model.h"

#include <string>

namespace conetact::analysis
{
  /**
   * Whether an obstacle presses on a node along a direction that its body does
   * not face, a sentence; empty: nowhere. `r`: reactions of all candidates.
   */
  std::string
  meets_askew(const contact::ContactModel &model, const Eigen::VectorXd &r);
} // namespace conetact::analysis

#endif
