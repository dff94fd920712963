// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/linear_relation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conetact::solvers
{
  namespace
  {
    using Eigen::Index;
    using Eigen::VectorXd;

    /**
     * Where no force is known beforehand, residuals are compared with this part
     * of what interferences alone would press.
     */
    constexpr double part_of_interference = 1e-4;

    /**
     * Mean diagonal entry of each node, one a node. A node that nothing holds
     * (or a rigid one) takes the mean of all.
     */
    VectorXd
    mean_diagonal(const ContactSystem &system)
    {
      const Index    n = system.n_nodes(), size = system.n_contact_unknowns();
      const VectorXd diagonal = system.diagonal();
      const double   all      = size > 0 ? diagonal.head(size).mean() : 1.;
      const double   mean     = all > 0 ? all : 1.;
      VectorXd       result(n);
      for (Index i = 0; i < n; ++i)
        {
          const Index  first = system.first[i], dim = system.n_tangents(i) + 1;
          const double m =
            diagonal.segment(first, dim).sum() / static_cast<double>(dim);
          result(i) = m > 1e-12 * mean ? m : mean;
        }
      return result;
    }

    /**
     * What the column of a motion is divided by: its norm, or the largest of
     * all if it is zero. Where contacts hardly see a motion it is half way
     * between both: in a column of one its rounding would be a motion of its
     * own, in one as small as it is what holds it would be lost in shifts of
     * the matrix.
     */
    double
    weight_of_motion(const double norm, const double largest)
    {
      constexpr double zero = 1e-12, hardly = 1e-2;
      if (norm > hardly * largest)
        return norm;
      if (norm > zero * largest)
        return std::sqrt(norm * hardly * largest);
      return largest > 0 ? largest : 1.;
    }

    void
    scale_motions(const ContactSystem &system, VectorXd &scale)
    {
      const Index n       = system.n_contact_unknowns();
      double      largest = 0;
      for (Index j = n; j < system.n_unknowns(); ++j)
        {
          scale(j) =
            scale.head(n).cwiseProduct(system.matrix.col(j).head(n)).norm();
          largest = std::max(largest, scale(j));
        }
      for (Index j = n; j < system.n_unknowns(); ++j)
        scale(j) = 1 / weight_of_motion(scale(j), largest);
    }

    constexpr double smallest_force = 1e-30; ///< a zero that divides

    /** The largest interference of the displacements q at rest. */
    double
    interference(const ContactSystem &system, const VectorXd &q)
    {
      double most = 0;
      if (q.size() > 0)
        for (Index i = 0; i < system.n_nodes(); ++i)
          most = std::max(most, -q(system.normal(i)));
      return most;
    }

    /** y += columns of A x, four at a time: one pass over y for four of A. */
    void
    add_columns(const Eigen::MatrixXd    &A,
                const std::vector<Index> &columns,
                const VectorXd           &x,
                VectorXd                 &y)
    {
      const Index n = A.rows();
      std::size_t k = 0;
      for (; k + 4 <= columns.size(); k += 4)
        {
          const double *a[4];
          double        c[4];
          for (std::size_t i = 0; i < 4; ++i)
            {
              a[i] = A.col(columns[k + i]).data();
              c[i] = x(columns[k + i]);
            }
          double *out = y.data();
          for (Index i = 0; i < n; ++i)
            out[i] +=
              c[0] * a[0][i] + c[1] * a[1][i] + c[2] * a[2][i] + c[3] * a[3][i];
        }
      for (; k < columns.size(); ++k)
        y += x(columns[k]) * A.col(columns[k]);
    }

    /* The own compliance of a node is 1 in scaled variables, and 1 + C with a
       layer: step v is to r there what v is to r without one. A layer may give
       way along its normal alone: tangents have a step of their own, and the
       law holds for any factors of both. Slopes are those without load, so that
       a step is the same in all of an increment. The scale of loads, which is
       not known yet here, does not enter. */
    std::vector<Step>
    steps_of(const LinearRelation &relation)
    {
      std::vector<Step> steps(
        static_cast<std::size_t>(relation.system().n_nodes()));
      for (std::size_t i = 0; i < steps.size(); ++i)
        {
          const Layer unloaded = relation.layer(static_cast<Index>(i), 0, 0);
          steps[i]             = {1 / (1 + unloaded.shear),
                                  1 / (1 + std::max(unloaded.by_force, 0.))};
        }
      return steps;
    }
  } // namespace



  LinearRelation::LinearRelation(std::shared_ptr<const ContactSystem> system,
                                 const bool                           scaled)
    : contact_system(std::move(system))
    , has_units(!scaled)
    , scale(contact_system->n_unknowns())
    , scaled_load(contact_system->n_unknowns())
  {
    eigen_assert(contact_system->mu.size() == contact_system->n_nodes());
    eigen_assert(contact_system->large ||
                 contact_system->matrix.rows() == contact_system->n_unknowns());
    eigen_assert(contact_system->matrix.rows() ==
                 contact_system->matrix.cols());
    if (has_units)
      {
        scale.setOnes();
        return;
      }
    const VectorXd mean = mean_diagonal(*contact_system);
    for (Index i = 0; i < mean.size(); ++i)
      scale.segment(contact_system->first[i], contact_system->n_tangents(i) + 1)
        .setConstant(1 / std::sqrt(mean(i)));
    scale_motions(*contact_system, scale);
  }



  void
  LinearRelation::set_load(const ContactProblem &problem)
  {
    eigen_assert(is(problem.system));
    eigen_assert(problem.load.size() == scale.size());
    eigen_assert(problem.offset.size() == 0 ||
                 problem.offset.size() == scale.size());
    eigen_assert(problem.reference_force >= 0);
    laws = problem.laws;
    if (has_layers())
      steps = steps_of(*this);
    // Both M = S A S and l = +-S load with S = diag(scale): u = S p, r = S^-1 d
    // in stiffness form (d = S (K S p - f)), r = S p, v = S^-1 d in the other.
    const Index n = contact_system->n_contact_unknowns();
    const Index k = contact_system->n_motions;
    scaled_load   = scale.cwiseProduct(problem.load);
    has_offset    = problem.offset.size() > 0;
    scaled_offset = has_offset ? Array(problem.offset.cwiseQuotient(scale)) :
                                 Array::Zero(scale.size());
    if (stiffness())
      scaled_load = -scaled_load;
    // Forces are f in stiffness form, b in the other; q is a displacement.
    load_force = stiffness() ? scaled_load.norm() : scaled_load.tail(k).norm();
    if (n > 0)
      {
        const double mean = scale.head(n).mean();
        load_force =
          std::max(load_force,
                   problem.reference_force * (stiffness() ? mean : 1 / mean));
      }
    if (has_units)
      return;
    // Forces over sqrt(c): in compliance form scale is sqrt(c) itself.
    const Array &given = stiffness() ? scaled_offset : scaled_load;
    // Gaps and given displacements are loads, too: all become 1 at most.
    alpha = std::max({load_force, largest(given.head(n)), 0.});
    if (load_force == 0)
      load_force = part_of_interference * interference(*contact_system, given);
    if (!(alpha > 0))
      alpha = 1;
    scaled_load /= alpha;
    scaled_offset /= alpha;
    load_force /= alpha;
  }



  /* The law in units: forces are divided by the unit of force, slopes over a
     slip or a gap multiplied by that of length over it. What the law sees of v
     comes times step(i), which is taken back here. */
  FrictionLimit
  LinearRelation::limit(const Index  i,
                        const double r_n,
                        const double slip,
                        const double gap) const
  {
    eigen_assert(i >= 0 && i < contact_system->n_nodes());
    if (!laws)
      {
        const double mu = contact_system->mu(i);
        return {mu * r_n, mu, 0};
      }
    const double  force  = unit_of_force(i);
    const double  along  = unit_of_length(i) / step(i).along;
    const double  normal = unit_of_length(i) / step(i).normal;
    FrictionLimit result =
      laws->limit(i, force * r_n, along * slip, normal * gap);
    result.value /= force;
    result.by_slip *= along / force;
    result.by_gap *= normal / force;
    return result;
  }



  Aspect
  LinearRelation::aspect(const Index  i,
                         const double r_n,
                         const double slip,
                         const double gap) const
  {
    eigen_assert(i >= 0 && i < contact_system->n_nodes());
    if (!has_ellipses())
      return {};
    const double force  = unit_of_force(i);
    const double along  = unit_of_length(i) / step(i).along;
    const double normal = unit_of_length(i) / step(i).normal;
    Aspect result = laws->aspect(i, force * r_n, along * slip, normal * gap);
    result.by_force *= force;
    result.by_slip *= along;
    result.by_gap *= normal;
    return result;
  }



  Bond
  LinearRelation::bond(const Index i, const double slip, const double gap) const
  {
    eigen_assert(i >= 0 && i < contact_system->n_nodes());
    if (!laws)
      return {};
    const double force  = unit_of_force(i);
    const double along  = unit_of_length(i) / step(i).along;
    const double normal = unit_of_length(i) / step(i).normal;
    Bond         result = laws->bond(i, along * slip, normal * gap);
    result.value /= force;
    result.by_slip *= along / force;
    result.by_gap *= normal / force;
    return result;
  }



  /* s = r_n + b(|v_t|, g), which stands in place of r_n in all of the law. */
  LinearRelation::Array
  LinearRelation::add_bonds(const Array &r, const Array &v) const
  {
    eigen_assert(r.size() == v.size());
    Array seen = r;
    for (Index i = 0; i < contact_system->n_nodes(); ++i)
      {
        const Index first = contact_system->first[i];
        const Index n     = contact_system->normal(i);
        seen(n) +=
          bond(i, v.segment(first, n - first).norm(), std::max(v(n), 0.)).value;
      }
    return seen;
  }



  void
  LinearRelation::add_layers(const Array &r, Array &v) const
  {
    eigen_assert(r.size() == v.size());
    for (Index i = 0; i < contact_system->n_nodes(); ++i)
      {
        const Index first      = contact_system->first[i];
        const Index size       = contact_system->n_tangents(i) + 1;
        v.segment(first, size) = step(i).of(size).cwiseProduct(
          see([&](const double r_n,
                  const double slip) { return layer(i, r_n, slip); },
              v.segment(first, size),
              r.segment(first, size)));
      }
  }



  Layer
  LinearRelation::layer(const Index  i,
                        const double r_n,
                        const double slip) const
  {
    eigen_assert(laws);
    eigen_assert(i >= 0 && i < contact_system->n_nodes());
    const double force = unit_of_force(i), length = unit_of_length(i);
    Layer        result = laws->layer(i, force * r_n, length * slip);
    result.closing /= length;
    result.by_force *= force / length;
    result.shear *= force / length;
    result.sheared /= length;
    return result;
  }



  LinearRelation::Array
  LinearRelation::displacements(const Array &p, const Array &d) const
  {
    eigen_assert(p.size() == d.size());
    if (stiffness())
      return p + scaled_offset;
    return d;
  }



  /* v = W r + G a + q is rounded to the size of its largest terms; W r is a
     deformation, and small beside the distances G a and q. */
  LinearRelation::Array
  LinearRelation::rounding(const Array &p) const
  {
    eigen_assert(p.size() == scale.size());
    const Index n = contact_system->n_contact_unknowns();
    const Index k = contact_system->n_motions;
    if (stiffness())
      return Array::Zero(n);
    const Array a = scale.tail(k).cwiseProduct(p.tail(k)).cwiseAbs();
    return position_rounding *
           (scaled_load.head(n).cwiseAbs() +
            scale.head(n).cwiseProduct(
              contact_system->matrix.topRightCorner(n, k).cwiseAbs() * a));
  }



  /* Displacements must not enter: they grow with the error where nothing holds
     a body, and would hide it. */
  double
  LinearRelation::force_scale(const Array &p, const Array &d) const
  {
    eigen_assert(p.size() == d.size());
    const Index n = contact_system->n_contact_unknowns();
    return std::max(
      {reactions(p, d).head(n).norm(), load_force, smallest_force});
  }



  /* y += S A S x, at 2 n operations for each column whose x is not zero. */
  void
  LinearRelation::multiply_add(const Array &x, Array &y) const
  {
    eigen_assert(x.size() == y.size());
    const Array        sx = scale.cwiseProduct(x);
    std::vector<Index> columns;
    columns.reserve(static_cast<std::size_t>(sx.size()));
    for (Index i = 0; i < sx.size(); ++i)
      if (sx(i) != 0)
        columns.push_back(i);
    if (columns.empty())
      return;

    Array product = Array::Zero(sx.size());
    // Most nodes stick or are open: then few columns count, and those that do
    // not are not read.
    if (2 * static_cast<Index>(columns.size()) > sx.size())
      product = multiply(*contact_system, sx);
    else
      add_columns(contact_system->matrix, columns, sx, product);
    y += scale.cwiseProduct(product);
  }



  void
  LinearRelation::to_scaled(const ContactState &state, Array &p, Array &d) const
  {
    eigen_assert((stiffness() ? state.r : state.v).size() == scale.size());
    const Array &dual = stiffness() ? state.r : state.v;
    if (!stiffness())
      p = state.r.cwiseQuotient(scale) / alpha;
    // v - o would have lost the digits of u to a large offset.
    else if (has_offset && state.u.size() > 0)
      p = state.u.cwiseQuotient(scale) / alpha;
    else
      p = state.v.cwiseQuotient(scale) / alpha - scaled_offset;
    d = dual.cwiseProduct(scale) / alpha;
  }



  void
  LinearRelation::from_scaled(const Array  &p,
                              const Array  &d,
                              ContactState &state) const
  {
    eigen_assert(p.size() == scale.size());
    eigen_assert(d.size() == scale.size());
    if (stiffness())
      {
        state.u = has_offset ? Array(alpha * p.cwiseProduct(scale)) : Array();
        state.v = alpha * (p + scaled_offset).cwiseProduct(scale);
        state.r = alpha * d.cwiseQuotient(scale);
        return;
      }
    state.r = alpha * p.cwiseProduct(scale);
    state.v = alpha * d.cwiseQuotient(scale);
  }



  bool
  is_frictionless(const LinearRelation &relation, const Index i)
  {
    const FrictionLimit least = relation.limit(i, 0, 0, 0);
    if (least.by_force > 0 || least.value > 0)
      return false;
    // where it is pressed by all of the load, whatever pulls at it, and at rest
    // or as fast as that load moves anything
    const double pressed = 1 + std::max(relation.bond(i, 0, 0).value, 0.);
    return !(relation.limit(i, pressed, 0, 0).value > 0) &&
           !(relation.limit(i, pressed, 1, 0).value > 0);
  }
} // namespace conetact::solvers
