// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_groups_h
#define conetact_bodies_groups_h

#include "conetact/bodies/structure.h"

#include <map>
#include <string>
#include <vector>

namespace conetact::bodies
{
  /**
   * Groups of faces and of cells that a mesh file names, as boundary and
   * material ids: several where groups overlap. The number of a group is a
   * name of it as well, unless it is just the id. Ids that the program gives
   * (see own_numbers) have a name each: "TOP", "tip & ends" of what is in two
   * groups, "TOP only" of what is in no other.
   */
  struct MeshGroups
  {
    using Ids = std::map<std::string, BoundaryIds>;
    Ids faces, cells;
    /** What a user must know of the file, sentences; empty: nothing. */
    std::string caution = {};
    /** What the log says of the file, each half a sentence. */
    std::vector<std::string> notes = {};
    /** A mesh that was made of a drawing, as a file of Gmsh. */
    std::string made_mesh = {};
  };

  /**
   * Words of a list, separated by commas, that are names of groups (quotes
   * round them are taken off) or ids. Throws InputError that names the entry
   * and `what` a word is not: "a boundary id".
   */
  BoundaryIds
  to_ids(const std::string     &text,
         const MeshGroups::Ids &groups,
         const std::string     &what,
         const std::string     &entry);

  /** What a user writes for an id: its number, or a name where this number is
   * the program's own. */
  std::string
  name_of(const unsigned int id, const MeshGroups::Ids &groups);
  /** Of all of them: "0, 2, tip & ends". */
  std::string
  join_names(const BoundaryIds &ids, const MeshGroups::Ids &groups);
} // namespace conetact::bodies

#endif
