// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/cell_stresses.h"

namespace conetact::bodies
{
  namespace
  {
    template <int dim>
    class CellStresses
    {
    public:
      using Element = ElementFormulation<dim>;
      using Strains = typename Element::Strains;

      CellStresses(const ContinuumMesh<dim>         &m,
                   const Phases<dim>                &p,
                   const CellShapes<dim>            &s,
                   const Eigen::VectorXd            &displacements,
                   const std::vector<InitialStrain> &strains)
        : mesh(m)
        , phases(p)
        , shapes(s)
        , w(displacements)
        , initial(strains)
        , n_dofs(dim * static_cast<Eigen::Index>(mesh.n_cell_nodes))
        , n_stresses(Element::n_strains *
                     static_cast<Eigen::Index>(mesh.n_cell_nodes))
        , n_given(n_dofs + (initial.empty() ? 0 : n_stresses))
        , maps(shapes.all().size())
      {}

      void
      visit(const StressVisitor<dim> &visitor)
      {
        Eigen::MatrixXd given, stresses;
        shapes.for_each_run([&](const unsigned int first,
                                const unsigned int end) {
          given.resize(n_given, end - first);
          for (unsigned int cell = first; cell < end; ++cell)
            take(cell, given.col(cell - first));
          const unsigned int shape = shapes.of(first);
          const unsigned int n     = shapes.all()[shape].n_cells;
          if (n > static_cast<unsigned int>(n_given))
            stresses.noalias() = map_of(shape) * given;
          else
            {
              stresses.resize(n_stresses, end - first);
              for (unsigned int cell = first; cell < end; ++cell)
                stresses.col(cell - first) =
                  one_by_one(cell, given.col(cell - first));
            }
          for (unsigned int cell = first; cell < end; ++cell)
            visitor(cell,
                    Eigen::Map<const Strains>(stresses.col(cell - first).data(),
                                              Element::n_strains,
                                              static_cast<Eigen::Index>(
                                                mesh.n_cell_nodes)));
        });
      }

    private:
      /** What the stresses of a cell depend on. */
      void
      take(const unsigned int cell, Eigen::Ref<Eigen::VectorXd> given) const
      {
        const auto   nodes     = mesh.cell(cell);
        const double expansion = phases[mesh.phase(cell)].material.expansion;
        Eigen::Index v         = 0;
        for (const unsigned int node : nodes)
          {
            given.template segment<dim>(dim * v) =
              w.template segment<dim>(dim * static_cast<Eigen::Index>(node));
            if (!initial.empty())
              given.template segment<Element::n_strains>(
                n_dofs + Element::n_strains * v) =
                strain_components(initial[node].of(expansion), dim);
            ++v;
          }
      }
      /** One node behind another. */
      Eigen::VectorXd
      one_by_one(const unsigned int cell, const Eigen::VectorXd &given) const
      {
        Strains strains =
          Strains::Zero(Element::n_strains,
                        static_cast<Eigen::Index>(mesh.n_cell_nodes));
        strains.reshaped().head(n_given - n_dofs) =
          given.tail(n_given - n_dofs);
        return phases[mesh.phase(cell)]
          .element->stresses(mesh.vertices(cell), given.head(n_dofs), strains)
          .reshaped();
      }
      const Eigen::MatrixXd &
      map_of(const unsigned int shape)
      {
        Eigen::MatrixXd &map = maps[shape];
        if (map.size() > 0)
          return map;
        map.resize(n_stresses, n_given);
        for (Eigen::Index j = 0; j < n_given; ++j)
          map.col(j) = one_by_one(shapes.all()[shape].first_cell,
                                  Eigen::VectorXd::Unit(n_given, j));
        return map;
      }

      const ContinuumMesh<dim>         &mesh;
      const Phases<dim>                &phases;
      const CellShapes<dim>            &shapes;
      const Eigen::VectorXd            &w;
      const std::vector<InitialStrain> &initial;
      const Eigen::Index                n_dofs, n_stresses; ///< of a cell
      const Eigen::Index                n_given;
      std::vector<Eigen::MatrixXd>      maps; ///< of shapes, once asked for
    };
  } // namespace



  template <int dim>
  void
  for_each_stress(const ContinuumMesh<dim>         &mesh,
                  const Phases<dim>                &phases,
                  const CellShapes<dim>            &shapes,
                  const Eigen::VectorXd            &w,
                  const std::vector<InitialStrain> &initial,
                  const StressVisitor<dim>         &visit)
  {
    CellStresses<dim>(mesh, phases, shapes, w, initial).visit(visit);
  }

  template void
  for_each_stress<2>(const ContinuumMesh<2> &,
                     const Phases<2> &,
                     const CellShapes<2> &,
                     const Eigen::VectorXd &,
                     const std::vector<InitialStrain> &,
                     const StressVisitor<2> &);
  template void
  for_each_stress<3>(const ContinuumMesh<3> &,
                     const Phases<3> &,
                     const CellShapes<3> &,
                     const Eigen::VectorXd &,
                     const std::vector<InitialStrain> &,
                     const StressVisitor<3> &);
} // namespace conetact::bodies
