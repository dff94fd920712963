// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/elements.h"

#include "conetact/bodies/continuum/element_formulation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <Eigen/Cholesky>

#include <algorithm>

namespace conetact::bodies
{
  using dealii::FEValues;
  using dealii::Tensor;

  namespace
  {
    /**
     * The dilatation is that of the whole cell, its mean (T.J.R. Hughes, Int.
     * J. Numer. Methods Engrg. 15 (1980) 1413-1418): a nearly incompressible
     * cell has one constraint instead of 2^dim. In plane strain the strain
     * along z takes its third of the change.
     */
    template <int dim>
    class BBar : public DLinearElement<dim>
    {
    public:
      using DLinearElement<dim>::DLinearElement;

    private:
      using Base = DLinearElement<dim>;
      using typename Base::Columns;
      using typename Base::StrainField;
      using typename Base::Vertices;

      bool
      is_improved() const override
      {
        return true;
      }
      void
      improve(const Vertices &, StrainField &strains) const override
      {
        using Row     = Eigen::Matrix<double, 1, Eigen::Dynamic>;
        Row    mean   = Row::Zero(strains.at_points.front().cols());
        double volume = 0;
        for (std::size_t q = 0; q < strains.weights.size(); ++q)
          {
            mean += strains.weights[q] *
                    strains.at_points[q].template topRows<3>().colwise().sum();
            volume += strains.weights[q];
          }
        mean /= volume;
        for (auto *columns : {&strains.at_points, &strains.at_vertices})
          for (Columns &e : *columns)
            {
              const Row third =
                (mean - e.template topRows<3>().colwise().sum()) / 3;
              e.template topRows<3>().rowwise() += third;
            }
      }
    };

    /**
     * Each component of the displacements has internal modes
     * @f$1 - \xi_i^2@f$ that no neighbour knows and that leave the cell
     * without internal forces (E.L. Wilson, R.L. Taylor and others, 1973).
     * Their gradients, taken with the Jacobian of the centre, have no mean
     * over the cell, so that uniform stresses are exact in distorted cells
     * (R.L. Taylor, P.J. Beresford, E.L. Wilson, Int. J. Numer. Methods
     * Engrg. 10 (1976) 1211-1219).
     */
    template <int dim>
    class IncompatibleModes : public DLinearElement<dim>
    {
    public:
      explicit IncompatibleModes(const ElasticMaterial &material)
        : DLinearElement<dim>(material)
        , centre(this->mapping,
                 this->mapping.element(),
                 dealii::QMidpoint<dim>(),
                 dealii::update_jacobians)
      {}

    private:
      using Base = DLinearElement<dim>;
      using typename Base::Columns;
      using typename Base::StrainField;
      using typename Base::Vertices;
      static constexpr int n_modes = dim * dim;
      using ModeStrains = Eigen::Matrix<double, Base::n_strains, n_modes>;

      mutable FEValues<dim> centre; ///< of the cell at hand

      /** Strains of the modes at the points of the cell at hand. */
      std::vector<ModeStrains>
      modes(const FEValues<dim> &fe_values) const
      {
        const Tensor<2, dim>     j0      = centre.jacobian(0);
        const Tensor<2, dim>     inverse = invert(j0);
        std::vector<ModeStrains> result;
        for (const unsigned int q : fe_values.quadrature_point_indices())
          {
            const auto  &p = fe_values.get_quadrature().point(q);
            const double ratio =
              determinant(j0) / fe_values.jacobian(q).determinant();
            result.push_back(
              this->strain_matrix(dim, [&](const unsigned int i) {
                return ratio * (2 * p[i] - 1) * inverse[i];
              }));
          }
        return result;
      }

      bool
      is_improved() const override
      {
        return true;
      }
      void
      improve(const Vertices &vertices, StrainField &strains) const override
      {
        using Square = Eigen::Matrix<double, n_modes, n_modes>;
        centre.reinit(this->mapping.cell_at(vertices));
        const auto of_points = modes(this->points);
        Square     k         = Square::Zero();
        Eigen::Matrix<double, n_modes, Eigen::Dynamic> f =
          Eigen::Matrix<double, n_modes, Eigen::Dynamic>::Zero(
            n_modes, strains.at_points.front().cols());
        for (std::size_t q = 0; q < of_points.size(); ++q)
          {
            const Eigen::Matrix<double, n_modes, Base::n_strains> stress =
              strains.weights[q] * of_points[q].transpose() * this->c;
            k += stress * of_points[q];
            f += stress * strains.at_points[q];
          }
        const Eigen::Matrix<double, n_modes, Eigen::Dynamic> factors =
          -k.llt().solve(f);
        const auto add = [&factors](const std::vector<ModeStrains> &g,
                                    std::vector<Columns>           &e) {
          for (std::size_t i = 0; i < e.size(); ++i)
            e[i] += g[i] * factors;
        };
        add(of_points, strains.at_points);
        if (!strains.at_vertices.empty())
          add(modes(this->nodes), strains.at_vertices);
      }
    };

    /**
     * Displacements are linear on a triangle or tetrahedron, so that strains
     * are uniform: the stiffness is a product, of sizes that are known.
     */
    template <int dim>
    class LinearSimplex : public ElementFormulation<dim>
    {
    public:
      explicit LinearSimplex(const ElasticMaterial &material)
        : Base(material,
               dealii::FE_SimplexP<dim>(1),
               dealii::QGaussSimplex<dim>(1))
      {}

      typename ElementFormulation<dim>::Matrix
      stiffness(
        const typename ElementFormulation<dim>::Vertices &x) const override
      {
        AssertDimension(x.size(), dim + 1);
        Tensor<2, dim> edges; // in rows
        for (unsigned int v = 0; v < dim; ++v)
          edges[v] = x[v + 1] - x[0];
        const Tensor<2, dim> gradients = transpose(invert(edges));
        Tensor<1, dim>       first; // all of them add up to zero
        for (unsigned int v = 0; v < dim; ++v)
          first -= gradients[v];
        const Strains b(this->strain_matrix(dim + 1, [&](const unsigned int v) {
          return v == 0 ? first : gradients[v - 1];
        }));
        const double  volume = determinant(edges) / (dim == 2 ? 2 : 6);
        const Strains stress = (volume * this->c).lazyProduct(b);

        typename Base::Matrix k(n_dofs, n_dofs);
        k.noalias() = b.transpose().lazyProduct(stress);
        // Half of it copied: symmetric to the last bit.
        k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
        return k;
      }

    private:
      using Base                  = ElementFormulation<dim>;
      static constexpr int n_dofs = dim * (dim + 1);
      using Strains = Eigen::Matrix<double, Base::n_strains, n_dofs>;
    };

    template <int dim, template <int> class Element>
    std::unique_ptr<ElementFormulation<dim>>
    create(const ElasticMaterial &material)
    {
      return std::make_unique<Element<dim>>(material);
    }

    template <int dim>
    std::unique_ptr<ElementFormulation<dim>>
    create_quadratic(const ElasticMaterial &material)
    {
      return std::make_unique<ElementFormulation<dim>>(material,
                                                       dealii::FE_Q<dim>(2),
                                                       dealii::QGauss<dim>(3));
    }

    template <int dim>
    std::unique_ptr<ElementFormulation<dim>>
    create_simplex(const ElasticMaterial &material,
                   const unsigned int     degree,
                   const unsigned int     n_points)
    {
      return std::make_unique<ElementFormulation<dim>>(
        material,
        dealii::FE_SimplexP<dim>(degree),
        dealii::QGaussSimplex<dim>(n_points));
    }
    template <int dim>
    std::unique_ptr<ElementFormulation<dim>>
    create_quadratic_simplex(const ElasticMaterial &material)
    {
      return create_simplex<dim>(material, 2, 3);
    }
    /* Round an axis strains are not uniform, and in one point a triangle would
       turn about it without strain: three points integrate r times a linear
       strain as it is. */
    template <int dim>
    std::unique_ptr<ElementFormulation<dim>>
    create_linear_simplex(const ElasticMaterial &material)
    {
      return material.is_axisymmetric() ? create_simplex<dim>(material, 1, 2) :
                                          create<dim, LinearSimplex>(material);
    }

    template <int dim>
    std::unique_ptr<ElementFormulation<dim>>
    create_b_bar(const ElasticMaterial &material)
    {
      // nothing locks where the thickness is free to change
      const bool is_free =
        dim == 2 && material.plane == ElasticMaterial::Plane::stress;
      return is_free ? create<dim, DLinearElement>(material) :
                       create<dim, BBar>(material);
    }
  } // namespace

  template <int dim>
  const std::vector<ElementRow<dim>> &
  element_table()
  {
    static const std::vector<ElementRow<dim>> table = {
      {"Q1",
       false,
       "bi- or trilinear displacements, full integration; too stiff in bending "
       "and near nu = 0.5",
       &create<dim, DLinearElement>},
      {"Q1 B-bar",
       false,
       "Q1 with one dilatation a cell, the mean, for nu near 0.5 (in plane "
       "stress, where nothing locks, it is Q1)",
       &create_b_bar<dim>},
      {"Q1 incompatible modes",
       false,
       "Q1 with internal modes, exact for bending of rectangular cells; not "
       "for bodies of revolution",
       &create<dim, IncompatibleModes>,
       // round an axis the modes would have to be without mean over r
       false},
      {"P1",
       true,
       "linear displacements on triangles or tetrahedra, uniform strains; far "
       "too stiff in bending, locks near nu = 0.5",
       &create_linear_simplex<dim>},
      {"Q2",
       false,
       "bi- or triquadratic displacements, nodes in the middle of edges, faces "
       "and cells too, on the curve where edges are bent; for bending and for "
       "stresses, nu up to 0.499; not for bodies of revolution",
       &create_quadratic<dim>,
       // a node on the axis has no area: int r N dr = 0
       false,
       2},
      {"P2",
       true,
       "quadratic displacements on triangles or tetrahedra, nodes in the middle "
       "of edges too, on the curve where these are bent; for bending and for "
       "stresses, nu up to 0.499; not for bodies of revolution",
       &create_quadratic_simplex<dim>,
       false,
       2}};
    return table;
  }

  template <int dim>
  const ElementRow<dim> &
  default_element(const bool simplices, const unsigned int degree)
  {
    const auto &table = element_table<dim>();
    return *std::find_if(table.begin(), table.end(), [&](const auto &row) {
      return row.is_simplex == simplices && row.degree == degree;
    });
  }

  template const ElementRow<2> &
  default_element<2>(const bool, const unsigned int);
  template const ElementRow<3> &
  default_element<3>(const bool, const unsigned int);

  template const std::vector<ElementRow<2>> &
  element_table<2>();
  template const std::vector<ElementRow<3>> &
  element_table<3>();
} // namespace conetact::bodies
