// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_deck_elements_h
#define conetact_base_deck_elements_h

#include "conetact/base/file_mesh.h"

#include <optional>

namespace conetact
{
  // Elements as decks of Abaqus and CalculiX number their nodes and faces.

  /** How many nodes an element has; its dimension is 0 if it is no part of a
   * mesh, such as a spring. */
  struct DeckKind
  {
    unsigned int dim;
    std::size_t  n_nodes;
  };

  /** Of "C3D8R" or "CPS4", in upper case. Nothing: it is not known. */
  std::optional<DeckKind>
  deck_kind(const std::string &type);

  /** An element of these nodes, in the order of the deck. */
  FileMesh::Element
  deck_element(const DeckKind &kind, const std::vector<unsigned int> &nodes);

  /** Corners of the face of a deck with this number, from 1 on. Empty: there is
   * none. */
  std::vector<unsigned int>
  deck_face(const FileMesh::Element &element, const unsigned int number);
} // namespace conetact

#endif
