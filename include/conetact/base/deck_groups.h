// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_deck_groups_h
#define conetact_base_deck_groups_h

#include "conetact/base/file_mesh.h"

namespace conetact
{
  /** Gives elements of a mesh the groups of a deck or a universal file, which
   * have names; names that are numbers keep these, others have numbers from
   * own_numbers on. */
  class DeckGroups
  {
  public:
    explicit DeckGroups(FileMesh &m)
      : mesh(m)
    {}

    /** Adds elements, by their number, to the group of this name. */
    void
    add_elements(const std::string            &name,
                 const std::set<unsigned int> &elements);
    /** Adds a face of these corners, which need not be an element yet. */
    void
    add_face(const std::string &name, const std::vector<unsigned int> &corners);
    /** Adds the faces of cells all of whose corners are among these points. */
    void
    add_points(const std::string &name, const std::set<unsigned int> &points);

    /** To be called once, at the end: makes groups of sets of points. */
    void
    find_faces_of_points();

  private:
    unsigned int
    number(const unsigned int dim, const std::string &name);
    FileMesh::Element &
    face(const std::vector<unsigned int> &corners);

    FileMesh &mesh;
    /** By dimension and name. */
    std::map<std::pair<unsigned int, std::string>, unsigned int> numbers;
    std::map<std::vector<unsigned int>, std::size_t> faces; ///< sorted corners
    std::map<std::string, std::set<unsigned int>>    sets;  ///< of points
  };
} // namespace conetact

#endif
