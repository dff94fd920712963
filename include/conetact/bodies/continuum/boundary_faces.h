// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_boundary_faces_h
#define conetact_bodies_continuum_boundary_faces_h

#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/discretization.h"

#include <deal.II/base/std_cxx20/iota_view.h>

#include <vector>

namespace conetact::bodies
{
  /**
   * A face at its quadrature points: positions, outward unit normals, shape
   * functions of its nodes, and weights times area or length. Positions are
   * interpolated as displacements are, from the nodes of the face alone.
   */
  template <int dim>
  class FaceValues
  {
  public:
    explicit FaceValues(const Discretization<dim> &body);

    /** Side: 1 where the normal of the nodes' order points out, else -1. */
    void
    reinit(const ContinuumMesh<dim>        &mesh,
           const std::vector<unsigned int> &nodes,
           const double                     side);

    dealii::std_cxx20::ranges::iota_view<unsigned int, unsigned int>
    quadrature_point_indices() const
    {
      return {0u, static_cast<unsigned int>(weights.size())};
    }
    const Point<dim> &
    quadrature_point(const unsigned int q) const
    {
      return points[q];
    }
    const Tensor<1, dim> &
    normal_vector(const unsigned int q) const
    {
      return normals[q];
    }
    double
    JxW(const unsigned int q) const
    {
      return areas[q];
    }
    /** Of node v of the face, in its order. */
    double
    shape_value(const unsigned int v, const unsigned int q) const
    {
      return shapes[q][v];
    }

  private:
    std::vector<double>                          weights;
    std::vector<std::vector<double>>             shapes; ///< of points
    std::vector<std::vector<Tensor<1, dim - 1>>> gradients;
    std::vector<Point<dim>>                      points;
    std::vector<Tensor<1, dim>>                  normals;
    std::vector<double>                          areas;
  };

  /** The faces of a body's boundary. */
  template <int dim>
  class BoundaryFaces
  {
  public:
    struct Face
    {
      unsigned int              id;    ///< boundary id
      double                    side;  ///< of the normal, see FaceValues
      std::vector<unsigned int> nodes; ///< in deal.II's order
    };

    explicit BoundaryFaces(const Discretization<dim> &body);

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

    /** Calls visit(face, FaceValues) for each face that has one of the ids. */
    template <class Visitor>
    void
    for_each(const ContinuumMesh<dim> &mesh,
             const BoundaryIds        &wanted,
             const Visitor            &visit) const
    {
      FaceValues<dim> here = values;
      for (const Face &face : faces)
        if (wanted.count(face.id) > 0)
          {
            here.reinit(mesh, face.nodes, face.side);
            visit(face, here);
          }
    }

  private:
    FaceValues<dim>   values; ///< of any face
    std::vector<Face> faces;
  };
} // namespace conetact::bodies

#endif
