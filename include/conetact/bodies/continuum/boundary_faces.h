// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_boundary_faces_h
#define conetact_bodies_continuum_boundary_faces_h

#include "conetact/bodies/continuum/boundary_face.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/discretization.h"
#include "conetact/bodies/continuum/node_mapping.h"

#include <deal.II/fe/fe_values.h>

#include <vector>

namespace conetact::bodies
{
  /** The faces of a body's boundary. */
  template <int dim>
  class BoundaryFaces
  {
  public:
    using Face = BoundaryFace;

    /** Of a body, or of the mesh that its halved cells are. */
    explicit BoundaryFaces(const Discretization<dim> &body,
                           const ContinuumMesh<dim>  *halved_mesh = nullptr);

    BoundaryIds
    ids() const;

    bool
    are_triangles_of_second_degree() const
    {
      return !faces.empty() && faces[0].nodes.size() == 6;
    }
    /** Whether some node of a face hangs. */
    bool
    have_hanging_nodes(const ContinuumMesh<dim> &mesh) const;
    /** Whether nodes stand beside the middle of straight edges and faces. */
    bool
    is_bent(const ContinuumMesh<dim> &mesh) const;

    /** Calls visit(face, FEFaceValues) for each face that has one of the ids;
     * shape functions are those of the face's cell. */
    template <class Visitor>
    void
    for_each(const ContinuumMesh<dim> &mesh,
             const BoundaryIds        &wanted,
             const Visitor            &visit) const
    {
      for (const Face &face : faces)
        if (wanted.count(face.id) > 0)
          {
            const unsigned int cell = mesh.number(face.active);
            values.reinit(mapping.cell_at(mesh.vertices(cell)), face.number);
            visit(face, values);
          }
    }

  private:
    mutable NodeMapping<dim>          mapping;
    mutable dealii::FEFaceValues<dim> values; ///< of the face at hand
    std::vector<Face>                 faces;
  };
} // namespace conetact::bodies

#endif
