// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/graphics.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace conetact::bodies
{
  namespace
  {
    /** Sum over the cells of a node, divided by their number. */
    template <int dim>
    Eigen::MatrixXd
    averaged_stresses(const ContinuumMesh<dim>      &mesh,
                      const ElementFormulation<dim> &element,
                      const ElasticMaterial         &material,
                      const Eigen::VectorXd         &w,
                      const Eigen::VectorXd         &temperature)
    {
      using Element                 = ElementFormulation<dim>;
      const Eigen::VectorXd thermal = material.thermal_strain(dim);
      const auto      n_nodes = static_cast<Eigen::Index>(mesh.nodes.size());
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(Element::n_strains, n_nodes);
      Eigen::VectorXd n_cells           = Eigen::VectorXd::Zero(n_nodes);
      const unsigned int              n = mesh.n_cell_nodes;
      typename Element::Displacements w_cell(dim * n);
      typename Element::Strains       initial(Element::n_strains, n);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const auto cell = mesh.cell(c);
          for (unsigned int v = 0; v < n; ++v)
            {
              w_cell.template segment<dim>(dim * v) =
                w.segment<dim>(dim * static_cast<Eigen::Index>(cell[v]));
              initial.col(v) = temperature[cell[v]] * thermal;
            }
          const typename Element::Strains stresses =
            element.stresses(mesh.vertices(c), w_cell, initial);
          for (unsigned int v = 0; v < n; ++v)
            {
              sum.col(cell[v]) += stresses.col(v);
              n_cells[cell[v]] += 1;
            }
        }
      for (Eigen::Index i = 0; i < n_nodes; ++i)
        sum.col(i) /= n_cells[i];

      // continuous across faces with hanging nodes
      for (const HangingNode &node : mesh.hanging)
        {
          sum.col(node.node).setZero();
          for (const auto &[master, weight] : node.masters)
            sum.col(node.node) += weight * sum.col(master);
        }
      return sum;
    }

    Eigen::Matrix3d
    tensor(const Eigen::VectorXd &s)
    {
      Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
      t.diagonal()      = s.head<3>();
      t(0, 1) = t(1, 0) = s[3];
      if (s.size() == 6)
        {
          t(1, 2) = t(2, 1) = s[4];
          t(2, 0) = t(0, 2) = s[5];
        }
      return t;
    }

    double
    equivalent(const Eigen::Matrix3d &stress)
    {
      const Eigen::Matrix3d deviator =
        stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
      return std::sqrt(1.5) * deviator.norm();
    }
    /** Hooke's law in space, which holds in plane strain and stress, too. */
    Eigen::Matrix3d
    strain_of(const Eigen::Matrix3d &stress,
              const ElasticMaterial &material,
              const double           temperature)
    {
      const double E = material.young_modulus, nu = material.poisson_ratio;
      return (1 + nu) / E * stress +
             (material.expansion * temperature - nu / E * stress.trace()) *
               Eigen::Matrix3d::Identity();
    }

    /** The largest first. */
    Eigen::Vector3d
    principal(const Eigen::Matrix3d &symmetric)
    {
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
               symmetric, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .reverse();
    }

    /** Fields of the nodes, filled node by node. */
    struct NodalFields
    {
      VtuField displacement = {"displacement", 3, {}};
      VtuField stress       = {"stress", 9, {}};
      VtuField von_mises    = {"von_mises", 1, {}};
      VtuField strain       = {"strain", 9, {}};
      VtuField principal_stresses{"principal_stresses",
                                  3,
                                  {},
                                  {"largest", "middle", "least"}};
      VtuField principal_strains{"principal_strains",
                                 3,
                                 {},
                                 {"largest", "middle", "least"}};

      template <class Values>
      static void
      append(VtuField &field, const Values &values)
      {
        for (Eigen::Index i = 0; i < values.size(); ++i)
          field.values.push_back(values.data()[i]);
      }

      void
      append(const Eigen::Matrix3d &stress_here,
             const ElasticMaterial &material,
             const double           temperature)
      {
        const Eigen::Matrix3d strain_here =
          strain_of(stress_here, material, temperature);
        append(stress, stress_here);
        von_mises.values.push_back(equivalent(stress_here));
        append(strain, strain_here);
        append(principal_stresses, principal(stress_here));
        append(principal_strains, principal(strain_here));
      }

      std::vector<VtuField>
      all() &&
      {
        return {std::move(displacement),
                std::move(stress),
                std::move(von_mises),
                std::move(strain),
                std::move(principal_stresses),
                std::move(principal_strains)};
      }
    };

    template <int dim>
    VtuGrid::Shape
    shape_of(const unsigned int n_cell_nodes)
    {
      using Shape = VtuGrid::Shape;
      if (n_cell_nodes == dim + 1)
        return dim == 2 ? Shape::triangle : Shape::tetrahedron;
      return dim == 2 ? Shape::quadrilateral : Shape::hexahedron;
    }

    template <int dim>
    VtuGrid
    bare_grid(const ContinuumMesh<dim> &mesh)
    {
      VtuGrid grid;
      for (const Point<dim> &node : mesh.nodes)
        grid.points.push_back(to_space(node));
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const auto cell = mesh.cell(c);
          grid.add_cell(shape_of<dim>(mesh.n_cell_nodes),
                        {cell.begin(), cell.end()});
        }
      grid.cell_ids = {{"material_id", mesh.material_ids}};
      return grid;
    }
  } // namespace

  template <int dim>
  VtuGrid
  draw_continuum(const ContinuumMesh<dim>      &mesh,
                 const ElementFormulation<dim> &element,
                 const ElasticMaterial         &material,
                 const Eigen::VectorXd         &u,
                 const Eigen::VectorXd         &w,
                 const Eigen::VectorXd         &temperature)
  {
    const Eigen::MatrixXd stresses =
      averaged_stresses(mesh, element, material, w, temperature);
    NodalFields fields;
    for (Eigen::Index i = 0; i < stresses.cols(); ++i)
      {
        Eigen::Vector3d displacement      = Eigen::Vector3d::Zero();
        displacement.template head<dim>() = u.segment<dim>(dim * i);
        NodalFields::append(fields.displacement, displacement);
        fields.append(tensor(stresses.col(i)), material, temperature[i]);
      }
    VtuGrid grid      = bare_grid(mesh);
    grid.point_fields = std::move(fields).all();
    return grid;
  }

  template VtuGrid
  draw_continuum<2>(const ContinuumMesh<2> &,
                    const ElementFormulation<2> &,
                    const ElasticMaterial &,
                    const Eigen::VectorXd &,
                    const Eigen::VectorXd &,
                    const Eigen::VectorXd &);
  template VtuGrid
  draw_continuum<3>(const ContinuumMesh<3> &,
                    const ElementFormulation<3> &,
                    const ElasticMaterial &,
                    const Eigen::VectorXd &,
                    const Eigen::VectorXd &,
                    const Eigen::VectorXd &);
} // namespace conetact::bodies
