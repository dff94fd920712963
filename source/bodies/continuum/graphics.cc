// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/graphics.h"

#include "conetact/base/atomic_file.h"

#include <deal.II/base/data_out_base.h>

#include <cmath>
#include <sstream>

namespace conetact::bodies
{
  namespace
  {
    using DataRanges = std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>;

    constexpr unsigned int n_fields = 3 + 9 + 1;
    /** A row for each node: displacement, stress by rows, von Mises. */
    using NodalFields =
      Eigen::Matrix<double, Eigen::Dynamic, n_fields, Eigen::RowMajor>;

    /** Nodal fields in the form that deal.II's writers take. */
    template <int dim>
    class NodalOutput : public dealii::DataOutInterface<dim, 3>
    {
    public:
      using Patch = dealii::DataOutBase::Patch<dim, 3>;

      NodalOutput(const ContinuumMesh<dim> &mesh, const NodalFields &fields)
        : patches(mesh.n_cells())
      {
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          {
            const auto cell      = mesh.cell(c);
            Patch     &patch     = patches[c];
            patch.patch_index    = c;
            patch.reference_cell = kind(mesh.n_cell_nodes);
            patch.data.reinit(n_fields, static_cast<unsigned int>(cell.size()));
            for (unsigned int v = 0; v < cell.size(); ++v)
              {
                patch.vertices[v] = to_space(mesh.nodes[cell[v]]);
                for (unsigned int i = 0; i < n_fields; ++i)
                  patch.data(i, v) = static_cast<float>(fields(cell[v], i));
              }
          }
      }

    private:
      std::vector<Patch> patches;

      static dealii::ReferenceCell
      kind(const unsigned int n_nodes)
      {
        return n_nodes == dim + 1 ?
                 dealii::ReferenceCells::get_simplex<dim>() :
                 dealii::ReferenceCells::get_hypercube<dim>();
      }

      const std::vector<Patch> &
      get_patches() const override
      {
        return patches;
      }
      std::vector<std::string>
      get_dataset_names() const override
      {
        std::vector<std::string> names(3, "displacement");
        names.insert(names.end(), 9, "stress");
        names.push_back("von_mises");
        return names;
      }
      DataRanges
      get_nonscalar_data_ranges() const override
      {
        using namespace dealii::DataComponentInterpretation;
        return {{0, 2, "displacement", component_is_part_of_vector},
                {3, 11, "stress", component_is_part_of_tensor}};
      }
    };

    /** Sum over the cells of a node, divided by their number. */
    template <int dim>
    Eigen::MatrixXd
    averaged_stresses(const ContinuumMesh<dim> &mesh,
                      const Phases<dim>        &phases,
                      const Eigen::VectorXd    &w,
                      const Eigen::VectorXd    &temperature)
    {
      using Element           = ElementFormulation<dim>;
      const auto      n_nodes = static_cast<Eigen::Index>(mesh.nodes.size());
      Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(Element::n_strains, n_nodes);
      Eigen::VectorXd n_cells           = Eigen::VectorXd::Zero(n_nodes);
      const unsigned int              n = mesh.n_cell_nodes;
      typename Element::Displacements w_cell(dim * n);
      typename Element::Strains       initial(Element::n_strains, n);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const auto            cell    = mesh.cell(c);
          const Phase<dim>     &phase   = phases[mesh.phase(c)];
          const Eigen::VectorXd thermal = phase.material.thermal_strain(dim);
          for (unsigned int v = 0; v < n; ++v)
            {
              w_cell.template segment<dim>(dim * v) =
                w.segment<dim>(dim * static_cast<Eigen::Index>(cell[v]));
              initial.col(v) = temperature[cell[v]] * thermal;
            }
          const typename Element::Strains stresses =
            phase.element->stresses(mesh.vertices(c), w_cell, initial);
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
    von_mises(const Eigen::Matrix3d &stress)
    {
      const Eigen::Matrix3d deviator =
        stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
      return std::sqrt(1.5) * deviator.norm();
    }
  } // namespace

  template <int dim>
  void
  write_continuum(const ContinuumMesh<dim>    &mesh,
                  const Phases<dim>           &phases,
                  const Eigen::VectorXd       &u,
                  const Eigen::VectorXd       &w,
                  const Eigen::VectorXd       &temperature,
                  const double                 time,
                  const std::filesystem::path &file)
  {
    const Eigen::MatrixXd stresses =
      averaged_stresses(mesh, phases, w, temperature);
    NodalFields fields = NodalFields::Zero(stresses.cols(), n_fields);
    for (Eigen::Index i = 0; i < fields.rows(); ++i)
      {
        fields.row(i).template head<dim>() = u.segment<dim>(dim * i);
        const Eigen::Matrix3d stress       = tensor(stresses.col(i));
        fields.row(i).segment<9>(3) =
          Eigen::Map<const Eigen::Matrix<double, 1, 9>>(stress.data());
        fields(i, 12) = von_mises(stress);
      }

    NodalOutput<dim>              output(mesh, fields);
    dealii::DataOutBase::VtkFlags flags(time, 0, false);
    flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
    output.set_flags(flags);
    std::ostringstream text;
    output.write_vtu(text);
    write_atomically(file, text.str());
  }

  template void
  write_continuum<2>(const ContinuumMesh<2> &,
                     const Phases<2> &,
                     const Eigen::VectorXd &,
                     const Eigen::VectorXd &,
                     const Eigen::VectorXd &,
                     const double,
                     const std::filesystem::path &);
  template void
  write_continuum<3>(const ContinuumMesh<3> &,
                     const Phases<3> &,
                     const Eigen::VectorXd &,
                     const Eigen::VectorXd &,
                     const Eigen::VectorXd &,
                     const double,
                     const std::filesystem::path &);
} // namespace conetact::bodies
