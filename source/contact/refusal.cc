// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/refusal.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>

namespace conetact::contact
{
  namespace
  {
    /**
     * 1 for the body whose node it is, -1 for the master, which slips the other
     * way, 0 for others.
     */
    double
    side_of(const unsigned int body, const pairing::ContactNode &node)
    {
      if (node.body == body)
        return 1;
      return !node.masters.empty() && node.master == body ? -1 : 0;
    }

    /** Sum of the slips of a body at the contacts that stay touching. */
    Tensor<1, 3>
    slip_direction(const solvers::Existence &refusal,
                   const ContactModel       &model,
                   const unsigned int        body)
    {
      const solvers::ContactSystem &layout = model.working_set().layout();
      Tensor<1, 3>                  sum;
      for (const Eigen::Index i : refusal.tight)
        {
          const auto          k = static_cast<std::size_t>(i);
          const ContactPoint &point =
            model.points[model.working_set().nodes()[k]];
          const double sign = side_of(body, *point.node);
          for (Eigen::Index c = 0; c < layout.n_tangents(i); ++c)
            sum += sign * refusal.v[layout.first[k] + c] *
                   point.directions[static_cast<std::size_t>(c)];
        }
      return sum;
    }

    /** The rigid motion of the proof: the body that moves most. */
    RigidMotions::Motion
    rigid_motion(const solvers::Existence &refusal, const ContactModel &model)
    {
      return model.motions.motion(model.working_set()
                                    .gather(model.motions.null_space())
                                    .colPivHouseholderQr()
                                    .solve(refusal.v));
    }

    bool
    really_turns(const RigidMotions::Motion &motion)
    {
      constexpr double least = 1e-6; // of what its nodes move by
      return motion.size * motion.rotation.norm() >
             least * motion.translation.norm();
    }

    std::string
    what_happens(const solvers::Existence &refusal, const ContactModel &model)
    {
      RigidMotions::Motion motion = rigid_motion(refusal, model);
      const std::string    body   = model.bodies.called(motion.body) + " ";
      switch (refusal.motion)
        {
          // The proof dilates, as friction is not associated: its normal part
          // and its small turn are no motion of the body.
          case solvers::Motion::slides:
            motion.translation = slip_direction(refusal, model, motion.body);
            motion.rotation    = Tensor<1, 3>();
            return body + "slides " + describe(motion);
          case solvers::Motion::tips:
            motion.translation = Tensor<1, 3>();
            return body + "tips over, turning " + describe(motion);
          case solvers::Motion::turns:
            if (!really_turns(motion)) // it slides along several others
              {
                motion.translation =
                  slip_direction(refusal, model, motion.body);
                return body + "slides " + describe(motion);
              }
            motion.translation = Tensor<1, 3>();
            return body + "turns " + describe(motion);
          default:
            return body + "lifts off, moving " + describe(motion);
        }
    }

    /** Contacts that touch, and where no node has friction left. */
    std::vector<std::string>
    contacts_that_slip(const Eigen::VectorXd          &r,
                       const std::vector<std::string> &contact_names,
                       const ContactModel             &model)
    {
      constexpr double used_up = .99, presses = 1e-6; // of the largest reaction
      const solvers::ContactSystem &layout  = model.working_set().layout();
      const double                  largest = solvers::largest(r);
      std::vector<int>              slips(contact_names.size(), 0);
      for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
        {
          const Eigen::Index p =
            model.working_set().nodes()[static_cast<std::size_t>(i)];
          const double r_n = r[layout.normal(i)];
          const double r_t =
            r.segment(layout.first[i], layout.n_tangents(i)).norm();
          int &state = slips[model.points[p].node->contact];
          if (r_n <= presses * largest || layout.mu[i] == 0)
            continue;
          const bool slides = r_t >= used_up * layout.mu[i] * r_n;
          state             = slides && state >= 0 ? 1 : -1;
        }
      std::vector<std::string> result;
      for (std::size_t c = 0; c < slips.size(); ++c)
        if (slips[c] > 0)
          result.push_back("'" + contact_names[c] + "'");
      return result;
    }
  } // namespace

  solvers::ExistenceCheck
  make_existence_check(ContactModel &model)
  {
    std::vector<solvers::ExistenceCheck::Frame> frames;
    for (const Eigen::Index i : model.working_set().nodes())
      {
        const auto                    &directions = model.points[i].directions;
        solvers::ExistenceCheck::Frame frame(
          3, static_cast<Eigen::Index>(directions.size()));
        for (Eigen::Index c = 0; c < frame.cols(); ++c)
          for (unsigned int d = 0; d < 3; ++d)
            frame(d, c) = directions[static_cast<std::size_t>(c)][d];
        frames.push_back(frame);
      }
    return solvers::ExistenceCheck(model.condense().system(),
                                   std::move(frames));
  }

  Eigen::VectorXd
  resultants_of(const solvers::ContactProblem &problem, ContactModel &model)
  {
    const solvers::ContactSystem &system = *problem.system;
    Eigen::VectorXd               resultants;
    if (model.is_iterative())
      resultants = model.iterative_backend().resultants(problem.load);
    else if (system.form == solvers::Form::stiffness)
      return problem.load;
    else
      resultants = -model.motions.unresisted().transpose() *
                   problem.load.tail(system.n_motions);
    // Any f with these resultants will do: the check asks for nothing but N^T
    // f. This is the shortest.
    const Eigen::MatrixXd balance = system.null_space.transpose();
    return balance.completeOrthogonalDecomposition().solve(resultants);
  }

  std::string
  describe(const solvers::Existence &refusal, const ContactModel &model)
  {
    std::string text = what_happens(refusal, model);
    if (refusal.fraction > 1e-9)
      return text + ": of this increment's load " +
             (refusal.motion == solvers::Motion::slides ||
                  refusal.motion == solvers::Motion::turns ?
                "friction" :
                "contact") +
             " can carry at most " + to_text(refusal.fraction);
    const Eigen::VectorXd &mu   = model.points.layout().mu;
    const bool             same = mu.minCoeff() == mu.maxCoeff();
    if (refusal.friction_needed)
      return text + (same ?
                       ": a friction coefficient of " +
                         to_text(*refusal.friction_needed) +
                         " would be needed to hold it" :
                       ": friction coefficients would have to grow in "
                       "proportion, the largest to " +
                         to_text(*refusal.friction_needed) + ", to hold it");
    return text + (same ? ": no friction could hold it" :
                          ": the contacts that have friction could not hold "
                          "it whatever their coefficients");
  }

  std::string
  describe_limit(const solvers::Existence       &limit,
                 const Eigen::VectorXd          &last,
                 const std::vector<std::string> &contact_names,
                 const ContactModel             &model)
  {
    constexpr double   digits = 1e4; // more are not known
    const auto         slips  = contacts_that_slip(last, contact_names, model);
    solvers::Existence told   = limit;
    told.fraction = std::max(std::floor(digits * limit.fraction), 1.) / digits;
    return describe(told, model) +
           (slips.empty() ?
              "" :
              ", where all of contact " + join(slips) + " slips") +
           ". Apply less load" +
           (model.bodies.n_rigid > 0 ?
              "" :
              ", or let Solver/Method = load path find the limit");
  }
} // namespace conetact::contact
