// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_contact_entries_h
#define conetact_pairing_contact_entries_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace conetact::pairing
{
  /** Throws InputError where an entry of a contact's law says nothing, since
   * another one is not given; `in` is what errors begin with. */
  void
  refuse_idle_entries(const dealii::ParameterHandler &prm,
                      const std::string              &in);
} // namespace conetact::pairing

#endif
