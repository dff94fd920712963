// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/solvers/gauss_seidel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace conetact
{
  namespace
  {
    constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
  }



  LocalCoulomb::LocalCoulomb(const Form    which,
                             const Matrix &matrix,
                             const double  friction,
                             const double  scale)
    : form(which)
    , block(matrix)
    , mu(friction)
    , n_tangents(matrix.rows() - 1)
  {
    const double floor = round_off * std::max(block.trace(), round_off * scale);
    if (form == Form::compliance)
      set_up_compliance(floor);
    else
      set_up_stiffness(floor);
  }



  /* Eigenvectors into `basis`, returns the eigenvalues. What is below `floor`
     is lifted to it, also in the block. */
  LocalCoulomb::Tangent
  LocalCoulomb::lift(const TangentMatrix &tangential, const double floor)
  {
    basis = tangential;
    if (n_tangents == 0)
      return Tangent(0);
    const Eigen::SelfAdjointEigenSolver<TangentMatrix> eigen(tangential);
    const Tangent values = eigen.eigenvalues().cwiseMax(floor);
    basis                = eigen.eigenvectors();
    block.topLeftCorner(n_tangents, n_tangents) +=
      basis * (values - eigen.eigenvalues()).asDiagonal() * basis.transpose();
    return values;
  }



  /* u_t = S r_t + c with S = W_tt - W_tn W_nt / W_nn, once r_n is eliminated
     by the closed gap. */
  void
  LocalCoulomb::set_up_compliance(const double floor)
  {
    const Eigen::Index n = n_tangents;

    block(n, n) = std::max(block(n, n), floor);
    pivot       = block(n, n);
    elimination = block.col(n).head(n) / pivot;
    const TangentMatrix schur =
      block.topLeftCorner(n, n) - elimination * block.row(n).head(n);

    stick_weight       = lift(schur, floor);
    sigma              = n > 0 ? stick_weight.maxCoeff() : 1.;
    slip_weight        = Tangent::Constant(n, sigma);
    normal_of_reaction = -basis.transpose() * elimination;
    normal_of_slip     = Tangent::Zero(n);
  }



  /* r_t = K_tt u_t - q_t with closed gap. */
  void
  LocalCoulomb::set_up_stiffness(const double floor)
  {
    const Eigen::Index n = n_tangents;

    const Tangent values = lift(block.topLeftCorner(n, n), floor);
    normal_of_slip       = basis.transpose() * block.col(n).head(n);
    elimination          = basis * normal_of_slip.cwiseQuotient(values);

    const double schur = block(n, n) - elimination.dot(block.col(n).head(n));
    pivot              = std::max(schur, floor);
    block(n, n) += pivot - schur;

    sigma              = n > 0 ? 1 / values.maxCoeff() : 1.;
    stick_weight       = Tangent::Ones(n);
    slip_weight        = values * sigma;
    normal_of_reaction = Tangent::Zero(n);
  }



  void
  LocalCoulomb::evaluate(const double theta, Slide &slide) const
  {
    const Tangent denominator =
      (1 - theta) * stick_weight + theta * slip_weight;
    const Tangent ratio = slide.load.cwiseQuotient(denominator);

    slide.r_t = -(1 - theta) * ratio;
    slide.u_t = sigma * theta * ratio;
    slide.r_n = slide.normal + normal_of_reaction.dot(slide.r_t) +
                normal_of_slip.dot(slide.u_t);
    const double length = slide.r_t.norm();
    slide.mismatch      = length - mu * slide.r_n;

    const Tangent dr_t =
      ratio.cwiseProduct(slip_weight).cwiseQuotient(denominator);
    const Tangent du_t =
      sigma * ratio.cwiseProduct(stick_weight).cwiseQuotient(denominator);
    const double dlength = length > 0 ? slide.r_t.dot(dr_t) / length : 0.;
    slide.slope =
      dlength - mu * (normal_of_reaction.dot(dr_t) + normal_of_slip.dot(du_t));
  }



  /* Newton's method within a bracket that is halved whenever it fails to
     shrink. With one tangent the mismatch times its denominator is linear. */
  void
  LocalCoulomb::find_root(Slide &slide) const
  {
    double low = 0, high = 1;
    double first = slide.mismatch;
    if (mu == 0)
      return evaluate(1, slide);
    double theta = .5;
    if (n_tangents == 1)
      {
        const double at_0 = first * stick_weight[0];
        evaluate(1, slide);
        const double at_1 = slide.mismatch * slip_weight[0];
        theta             = at_0 / (at_0 - at_1);
        return evaluate(theta, slide);
      }
    for (unsigned int i = 0; i < 100; ++i)
      {
        evaluate(theta, slide);
        (slide.mismatch > 0 ? low : high) = theta;
        const double step                 = slide.mismatch / slide.slope;
        const double next                 = theta - step;
        if (std::abs(step) <= 1e-16 * theta || slide.mismatch == 0)
          break;
        const double old = theta;
        theta = (next > low && next < high) ? next : .5 * (low + high);
        if (theta == old || high - low <= 1e-16 * high)
          break;
      }
  }



  void
  LocalCoulomb::solve(const Vector &q, Vector &v, Vector &r) const
  {
    const Eigen::Index n = n_tangents;
    const double       normal_load =
      form == Form::compliance ? q[n] : q[n] - elimination.dot(q.head(n));
    if (normal_load >= 0) // the node is open
      {
        r.setZero(n + 1);
        v = q;
        if (form == Form::stiffness)
          {
            v[n] = normal_load / pivot;
            v.head(n) =
              basis *
              (basis.transpose() * q.head(n)).cwiseQuotient(slip_weight) *
              sigma;
            v.head(n) -= elimination * v[n];
          }
        return;
      }

    Slide slide;
    if (form == Form::compliance)
      {
        slide.load   = basis.transpose() * (q.head(n) - elimination * q[n]);
        slide.normal = -q[n] / pivot;
      }
    else
      {
        slide.load   = basis.transpose() * q.head(n);
        slide.normal = -q[n];
      }
    evaluate(0, slide);
    if (slide.mismatch > 0)
      find_root(slide);

    v.resize(n + 1);
    r.resize(n + 1);
    v << basis * slide.u_t, 0;
    r << basis * slide.r_t, std::max(slide.r_n, 0.);
  }



  namespace
  {
    /**
     * The loop over the nodes. It keeps the unknown x, that is r in compliance
     * and v in stiffness form, and its image y = matrix x +- load.
     */
    class GaussSeidel : public ContactSolver
    {
    public:
      explicit GaussSeidel(const SolverOptions &given)
        : options(given)
      {}

      SolverReport
      solve(const ContactProblem &problem, ContactState &state) override;

    private:
      void
      set_up(const std::shared_ptr<const ContactSystem> &new_system);
      void
      start(const ContactProblem &problem, const ContactState &state);
      bool
      sweep();
      void
      write(const ContactProblem &problem, ContactState &state);

      SolverOptions                        options;
      std::shared_ptr<const ContactSystem> system;
      std::vector<LocalCoulomb>            local;
      Eigen::VectorXd                      x, y;
    };



    void
    GaussSeidel::set_up(const std::shared_ptr<const ContactSystem> &new_system)
    {
      if (system == new_system)
        return;
      system = new_system;
      local.clear();
      const double scale =
        system->matrix.trace() /
        static_cast<double>(std::max<Eigen::Index>(system->n_unknowns(), 1));
      for (Eigen::Index i = 0; i < system->n_nodes(); ++i)
        {
          const Eigen::Index begin = system->first[i];
          const Eigen::Index size  = system->first[i + 1] - begin;
          local.emplace_back(system->form,
                             system->matrix.block(begin, begin, size, size),
                             system->mu[i],
                             scale);
        }
    }



    void
    GaussSeidel::start(const ContactProblem &problem, const ContactState &state)
    {
      const bool             compliance = system->form == Form::compliance;
      const Eigen::VectorXd &given      = compliance ? state.r : state.v;
      const Eigen::Index     n          = system->n_unknowns();
      x = given.size() == n ? given : Eigen::VectorXd::Zero(n);
      y = system->matrix * x + (compliance ? 1. : -1.) * problem.load;
    }



    /* One pass over all nodes; false if it changed nothing at all. */
    bool
    GaussSeidel::sweep()
    {
      const bool           compliance = system->form == Form::compliance;
      bool                 changed    = false;
      LocalCoulomb::Vector v, r;
      for (Eigen::Index i = 0; i < system->n_nodes(); ++i)
        {
          const Eigen::Index         begin = system->first[i];
          const Eigen::Index         size  = system->first[i + 1] - begin;
          const LocalCoulomb::Vector own =
            local[i].matrix() * x.segment(begin, size);
          // v_i = W_ii r_i + q_i,  K_ii v_i = r_i + q_i
          const LocalCoulomb::Vector q =
            compliance ? LocalCoulomb::Vector(y.segment(begin, size) - own) :
                         LocalCoulomb::Vector(own - y.segment(begin, size));
          local[i].solve(q, v, r);
          const LocalCoulomb::Vector step =
            (compliance ? r : v) - x.segment(begin, size);
          if (step.isZero(0))
            continue;
          changed = true;
          x.segment(begin, size) += step;
          y.noalias() += system->matrix.middleCols(begin, size) * step;
        }
      return changed;
    }



    /* The image is computed afresh: increments gather round-off. */
    void
    GaussSeidel::write(const ContactProblem &problem, ContactState &state)
    {
      const bool compliance = system->form == Form::compliance;
      y       = system->matrix * x + (compliance ? 1. : -1.) * problem.load;
      state.r = compliance ? x : y;
      state.v = compliance ? y : x;
    }



    SolverReport
    GaussSeidel::solve(const ContactProblem &problem, ContactState &state)
    {
      SolverReport report;
      report.solver = "gauss-seidel";
      set_up(problem.system);
      start(problem, state);

      bool changed = true;
      while (changed && report.iterations < options.max_sweeps)
        {
          changed = sweep();
          ++report.iterations;
          // the residual costs as much as a sweep
          if (changed && report.iterations % 10 != 0 &&
              report.iterations < options.max_sweeps)
            continue;
          write(problem, state);
          if (!state.v.allFinite() || !state.r.allFinite())
            break;
          report.residual = contact_residual(problem, state);
          if (report.residual <= options.tolerance)
            {
              report.converged = true;
              state.node       = classify(problem, state);
              return report;
            }
        }
      report.reason =
        "Gauss-Seidel stopped after " + std::to_string(report.iterations) +
        " sweeps at a residual of " + std::to_string(report.residual);
      return report;
    }
  } // namespace



  std::unique_ptr<ContactSolver>
  make_gauss_seidel(const SolverOptions &options)
  {
    return std::make_unique<GaussSeidel>(options);
  }
} // namespace conetact
