// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/continuum.h"

#include "conetact/bodies/continuum/graphics.h"
#include "conetact/bodies/continuum/quadrature.h"
#include "conetact/bodies/continuum/refinement.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <map>

namespace conetact
{
  namespace
  {
    /** How far outside its cell, in cell sizes, a point may be by round-off. */
    constexpr double point_tolerance = 1e-6;

    /** f += N^T value, in the dofs of these nodes. */
    template <int dim, class Nodes, class Shape>
    void
    distribute(const Nodes        &nodes,
               const Shape        &shape,
               const Tensor<1, 3> &value,
               Eigen::VectorXd    &f)
    {
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (unsigned int c = 0; c < dim; ++c)
          f[dim * nodes[v] + c] += shape[v] * value[c];
    }

    template <int dim>
    Eigen::VectorXd
    nodal_values(const ContinuumMesh<dim> &mesh, const ScalarField &field)
    {
      Eigen::VectorXd values(static_cast<Eigen::Index>(mesh.nodes.size()));
      for (Eigen::Index i = 0; i < values.size(); ++i)
        values[i] = field(to_space(mesh.nodes[static_cast<std::size_t>(i)]));
      return values;
    }

    /** Calls back for each face that has one of the ids. */
    template <int dim, class Visitor>
    void
    for_each_face(const ContinuumMesh<dim> &mesh,
                  const BoundaryIds        &ids,
                  const Visitor            &visit)
    {
      for (const auto &face : mesh.faces)
        if (ids.count(face.id) > 0)
          visit(face);
    }

    /**
     * The nearest active cell, by its index, and where the point lies in it;
     * the number of cells if the point is in none. A plain loop: GridTools'
     * search is slow for points outside and sets up maps each time.
     */
    template <int dim>
    std::pair<unsigned int, Point<dim>>
    locate(const dealii::Triangulation<dim> &triangulation, const Point<dim> &p)
    {
      const auto &mapping = dealii::StaticMappingQ1<dim>::mapping;
      std::pair<unsigned int, Point<dim>> found(triangulation.n_active_cells(),
                                                Point<dim>());
      double                              nearest = point_tolerance;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->bounding_box().point_inside(p, point_tolerance))
          try
            {
              const Point<dim> unit =
                mapping.transform_real_to_unit_cell(cell, p);
              const double distance =
                dealii::GeometryInfo<dim>::distance_to_unit_cell(unit);
              if (distance < nearest)
                {
                  nearest = distance;
                  found   = {cell->active_cell_index(), unit};
                }
            }
          catch (const typename dealii::Mapping<dim>::ExcTransformationFailed &)
            {} // far outside a distorted cell
      return found;
    }

    /**
     * Moves what hanging nodes have to the nodes that they follow: areas, and
     * the normals of faces times their share of the area.
     */
    void
    give_to_masters(const std::vector<HangingNode>      &hanging,
                    std::map<unsigned int, SurfaceNode> &nodes)
    {
      for (const HangingNode &node : hanging)
        {
          const auto found = nodes.find(node.node);
          if (found == nodes.end())
            continue;
          for (const auto &[master, weight] : node.masters)
            {
              nodes[master].area += weight * found->second.area;
              for (const Tensor<1, 3> &normal : found->second.normals)
                nodes[master].normals.push_back(weight * normal);
            }
          nodes.erase(found);
        }
    }
  } // namespace

  template <int dim>
  Continuum<dim>::Continuum(
    std::unique_ptr<dealii::Triangulation<dim, dim>> finished_mesh,
    const ElasticMaterial                           &elastic,
    const ElementRow<dim>                           &row)
    : triangulation(std::move(finished_mesh))
    , mesh(*triangulation)
    , material(elastic)
    , thickness(dim == 2 ? material.thickness : 1)
    , element_name(row.name)
    , element(row.create(material))
    , matrices(mesh, *element, thickness)
  {}

  template <int dim>
  Continuum<dim>::~Continuum() = default;

  template <int dim>
  unsigned int
  Continuum<dim>::n_nodes() const
  {
    return static_cast<unsigned int>(mesh.nodes.size());
  }

  template <int dim>
  unsigned int
  Continuum<dim>::n_components() const
  {
    return dim;
  }

  template <int dim>
  Point<3>
  Continuum<dim>::position(const unsigned int node) const
  {
    return to_space(mesh.nodes[node]);
  }

  template <int dim>
  const std::vector<HangingNode> &
  Continuum<dim>::hanging_nodes() const
  {
    return mesh.hanging;
  }

  template <int dim>
  void
  Continuum<dim>::for_each_element(const ElementVisitor &visit) const
  {
    matrices.for_each(visit);
  }

  template <int dim>
  void
  Continuum<dim>::add_internal_forces(const Eigen::VectorXd &u,
                                      Eigen::VectorXd       &f) const
  {
    matrices.add_forces(u, f);
  }



  template <int dim>
  BoundaryIds
  Continuum<dim>::boundary_ids() const
  {
    BoundaryIds ids;
    for (const auto &face : mesh.faces)
      ids.insert(face.id);
    return ids;
  }

  template <int dim>
  Surface
  Continuum<dim>::surface(const BoundaryIds &ids) const
  {
    Surface                             surface;
    std::map<unsigned int, SurfaceNode> nodes;
    for_each_face(mesh, ids, [&](const auto &face) {
      std::array<Tensor<1, 3>, ContinuumMesh<dim>::n_face_nodes> shares;
      Tensor<1, 3>                                               mean;
      for (const auto &q : gauss_points(mesh, face))
        {
          mean += q.weight * q.normal;
          for (unsigned int v = 0; v < face.nodes.size(); ++v)
            {
              const double part = thickness * q.weight * q.shape[v];
              nodes[face.nodes[v]].area += part;
              shares[v] += part * q.normal;
            }
        }
      surface.faces.push_back(
        {{face.nodes.begin(), face.nodes.end()}, mean / mean.norm()});
      for (unsigned int v = 0; v < face.nodes.size(); ++v)
        nodes[face.nodes[v]].normals.push_back(shares[v]);
    });
    give_to_masters(mesh.hanging, nodes);
    for (auto &[number, node] : nodes)
      {
        node.node     = number;
        node.position = position(number);
        for (const Tensor<1, 3> &share : node.normals)
          node.normal += share;
        node.normals = smooth_patches(node.normals);
        // opposite faces of a thin slit may cancel
        if (node.normal.norm() > 1e-12 * node.area)
          node.normal /= node.normal.norm();
        surface.nodes.push_back(node);
      }
    return surface;
  }



  template <int dim>
  void
  Continuum<dim>::add_traction(const BoundaryIds  &ids,
                               const SurfaceField &traction,
                               Eigen::VectorXd    &f) const
  {
    for_each_face(mesh, ids, [&](const auto &face) {
      for (const auto &q : gauss_points(mesh, face))
        distribute<dim>(face.nodes,
                        q.shape,
                        thickness * q.weight * traction(q.position, q.normal),
                        f);
    });
  }

  template <int dim>
  void
  Continuum<dim>::add_body_force(const VectorField &force,
                                 Eigen::VectorXd   &f) const
  {
    for (const auto &cell : mesh.cells)
      for (const auto &q : gauss_points(mesh, cell))
        distribute<dim>(cell,
                        q.shape,
                        thickness * q.weight * force(q.position),
                        f);
  }

  template <int dim>
  bool
  Continuum<dim>::add_point_force(const Point<3>     &point,
                                  const Tensor<1, 3> &force,
                                  Eigen::VectorXd    &f) const
  {
    Point<dim> p;
    for (unsigned int d = 0; d < dim; ++d)
      p[d] = point[d];
    if (point.distance(to_space(p)) > 0) // off the plane of a 2D body
      return false;
    const auto [cell, unit] = locate(*triangulation, p);
    if (cell == triangulation->n_active_cells())
      return false;

    std::array<double, ContinuumMesh<dim>::n_cell_nodes> shape;
    for (unsigned int v = 0; v < shape.size(); ++v)
      shape[v] = dealii::GeometryInfo<dim>::d_linear_shape_function(unit, v);
    distribute<dim>(mesh.cells[cell], shape, force, f);
    return true;
  }

  template <int dim>
  void
  Continuum<dim>::visit_springs(const BoundaryIds        &ids,
                                const SurfaceTensorField &stiffness,
                                const ElementVisitor     &visit) const
  {
    constexpr unsigned int n = dim * ContinuumMesh<dim>::n_face_nodes;
    for_each_face(mesh, ids, [&](const auto &face) {
      Eigen::Matrix<double, n, n> k = Eigen::Matrix<double, n, n>::Zero();
      for (const auto &q : gauss_points(mesh, face))
        {
          const Tensor<2, 3> s =
            thickness * q.weight * stiffness(q.position, q.normal);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j <= i; ++j)
              k(i, j) +=
                q.shape[i / dim] * q.shape[j / dim] * s[i % dim][j % dim];
        }
      k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();

      std::vector<unsigned int> dofs(n);
      for (unsigned int i = 0; i < n; ++i)
        dofs[i] = dim * face.nodes[i / dim] + i % dim;
      visit(dofs, k.data());
    });
  }



  template <int dim>
  bool
  Continuum<dim>::add_temperature(const ScalarField &change,
                                  Eigen::VectorXd   &f) const
  {
    using Element                  = ElementFormulation<dim>;
    const Eigen::VectorXd unit     = material.thermal_strain(dim);
    const Eigen::VectorXd at_nodes = nodal_values(mesh, change);
    for (const auto &cell : mesh.cells)
      {
        typename Element::Strains strains;
        for (int v = 0; v < Element::n_vertices; ++v)
          strains.col(v) = at_nodes[cell[v]] * unit;
        const typename Element::Displacements forces =
          thickness * element->forces(mesh.vertices(cell), strains);
        for (int i = 0; i < Element::n_dofs; ++i)
          f[dim * cell[i / dim] + i % dim] += forces[i];
      }
    return material.expansion != 0;
  }

  template <int dim>
  void
  Continuum<dim>::write_graphics(const Eigen::VectorXd       &u,
                                 const Eigen::VectorXd       &w,
                                 const Actions               &actions,
                                 const double                 time,
                                 const std::filesystem::path &file) const
  {
    Eigen::VectorXd temperature =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
    for (const Action &action : actions)
      if (action.kind == Action::Kind::temperature)
        temperature += nodal_values(mesh, action.temperature);
    write_continuum(mesh, *element, material, u, w, temperature, time, file);
  }

  template <int dim>
  std::string
  Continuum<dim>::description() const
  {
    std::string text = std::to_string(mesh.cells.size()) + " cells " +
                       element_name + ", " + std::to_string(n_nodes()) +
                       " nodes";
    if (!mesh.hanging.empty())
      text += " (" + std::to_string(mesh.hanging.size()) + " hanging)";
    return text;
  }

  template <int dim>
  Structure::MatrixCount
  Continuum<dim>::matrix_count() const
  {
    return {static_cast<unsigned int>(mesh.cells.size()), matrices.n_shapes()};
  }

  template <int dim>
  std::vector<double>
  Continuum<dim>::element_errors(const Eigen::VectorXd &u) const
  {
    std::vector<double> errors = squared_jumps(*triangulation, u);
    for (double &error : errors)
      error *= thickness * material.young_modulus;
    return errors;
  }

  template class Continuum<2>;
  template class Continuum<3>;
} // namespace conetact
