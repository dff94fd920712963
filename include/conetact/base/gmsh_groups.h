// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_gmsh_groups_h
#define conetact_base_gmsh_groups_h

#include <gmsh.h>

#include <set>
#include <string>

/** Entities and physical groups of the model that Gmsh has open. */
namespace conetact::gmsh_model
{
  using Entities = gmsh::vectorpair; ///< dimensions and numbers

  Entities
  entities(const unsigned int dim);
  Entities
  groups();
  /** What has no groups gets one for each volume and each surface. */
  void
  make_groups(const unsigned int dim);
  /** The entities of the groups of a name or number in these dimensions. */
  Entities
  entities_of(const std::string &text, const std::set<int> &dimensions);
  /** Throws FileFault of the entry `Size near`: there is no such group. */
  [[noreturn]] void
  refuse_group(const std::string &name, const std::set<int> &dimensions);
  /** Only the volumes of some groups (a, b) and what bounds them is meshed. */
  void
  hide_others(const std::string &groups, const int dim);
} // namespace conetact::gmsh_model

#endif
