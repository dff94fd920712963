// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/bodies/continuum/elements.h"

#include "conetact/bodies/continuum/quadratic_element.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace conetact::bodies
{
  using dealii::Point;
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
      using DLinearElement<dim>::DLinearElement;

    private:
      using Base = DLinearElement<dim>;
      using typename Base::Columns;
      using typename Base::StrainField;
      using typename Base::Vertices;
      static constexpr int n_modes = dim * dim;
      using ModeStrains = Eigen::Matrix<double, Base::n_strains, n_modes>;

      /** Strains of the modes at points of the unit cell. */
      std::vector<ModeStrains>
      modes(const Vertices                &vertices,
            const std::vector<Point<dim>> &unit_points) const
      {
        Point<dim> centre;
        for (int d = 0; d < dim; ++d)
          centre[d] = .5;
        const Tensor<2, dim> j0 =
          this->jacobian(vertices, this->unit_gradients(centre));
        const Tensor<2, dim>     inverse = invert(j0);
        std::vector<ModeStrains> result;
        for (const Point<dim> &p : unit_points)
          {
            const double ratio =
              determinant(j0) /
              determinant(this->jacobian(vertices, this->unit_gradients(p)));
            typename Base::template Gradients<dim> gradients;
            for (unsigned int i = 0; i < dim; ++i)
              gradients[i] = ratio * (2 * p[i] - 1) * inverse[i];
            result.push_back(this->template strain_matrix<dim>(gradients));
          }
        return result;
      }

      void
      improve(const Vertices &vertices, StrainField &strains) const override
      {
        using Square         = Eigen::Matrix<double, n_modes, n_modes>;
        const auto of_points = modes(vertices, this->points);
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
          add(modes(vertices, this->corners), strains.at_vertices);
      }
    };

    template <int dim, template <int> class Element>
    std::unique_ptr<ElementFormulation<dim>>
    create(const ElasticMaterial &material)
    {
      return std::make_unique<Element<dim>>(material);
    }

    template <int dim, bool is_simplex>
    std::unique_ptr<ElementFormulation<dim>>
    create_quadratic(const ElasticMaterial &material)
    {
      return std::make_unique<QuadraticElement<dim>>(material, is_simplex);
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
       &create<dim, LinearElement>},
      {"Q2",
       false,
       "bi- or triquadratic displacements, nodes in the middle of edges, faces "
       "and cells too, on the curve where edges are bent; for bending and for "
       "stresses, nu up to 0.499; not for bodies of revolution",
       &create_quadratic<dim, false>,
       // a node on the axis has no area: int r N dr = 0
       false,
       2},
      {"P2",
       true,
       "quadratic displacements on triangles or tetrahedra, nodes in the middle "
       "of edges too, on the curve where these are bent; for bending and for "
       "stresses, nu up to 0.499; not for bodies of revolution",
       &create_quadratic<dim, true>,
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
