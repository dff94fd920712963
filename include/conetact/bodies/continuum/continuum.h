// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_bodies_continuum_continuum_h
#define conetact_bodies_continuum_continuum_h

#include "conetact/bodies/continuum/cell_matrices.h"
#include "conetact/bodies/continuum/cell_nodes.h"
#include "conetact/bodies/continuum/continuum_mesh.h"
#include "conetact/bodies/continuum/elements.h"
#include "conetact/bodies/continuum/material.h"
#include "conetact/bodies/groups.h"
#include "conetact/bodies/structure.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace conetact::bodies
{
  template <int dim>
  class BoundaryFaces;
  template <int dim>
  struct Discretization;

  /** Of a body at a point, beside its mesh: thickness, 1 in 3D and of rings, or
   * circumference. */
  template <int dim>
  struct Extent
  {
    bool   is_ring;
    double thickness;

    double
    operator()(const dealii::Point<dim> &p) const
    {
      return is_ring ? 2 * dealii::numbers::PI * p[0] : thickness;
    }
  };

  /**
   * A body of quadrilaterals or triangles (2D), hexahedra or tetrahedra (3D)
   * with a displacement at each node, @f$K = \int B^T C B\,dx@f$.
   */
  template <int dim>
  class Continuum : public Structure
  {
  public:
    /** Of a finished mesh, see make_mesh(), and a row for its cells. */
    Continuum(std::unique_ptr<dealii::Triangulation<dim, dim>> finished_mesh,
              const ElasticMaterial                           &elastic,
              const ElementRow<dim>                           &row);
    /**
     * Of several materials: ids of cells are their places in the list. `groups`
     * are the boundary ids that have names, `nodes` bend cells of second
     * degree. What `is_to_be_halved` is halved(), and the finished mesh is
     * forgotten.
     */
    Continuum(std::unique_ptr<dealii::Triangulation<dim, dim>> finished_mesh,
              const std::vector<ElasticMaterial>              &materials,
              const ElementRow<dim>                           &row,
              const MeshGroups                                &groups,
              const CellNodes<dim>                            &nodes = {},
              const bool is_to_be_halved                             = false);
    ~Continuum() override;

    unsigned int
    n_nodes() const override;
    unsigned int
    n_components() const override;
    Point<3>
    position(const unsigned int node) const override;
    const std::vector<HangingNode> &
    hanging_nodes() const override;
    bool
    is_axisymmetric() const override;

    const Elements &
    elements() const override
    {
      return matrices;
    }

    BoundaryIds
    boundary_ids() const override;
    const MeshGroups::Ids &
    boundary_groups() const override
    {
      return groups_of_faces;
    }
    /**
     * Hanging nodes are no surface nodes: their share of area and normal goes
     * to the nodes that they follow. Faces list them nevertheless.
     */
    Surface
    surface(const BoundaryIds &ids) const override;

    /** Initial strains are taken at the nodes and interpolated between them. */
    bool
    add(const Action &action, Eigen::VectorXd &f) const override;
    void
    visit_springs(const BoundaryIds        &ids,
                  const SurfaceTensorField &stiffness,
                  const ElementVisitor     &visit) const override;
    bool
    expands() const override;

    VtuGrid
    drawing(const Eigen::VectorXd &u,
            const Eigen::VectorXd &w,
            const Actions         &actions) const override;
    /** Of the worst of its materials. */
    double
    contrast_of_strains() const override;
    /** Of triangles and tetrahedra: they lock. Of edges that a file bends. */
    std::string
    caution() const override;
    std::string
    description() const override;
    const std::string &
    made_mesh() const override
    {
      return mesh_file;
    }
    bool
    meets_at_corners() const override
    {
      return at_corners;
    }
    /** The middle of a cell that is bent so much that it is folded, if any. */
    std::optional<Point<3>>
    folded_cell() const;
    bool
    can_be_refined() const override;
    std::vector<double>
    element_errors(const Eigen::VectorXd &u) const override;
    void
    forget_mesh() override;

  private:
    Surface
    find_surface(const BoundaryIds &ids) const;

    std::unique_ptr<const Discretization<dim>> discretization; ///< or forgotten
    ContinuumMesh<dim>                         mesh;
    /** Of each component. */
    std::unique_ptr<const dealii::FiniteElement<dim, dim>> element;
    const dealii::Quadrature<dim>                          quadrature;
    std::unique_ptr<const BoundaryFaces<dim>>              faces;
    bool              at_corners; ///< contacts stand
    Phases<dim>       phases;
    MeshGroups::Ids   groups_of_faces;
    std::string       of_file; ///< cautions
    std::string       notes_of_file, mesh_file;
    Extent<dim>       extent;
    const char       *element_name;
    CellMatrices<dim> matrices;
    /** Those that were asked for twice: a contact asks for its sides many
     * times, others once. */
    mutable std::map<BoundaryIds, std::optional<Surface>> surfaces;
  };
} // namespace conetact::bodies

#endif
