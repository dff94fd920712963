// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_entry_list_h
#define conetact_application_entry_list_h

#include "conetact/application/value_kind.h"

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace conetact::application
{
  /** What the program knows of an entry. */
  struct EntryDescription
  {
    std::vector<std::string> path; ///< of subsections around it
    std::string              name, value, default_value, documentation;
    ValueKind                kind;
  };

  /** In the place of names of the user's own: "Body NAME". */
  constexpr const char *any_name = "NAME";

  /** Every entry that a scene may have, with any_name in its sections. */
  void
  declare_any_scene(dealii::ParameterHandler &prm);

  /** All that are declared, as they are. */
  std::vector<EntryDescription>
  list_entries(const dealii::ParameterHandler &prm);
} // namespace conetact::application

#endif
