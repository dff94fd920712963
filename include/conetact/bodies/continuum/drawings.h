// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_drawings_h
#define conetact_bodies_continuum_drawings_h

#include "conetact/base/gmsh_program.h"

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace conetact::bodies
{
  /** Entries of `subsection Mesh` for files that are drawings, not meshes. */
  void
  declare_drawing(dealii::ParameterHandler &prm);
  /** `where` is for messages: "Body 'block', Mesh/". Throws InputError. */
  GmshWishes
  parse_drawing(dealii::ParameterHandler &prm, const std::string &where);
  /** The name of the first of these entries that says something; empty: none
   * does. */
  std::string
  first_entry_of(const GmshWishes &wishes);
} // namespace conetact::bodies

#endif
