// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/boundary_faces.h"
#include "conetact/bodies/continuum/halved_cells.h"
#include "conetact/bodies/continuum/point_search.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

using namespace conetact::bodies;

namespace
{
  /** A box of distorted cells, one of which is refined. */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>>
  distorted_box()
  {
    auto mesh = std::make_unique<dealii::Triangulation<dim>>();
    dealii::GridGenerator::subdivided_hyper_cube(*mesh, 3, 0., 1., true);
    dealii::GridTools::distort_random(.1, *mesh, true, 1);
    mesh->begin_active()->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    return mesh;
  }

  template <int dim>
  ContinuumMesh<dim>
  arrays_of(const Discretization<dim> &body)
  {
    ContinuumMesh<dim> mesh;
    mesh.nodes.resize(body.n_nodes());
    mesh.n_cell_nodes = body.fe.dofs_per_cell / dim;
    for (const auto &cell : body.triangulation->active_cell_iterators())
      {
        const auto nodes = body.nodes_of(cell);
        const auto at    = body.places_of(cell);
        for (std::size_t v = 0; v < nodes.size(); ++v)
          {
            mesh.nodes_of_cells.push_back(nodes[v]);
            mesh.nodes[nodes[v]] = at[v];
          }
        mesh.material_ids.push_back(static_cast<int>(cell->material_id()));
      }
    return mesh;
  }

  /** An L of cells, some of another material. */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>>
  bent_bar(const unsigned int n_refinements)
  {
    auto mesh = std::make_unique<dealii::Triangulation<dim>>();
    dealii::GridGenerator::hyper_L(*mesh, -1., 1., true);
    mesh->begin_active()->set_material_id(3);
    dealii::GridTools::distort_random(.1, *mesh, true, 1);
    mesh->refine_global(n_refinements);
    return mesh;
  }

  template <int dim>
  std::vector<std::vector<unsigned int>>
  nodes_of_faces(const BoundaryFaces<dim> &faces,
                 const ContinuumMesh<dim> &mesh,
                 const unsigned int        id)
  {
    std::vector<std::vector<unsigned int>> nodes;
    faces.for_each(mesh, {id}, [&](const auto &face, const auto &) {
      nodes.push_back(face.nodes);
    });
    return nodes;
  }

  template <int dim>
  void
  halve_the_bar()
  {
    const Discretization<dim> body(bent_bar<dim>(1)), refined(bent_bar<dim>(2));
    const ContinuumMesh<dim>  mesh = halved(arrays_of(body)),
                             same  = arrays_of(refined);
    EXPECT_EQ(mesh.nodes_of_cells, same.nodes_of_cells);
    ASSERT_EQ(mesh.nodes.size(), same.nodes.size());
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      EXPECT_NEAR(mesh.nodes[i].distance(same.nodes[i]), 0, 1e-15);
    ASSERT_EQ(mesh.material_ids.size(), same.material_ids.size());
    for (std::size_t c = 0; c < mesh.n_cells(); ++c)
      EXPECT_EQ(mesh.material_ids[c], same.material_ids[c]);
    const BoundaryFaces<dim> faces(body, &mesh), of_refined(refined);
    EXPECT_EQ(faces.ids(), of_refined.ids());
    for (const unsigned int id : faces.ids())
      EXPECT_EQ(nodes_of_faces(faces, mesh, id),
                nodes_of_faces(of_refined, same, id));
  }

  template <int dim>
  void
  integrate_over_the_box()
  {
    const Discretization<dim> body(distorted_box<dim>());
    const ContinuumMesh<dim>  mesh = arrays_of(body);
    NodeMapping<dim>          mapping(body.fe.base_element(0));
    dealii::FEValues<dim>     fe_values(mapping,
                                    mapping.element(),
                                    body.quadrature,
                                    dealii::update_values |
                                      dealii::update_quadrature_points |
                                      dealii::update_JxW_values);
    double                    volume = 0, moment = 0;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        fe_values.reinit(mapping.cell_at(mesh.vertices(c)));
        for (const unsigned int q : fe_values.quadrature_point_indices())
          {
            double sum = 0;
            for (const unsigned int v : fe_values.dof_indices())
              sum += fe_values.shape_value(v, q);
            EXPECT_NEAR(sum, 1, 1e-14);
            volume += fe_values.JxW(q);
            moment += fe_values.quadrature_point(q)[0] * fe_values.JxW(q);
          }
      }
    EXPECT_NEAR(volume, 1, 1e-13);
    EXPECT_NEAR(moment, .5, 1e-13);

    const dealii::Point<dim> p     = dim == 2 ? dealii::Point<dim>(.37, .61) :
                                                dealii::Point<dim>(.37, .61, .9);
    const auto               place = find_cell(mesh, mapping.element(), p);
    ASSERT_TRUE(place);
    dealii::Point<dim> found;
    for (unsigned int v = 0; v < mesh.n_cell_nodes; ++v)
      found += place->shapes[v] *
               dealii::Tensor<1, dim>(mesh.nodes[mesh.cell(place->cell)[v]]);
    // as exact as deal.II inverts the map of a distorted cell
    EXPECT_NEAR(found.distance(p), 0, 1e-10);
    EXPECT_FALSE(find_cell(mesh, mapping.element(), 3. * p));

    const BoundaryFaces<dim> faces(body);
    EXPECT_EQ(faces.ids().size(), 2u * dim);
    double area = 0, outward = 0;
    faces.for_each(mesh, {1}, [&](const auto &, const auto &fe) {
      for (const unsigned int q : fe.quadrature_point_indices())
        {
          EXPECT_NEAR(fe.quadrature_point(q)[0], 1, 1e-14);
          area += fe.JxW(q);
          outward += fe.normal_vector(q)[0] * fe.JxW(q);
        }
    });
    EXPECT_NEAR(area, 1, 1e-13);
    EXPECT_NEAR(outward, 1, 1e-13);
  }
} // namespace

TEST(MeshParts, AreEnoughToIntegrateOverCellsAndFaces)
{
  integrate_over_the_box<2>();
  integrate_over_the_box<3>();
}

TEST(MeshParts, HalvedAreThoseOfAnotherRefinement)
{
  halve_the_bar<2>();
  halve_the_bar<3>();
}
