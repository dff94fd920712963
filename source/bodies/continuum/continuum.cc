// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/continuum.h"

#include "conetact/base/text.h"
#include "conetact/bodies/continuum/boundary_faces.h"
#include "conetact/bodies/continuum/discretization.h"
#include "conetact/bodies/continuum/graphics.h"
#include "conetact/bodies/continuum/halved_cells.h"
#include "conetact/bodies/continuum/refinement.h"

#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace conetact::bodies
{
  using namespace dealii;

  namespace
  {
    /** On bent edges of their coarser neighbours, or not even rigid motions
     * would be free of strain. */
    template <int dim>
    void
    follow_masters(ContinuumMesh<dim> &mesh)
    {
      for (const HangingNode &node : mesh.hanging)
        {
          Point<dim> place;
          for (const auto &[master, weight] : node.masters)
            place += weight * Tensor<1, dim>(mesh.nodes[master]);
          mesh.nodes[node.node] = place;
        }
    }

    template <int dim>
    using Cells =
      std::vector<typename Triangulation<dim>::active_cell_iterator>;

    /** Whether the way from one to the next is several cells long. */
    template <int dim>
    bool
    jump_about(const Cells<dim> &cells)
    {
      constexpr double several = 4;
      double           way = 0, edges = 0;
      for (std::size_t c = 1; c < cells.size(); ++c)
        {
          way += cells[c]->vertex(0).distance(cells[c - 1]->vertex(0));
          edges += cells[c]->vertex(0).distance(cells[c]->vertex(1));
        }
      return way > several * edges;
    }

    /** In the order of the mesh, unless that jumps about, as it does in files
     * of mesh generators: cells near each other then follow on each other, so
     * that what is computed of one is still in the cache for the next. */
    template <int dim>
    Cells<dim>
    cells_of(const Triangulation<dim> &mesh)
    {
      Cells<dim> cells;
      for (const auto &cell : mesh.active_cell_iterators())
        cells.push_back(cell);
      if (!jump_about<dim>(cells))
        return cells;
      std::vector<Point<dim>> places;
      for (const auto &cell : cells)
        places.push_back(cell->vertex(0));
      constexpr int bits = 8; // of places along each axis
      const auto    curve =
        Utilities::inverse_Hilbert_space_filling_curve(places, bits);
      std::stable_sort(cells.begin(), cells.end(), [&](auto &a, auto &b) {
        return curve[a->active_cell_index()] < curve[b->active_cell_index()];
      });
      return cells;
    }

    /** Empty where cells come in their order. */
    template <int dim>
    std::vector<unsigned int>
    numbers_of_active(const Cells<dim> &cells)
    {
      std::vector<unsigned int> numbers(cells.size());
      bool                      are_same = true;
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          numbers[cells[c]->active_cell_index()] = c;
          are_same = are_same && cells[c]->active_cell_index() == c;
        }
      return are_same ? std::vector<unsigned int>() : numbers;
    }

    template <int dim>
    ContinuumMesh<dim>
    plain(const Discretization<dim> &body, const bool has_phases)
    {
      ContinuumMesh<dim> mesh;
      mesh.nodes.resize(body.n_nodes());
      mesh.n_cell_nodes      = body.fe.dofs_per_cell / dim;
      mesh.hanging           = body.hanging_nodes();
      const Cells<dim> cells = cells_of(*body.triangulation);
      mesh.number_of_active  = numbers_of_active<dim>(cells);
      mesh.nodes_of_cells.reserve(cells.size() * mesh.n_cell_nodes);
      for (const auto &cell : cells)
        {
          mesh.material_ids.push_back(static_cast<int>(cell->material_id()));
          const auto nodes  = body.nodes_of(cell);
          const auto places = body.places_of(cell);
          for (std::size_t v = 0; v < nodes.size(); ++v)
            {
              mesh.nodes_of_cells.push_back(nodes[v]);
              mesh.nodes[nodes[v]] = places[v];
            }
          if (has_phases)
            mesh.phase_of_cell.push_back(cell->material_id());
        }
      if (body.fe.degree > 1)
        follow_masters(mesh);
      return mesh;
    }

    template <int dim>
    Phases<dim>
    make_phases(const std::vector<ElasticMaterial> &materials,
                const ElementRow<dim>              &row)
    {
      Phases<dim> phases;
      for (const ElasticMaterial &material : materials)
        phases.push_back({material, row.create(material)});
      return phases;
    }

    template <int dim>
    void
    add_nodal_values(const ContinuumMesh<dim>   &mesh,
                     const InitialStrainField   &field,
                     std::vector<InitialStrain> &values)
    {
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] += field(to_space(mesh.nodes[i]));
    }

    /** Corners of six-node triangles have no area by their shape functions. */
    bool
    has_corners_without_area(const std::vector<unsigned int> &nodes)
    {
      return nodes.size() == 6;
    }

    /** What stands for node v in the area of a face at a point: its shape
     * function, or on a six-node triangle the linear one of a corner. */
    template <int dim>
    double
    area_part(const FEFaceValues<dim>                 &fe,
              const typename BoundaryFaces<dim>::Face &face,
              const unsigned int                       v,
              const unsigned int                       q)
    {
      const auto shape = [&](const unsigned int node) {
        return fe.shape_value(face.in_cell[node], q);
      };
      if (!has_corners_without_area(face.nodes))
        return shape(v);
      return v >= 3 ? 0. :
                      shape(v) + .5 * (shape(3 + v) + shape(3 + (v + 2) % 3));
    }

    /** The weight of the normal there, of nodes in the middle of edges, too. */
    template <int dim>
    double
    normal_part(const FEFaceValues<dim>                 &fe,
                const typename BoundaryFaces<dim>::Face &face,
                const unsigned int                       v,
                const unsigned int                       q)
    {
      if (has_corners_without_area(face.nodes) && v >= 3)
        return fe.shape_value(face.in_cell[v], q);
      return area_part(fe, face, v, q);
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
                // of second degree weights are below 0, too
                nodes[master].normals.push_back(std::abs(weight) * normal);
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
    : Continuum(std::move(finished_mesh),
                std::vector<ElasticMaterial>(1, elastic),
                row,
                {})
  {}

  template <int dim>
  Continuum<dim>::Continuum(
    std::unique_ptr<dealii::Triangulation<dim, dim>> finished_mesh,
    const std::vector<ElasticMaterial>              &materials,
    const ElementRow<dim>                           &row,
    const MeshGroups                                &groups,
    const CellNodes<dim>                            &nodes,
    const bool                                       is_to_be_halved)
    : discretization(
        std::make_unique<Discretization<dim>>(std::move(finished_mesh),
                                              row.degree,
                                              nodes))
    , mesh(is_to_be_halved ?
             halved(plain(*discretization, materials.size() > 1)) :
             plain(*discretization, materials.size() > 1))
    , element(discretization->fe.base_element(0).clone())
    , quadrature(discretization->quadrature)
    , faces(
        std::make_unique<BoundaryFaces<dim>>(*discretization,
                                             is_to_be_halved ? &mesh : nullptr))
    , at_corners(faces->are_triangles_of_second_degree() ||
                 (faces->is_bent(mesh) && !faces->have_hanging_nodes(mesh)))
    , phases(make_phases(materials, row))
    , groups_of_faces(groups.faces)
    , of_file(groups.caution)
    , notes_of_file(join(groups.notes, "; "))
    , mesh_file(groups.made_mesh)
    , extent{materials.front().is_axisymmetric(),
             dim == 2 && !materials.front().is_axisymmetric() ?
               materials.front().thickness :
               1}
    , element_name(row.name)
    , matrices(mesh, phases, extent.thickness)
  {
    if (is_to_be_halved)
      forget_mesh();
  }

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
  bool
  Continuum<dim>::is_axisymmetric() const
  {
    return extent.is_ring;
  }

  template <int dim>
  BoundaryIds
  Continuum<dim>::boundary_ids() const
  {
    return faces->ids();
  }

  template <int dim>
  Surface
  Continuum<dim>::surface(const BoundaryIds &ids) const
  {
    const auto [known, is_first] = surfaces.try_emplace(ids);
    if (is_first)
      return find_surface(ids);
    if (!known->second)
      known->second = find_surface(ids);
    return *known->second;
  }

  template <int dim>
  Surface
  Continuum<dim>::find_surface(const BoundaryIds &ids) const
  {
    Surface                             surface;
    std::map<unsigned int, SurfaceNode> nodes;
    faces->for_each(mesh, ids, [&](const auto &face, const auto &fe) {
      const auto               &numbers = face.nodes;
      std::vector<Tensor<1, 3>> shares(numbers.size());
      Tensor<1, 3>              mean;
      for (const unsigned int q : fe.quadrature_point_indices())
        {
          const Tensor<1, 3> normal = to_space(fe.normal_vector(q));
          mean += fe.JxW(q) * normal;
          for (unsigned int v = 0; v < numbers.size(); ++v)
            {
              // The tributary area int N_v, times thickness or circumference in
              // 2D, and the same with the normal.
              const double dx = extent(fe.quadrature_point(q)) * fe.JxW(q);
              nodes[numbers[v]].area += dx * area_part(fe, face, v, q);
              shares[v] += dx * normal_part(fe, face, v, q) * normal;
            }
        }
      surface.faces.push_back({numbers, mean / mean.norm(), at_corners});
      for (unsigned int v = 0; v < numbers.size(); ++v)
        nodes[numbers[v]].normals.push_back(shares[v]);
    });
    give_to_masters(mesh.hanging, nodes);
    for (auto &[number, node] : nodes)
      {
        node.node     = number;
        node.position = position(number);
        for (const Tensor<1, 3> &share : node.normals)
          node.normal += share;
        // A node on an edge of the body has a normal for each smooth side.
        node.normals = smooth_patches(node.normals);
        // opposite faces of a thin slit may cancel
        if (node.normal.norm() > 1e-12 * node.area)
          node.normal /= node.normal.norm();
        surface.nodes.push_back(node);
      }
    return surface;
  }



  template <int dim>
  bool
  Continuum<dim>::expands() const
  {
    return std::any_of(phases.begin(), phases.end(), [](const auto &phase) {
      return phase.material.expansion != 0;
    });
  }

  template <int dim>
  VtuGrid
  Continuum<dim>::drawing(const Eigen::VectorXd &u,
                          const Eigen::VectorXd &w,
                          const Actions         &actions) const
  {
    std::vector<InitialStrain> initial; // unless there are none
    for (const Action &action : actions)
      if (action.kind == Action::Kind::initial_strain)
        {
          initial.resize(mesh.nodes.size());
          add_nodal_values(mesh, action.strain, initial);
        }
    return draw_continuum(mesh, phases, matrices.cell_shapes(), u, w, initial);
  }

  template <int dim>
  double
  Continuum<dim>::contrast_of_strains() const
  {
    double largest = 1;
    for (const Phase<dim> &phase : phases)
      largest = std::max(largest, phase.material.contrast_of_strains());
    return largest;
  }



  template <int dim>
  std::string
  Continuum<dim>::caution() const
  {
    if (!element->reference_cell().is_simplex() || element->degree > 1)
      return of_file;
    const std::string kind = dim == 2 ? "triangles" : "tetrahedra";
    return "linear " + kind + " are too stiff in bending and lock near nu = " +
           "0.5. Refine until results stay the same, or use " +
           (is_axisymmetric() ? "" : "P2 or ") +
           (dim == 2 ? "quadrilaterals." : "hexahedra.") +
           (of_file.empty() ? "" : " Besides, " + of_file);
  }

  template <int dim>
  std::string
  Continuum<dim>::description() const
  {
    std::string text = std::to_string(mesh.n_cells()) + " cells " +
                       element_name + ", " + std::to_string(n_nodes()) +
                       " nodes";
    if (phases.size() > 1)
      text += ", " + std::to_string(phases.size()) + " materials";
    if (!mesh.hanging.empty())
      text += " (" + std::to_string(mesh.hanging.size()) + " hanging)";
    if (!notes_of_file.empty())
      text += "; " + notes_of_file;
    return text;
  }

  template <int dim>
  std::optional<Point<3>>
  Continuum<dim>::folded_cell() const
  {
    if (element->degree == 1)
      return {};
    std::vector<Point<dim>> points = quadrature.get_points();
    for (const Point<dim> &node : element->get_unit_support_points())
      points.push_back(node);
    NodeMapping<dim> mapping(*element);
    FEValues<dim>    fe_values(mapping,
                            *element,
                            Quadrature<dim>(points),
                            update_jacobians);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto &cell = mapping.cell_at(mesh.vertices(c));
        fe_values.reinit(cell);
        for (const auto &jacobian : fe_values.get_jacobians())
          if (!(jacobian.determinant() > 0))
            return to_space(cell->center());
      }
    return {};
  }

  template <int dim>
  bool
  Continuum<dim>::can_be_refined() const
  {
    return !element->reference_cell().is_simplex();
  }

  template <int dim>
  std::vector<double>
  Continuum<dim>::element_errors(const Eigen::VectorXd &u) const
  {
    if (!can_be_refined() || !discretization)
      return {};
    std::vector<double> errors = squared_jumps(*discretization, u);
    for (const auto &cell :
         discretization->triangulation->active_cell_iterators())
      errors[cell->active_cell_index()] *=
        extent(cell->center()) *
        phases[mesh.phase(mesh.number(cell->active_cell_index()))]
          .material.stiffness();
    return errors;
  }

  template <int dim>
  void
  Continuum<dim>::forget_mesh()
  {
    discretization.reset();
  }

  template class Continuum<2>;
  template class Continuum<3>;
} // namespace conetact::bodies
