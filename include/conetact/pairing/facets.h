// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_pairing_facets_h
#define conetact_pairing_facets_h

#include "conetact/pairing/face_net.h"

#include <map>
#include <vector>

namespace conetact::pairing
{
  /**
   * How far the plane facets of a curved surface stand off it: the sagitta,
   * h^2/8R of a facet h long. It is estimated from how facets turn where they
   * meet: half of the turn on each side of a vertex, times the length over 4. A
   * facet is all faces that lie in one plane, for a mesh may divide it.
   *
   * Edges of 30 degrees and more are meant, as are those beside which nothing
   * goes on turning: chamfers, and the ends of fillets at plane faces.
   */
  class Facets
  {
  public:
    explicit Facets(const std::vector<FaceNet::Face> &faces);

    /** Of the facets around a node [length]. */
    double
    at(const unsigned int node) const;
    /** How far a node itself stands off, for it is no vertex of its facet. */
    double
    of_node(const unsigned int node) const;
    /** The sagitta of faces around a node that are bent themselves: no point of
     * them stands off the surface. */
    double
    bent_at(const unsigned int node) const;
    /** Of the facet with a face. */
    double
    of_face(const std::size_t face) const
    {
      return around_face[face];
    }
    double
    largest() const;

  private:
    std::map<unsigned int, double> around_node, below_node, bent_node;
    std::vector<double>            around_face;
  };
} // namespace conetact::pairing

#endif
