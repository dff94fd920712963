// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/graphics.h"

#include "conetact/bodies/continuum/cell_stresses.h"

#include <deal.II/base/exceptions.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <optional>

namespace conetact::bodies
{
  namespace
  {
    /**
     * Points of a drawing: each node once for each material around it, so that
     * stresses may jump there.
     */
    template <int dim>
    class DrawnPoints
    {
    public:
      DrawnPoints(const ContinuumMesh<dim> &mesh, const std::size_t n_phases)
        : numbers(n_phases, std::vector<unsigned int>(mesh.nodes.size(), none))
      {
        if (n_phases == 1)
          for (unsigned int node = 0; node < mesh.nodes.size(); ++node)
            add(0, node);
        of_cells.reserve(mesh.nodes_of_cells.size());
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (const unsigned int node : mesh.cell(c))
            of_cells.push_back(add(mesh.phase(c), node));
      }

      struct Place
      {
        unsigned int phase, node;
      };
      std::vector<Place>        places;
      std::vector<unsigned int> of_cells; ///< points of one cell by another

      /** The point of a node in a material; none: it is not there. */
      std::optional<unsigned int>
      find(const unsigned int phase, const unsigned int node) const
      {
        const unsigned int point = numbers[phase][node];
        return point == none ? std::nullopt :
                               std::optional<unsigned int>(point);
      }

    private:
      static constexpr unsigned int none = -1;

      unsigned int
      add(const unsigned int phase, const unsigned int node)
      {
        unsigned int &number = numbers[phase][node];
        if (number == none)
          {
            number = static_cast<unsigned int>(places.size());
            places.push_back({phase, node});
          }
        return number;
      }

      std::vector<std::vector<unsigned int>> numbers; ///< of phases, by nodes
    };

    /** Continuous across faces with hanging nodes. */
    template <int dim>
    void
    unhang(const ContinuumMesh<dim> &mesh,
           const DrawnPoints<dim>   &points,
           const unsigned int        n_phases,
           Eigen::MatrixXd          &values)
    {
      for (const HangingNode &node : mesh.hanging)
        for (unsigned int phase = 0; phase < n_phases; ++phase)
          {
            Eigen::VectorXd sum  = Eigen::VectorXd::Zero(values.rows());
            const auto      here = points.find(phase, node.node);
            bool            all  = here.has_value();
            for (const auto &[master, weight] : node.masters)
              if (const auto there = points.find(phase, master))
                sum += weight * values.col(*there);
              else
                all = false;
            if (all)
              values.col(*here) = sum;
          }
    }

    /** Of each point: sum over its cells, divided by their number. */
    template <int dim>
    Eigen::MatrixXd
    averaged_stresses(const ContinuumMesh<dim>         &mesh,
                      const DrawnPoints<dim>           &points,
                      const Phases<dim>                &phases,
                      const CellShapes<dim>            &shapes,
                      const Eigen::VectorXd            &w,
                      const std::vector<InitialStrain> &initial)
    {
      const auto    n_points  = static_cast<Eigen::Index>(points.places.size());
      constexpr int n         = ElementFormulation<dim>::n_strains;
      Eigen::MatrixXd sum     = Eigen::MatrixXd::Zero(n, n_points);
      Eigen::VectorXd n_cells = Eigen::VectorXd::Zero(n_points);
      for_each_stress<dim>(
        mesh,
        phases,
        shapes,
        w,
        initial,
        [&](const unsigned int cell, const auto &stresses) {
          for (Eigen::Index v = 0; v < stresses.cols(); ++v)
            {
              const unsigned int p =
                points.of_cells[std::size_t{cell} * mesh.n_cell_nodes +
                                static_cast<std::size_t>(v)];
              sum.col(p).template head<n>() += stresses.col(v);
              n_cells[p] += 1;
            }
        });
      for (Eigen::Index i = 0; i < n_points; ++i)
        sum.col(i) /= n_cells[i];
      unhang(mesh, points, static_cast<unsigned int>(phases.size()), sum);
      return sum;
    }

    Eigen::Matrix3d
    tensor(const Eigen::Ref<const Eigen::VectorXd> &s)
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
    elastic_strain(const Eigen::Matrix3d &stress,
                   const ElasticMaterial &material)
    {
      if (!material.orthotropy)
        {
          const double E = material.young_modulus, nu = material.poisson_ratio;
          return (1 + nu) / E * stress -
                 nu / E * stress.trace() * Eigen::Matrix3d::Identity();
        }
      Eigen::VectorXd s(6); // engineers' shear strains come out
      s << stress.diagonal(), stress(0, 1), stress(1, 2), stress(2, 0);
      Eigen::VectorXd e = material.orthotropy->compliance() * s;
      e.tail<3>() *= .5;
      return tensor(e);
    }

    Eigen::Matrix3d
    whole_strain(Eigen::Matrix3d        strain,
                 const ElasticMaterial &material,
                 const InitialStrain   &initial)
    {
      const Tensor<2, 3> own = initial.of(material.expansion);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          strain(i, j) += own[i][j];
      return strain;
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

      /** `initial`: none, or that of the point. */
      void
      append(const Eigen::Matrix3d &stress_here,
             const ElasticMaterial &material,
             const InitialStrain   *initial)
      {
        const Eigen::Vector3d of_stress = principal(stress_here);
        Eigen::Matrix3d strain_here     = elastic_strain(stress_here, material);
        if (initial != nullptr)
          strain_here = whole_strain(strain_here, material, *initial);
        append(stress, stress_here);
        von_mises.values.push_back(equivalent(stress_here));
        append(strain, strain_here);
        append(principal_stresses, of_stress);
        // The same directions make the law that of numbers.
        append(
          principal_strains,
          initial != nullptr || material.orthotropy ?
            principal(strain_here) :
            elastic_strain(of_stress.asDiagonal(), material).diagonal().eval());
      }

      /** Room for so many points. */
      void
      reserve(const std::size_t n)
      {
        for (VtuField *field : {&displacement,
                                &stress,
                                &von_mises,
                                &strain,
                                &principal_stresses,
                                &principal_strains})
          field->values.reserve(n * field->n_components);
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
    shape_of(const std::size_t n_nodes)
    {
      using Shape = VtuGrid::Shape;
      switch (n_nodes)
        {
          case 3:
            return Shape::triangle;
          case 4:
            return dim == 2 ? Shape::quadrilateral : Shape::tetrahedron;
          case 6:
            return Shape::quadratic_triangle;
          case 8:
            return Shape::hexahedron;
          case 9:
            return Shape::biquadratic_quadrilateral;
          case 10:
            return Shape::quadratic_tetrahedron;
          default:
            AssertDimension(n_nodes, 27);
            return Shape::triquadratic_hexahedron;
        }
    }

    template <int dim>
    VtuGrid
    bare_grid(const ContinuumMesh<dim> &mesh, const DrawnPoints<dim> &points)
    {
      VtuGrid grid;
      for (const auto &place : points.places)
        {
          grid.points.push_back(to_space(mesh.nodes[place.node]));
          grid.nodes_of_points.push_back(place.node);
        }
      const unsigned int n = mesh.n_cell_nodes;
      VtuIds             ids{"material_id", {}};
      auto               first = points.of_cells.begin();
      for (unsigned int c = 0; c < mesh.n_cells(); ++c, first += n)
        {
          grid.add_cell(shape_of<dim>(n), {first, first + n});
          ids.values.push_back(mesh.material_ids[c]);
        }
      grid.cell_ids = {std::move(ids)};
      return grid;
    }
  } // namespace

  template <int dim>
  VtuGrid
  draw_continuum(const ContinuumMesh<dim>         &mesh,
                 const Phases<dim>                &phases,
                 const CellShapes<dim>            &shapes,
                 const Eigen::VectorXd            &u,
                 const Eigen::VectorXd            &w,
                 const std::vector<InitialStrain> &initial)
  {
    const DrawnPoints<dim> points(mesh, phases.size());
    NodalFields            fields;
    fields.reserve(points.places.size());
    const Eigen::MatrixXd stresses =
      averaged_stresses(mesh, points, phases, shapes, w, initial);
    for (Eigen::Index i = 0; i < stresses.cols(); ++i)
      {
        const auto [phase, node] = points.places[static_cast<std::size_t>(i)];
        Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
        displacement.template head<dim>() =
          u.segment<dim>(dim * static_cast<Eigen::Index>(node));
        NodalFields::append(fields.displacement, displacement);
        fields.append(tensor(stresses.col(i)),
                      phases[phase].material,
                      initial.empty() ? nullptr : &initial[node]);
      }
    VtuGrid grid      = bare_grid(mesh, points);
    grid.point_fields = std::move(fields).all();
    return grid;
  }

  template VtuGrid
  draw_continuum<2>(const ContinuumMesh<2> &,
                    const Phases<2> &,
                    const CellShapes<2> &,
                    const Eigen::VectorXd &,
                    const Eigen::VectorXd &,
                    const std::vector<InitialStrain> &);
  template VtuGrid
  draw_continuum<3>(const ContinuumMesh<3> &,
                    const Phases<3> &,
                    const CellShapes<3> &,
                    const Eigen::VectorXd &,
                    const Eigen::VectorXd &,
                    const std::vector<InitialStrain> &);
} // namespace conetact::bodies
