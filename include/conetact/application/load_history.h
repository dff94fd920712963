// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_load_history_h
#define conetact_application_load_history_h

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace conetact::application
{
  /** Entries of `subsection Time`. */
  void
  declare_time(dealii::ParameterHandler &prm);

  /** Ascending times at which increments end. Throws InputError. */
  std::vector<double>
  create_times(dealii::ParameterHandler &prm);
} // namespace conetact::application

#endif
