// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/contact/refusal.h"

#include "conetact/base/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

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
      const solvers::ContactSystem &layout = model.points.layout();
      Tensor<1, 3>                  sum;
      for (const Eigen::Index i : refusal.tight)
        {
          const auto          k     = static_cast<std::size_t>(i);
          const ContactPoint &point = model.points[k];
          const double        sign  = side_of(body, *point.node);
          for (Eigen::Index c = 0; c < layout.n_tangents(i); ++c)
            sum += sign * refusal.v[layout.first[k] + c] *
                   point.directions[static_cast<std::size_t>(c)];
        }
      return sum;
    }

    /** The rigid motion of the proof: the body that forces drive, or that moves
     * most where none are given. */
    RigidMotions::Motion
    rigid_motion(const solvers::Existence &refusal,
                 const ContactModel       &model,
                 const Eigen::VectorXd    &forces)
    {
      const RigidMotions   &motions = model.motions;
      const Eigen::VectorXd loose =
        motions.null_space().colPivHouseholderQr().solve(refusal.v);
      const RigidMotions::Amounts amounts =
        motions.of_free(motions.unresisted() * loose);
      const RigidMotions::Motion motion =
        forces.size() > 0 ? motions.driven_most(amounts, forces) :
                            motions.largest(amounts);
      // what is tied moves alike; couplings of loads are obstacles to nobody
      return motions.in_space(amounts, motions.first_tied(motion.body));
    }

    bool
    really_turns(const RigidMotions::Motion &motion)
    {
      constexpr double least = 1e-6; // of what its nodes move by
      return motion.size * motion.rotation.norm() >
             least * motion.translation.norm();
    }

    /** Whether it goes much further than it turns. */
    bool
    mostly_translates(const RigidMotions::Motion &motion)
    {
      constexpr double little = .1;
      return motion.size * motion.rotation.norm() <
             little * motion.translation.norm();
    }

    /** The proof dilates, as friction is not associated: its normal part and
     * its small turn are no motion of the body. */
    std::string
    how_it_slides(const solvers::Existence &refusal,
                  const ContactModel       &model,
                  RigidMotions::Motion      motion)
    {
      const Tensor<1, 3> slips = slip_direction(refusal, model, motion.body);
      if (slips.norm() > 0)
        motion.translation = slips;
      motion.rotation = Tensor<1, 3>();
      return "slides " + describe(motion);
    }

  } // namespace

  std::string
  describe_motion(const solvers::Existence &refusal,
                  const ContactModel       &model,
                  const Eigen::VectorXd    &forces)
  {
    RigidMotions::Motion motion = rigid_motion(refusal, model, forces);
    const std::string    body   = model.bodies.called(motion.body) + " ";
    const bool           slides =
      refusal.motion == solvers::Motion::slides ||
      (refusal.motion == solvers::Motion::tips && mostly_translates(motion)) ||
      // along several others
      (refusal.motion == solvers::Motion::turns && !really_turns(motion));
    if (slides)
      return body + how_it_slides(refusal, model, motion);
    if (refusal.motion != solvers::Motion::tips &&
        refusal.motion != solvers::Motion::turns)
      return body + "lifts off, moving " + describe(motion);
    motion.translation = Tensor<1, 3>();
    return body +
           (refusal.motion == solvers::Motion::tips ? "tips over, turning " :
                                                      "turns ") +
           describe(motion);
  }

  namespace
  {
    /**
     * Frames let the check compare motions of nodes in space: whether all go
     * the same way tells a slide from a turn.
     */
    solvers::ExistenceCheck
    existence_check(std::shared_ptr<const solvers::ContactSystem> system,
                    const ContactModel                           &model)
    {
      std::vector<solvers::ExistenceCheck::Frame> frames;
      for (const ContactPoint &point : model.points)
        {
          const auto                    &directions = point.directions;
          solvers::ExistenceCheck::Frame frame(
            3, static_cast<Eigen::Index>(directions.size()));
          for (Eigen::Index c = 0; c < frame.cols(); ++c)
            for (unsigned int d = 0; d < 3; ++d)
              frame(d, c) = directions[static_cast<std::size_t>(c)][d];
          frames.push_back(frame);
        }
      return solvers::ExistenceCheck(std::move(system), std::move(frames));
    }

    /** All that the check asks for, with the coefficients of now. */
    std::shared_ptr<solvers::ContactSystem>
    without_matrix(const solvers::ContactSystem &all, const ContactModel &model)
    {
      auto system        = std::make_shared<solvers::ContactSystem>();
      system->form       = all.form;
      system->first      = all.first;
      system->n_motions  = all.n_motions;
      system->mu         = model.points.layout().mu;
      system->null_space = all.null_space;
      return system;
    }

    /** The free motions as only some of the nodes see them. */
    Eigen::MatrixXd
    motions_seen_by(const std::vector<bool>      &nodes,
                    const solvers::ContactSystem &all)
    {
      Eigen::MatrixXd seen = all.null_space;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (!nodes[k])
          seen.middleRows(all.first[k], all.first[k + 1] - all.first[k])
            .setZero();
      return seen;
    }

    /** Whether a node is among the nearest of its contact. */
    std::vector<bool>
    nearest_nodes(const Eigen::VectorXd &gaps, const ContactModel &model)
    {
      constexpr double               near = .01; // of a cell
      std::map<unsigned int, double> least;      // of a contact
      const auto                     at = [&](const std::size_t i) {
        return *model.points[i].node;
      };
      for (std::size_t i = 0; i < model.points.size(); ++i)
        {
          const double gap   = gaps[static_cast<Eigen::Index>(i)];
          const auto   found = least.emplace(at(i).contact, gap).first;
          found->second      = std::min(found->second, gap);
        }
      std::vector<bool> nearest;
      for (std::size_t i = 0; i < model.points.size(); ++i)
        nearest.push_back(gaps[static_cast<Eigen::Index>(i)] <=
                          least[at(i).contact] + near * at(i).spacing);
      return nearest;
    }
  } // namespace

  /* The check knows no matrix: reactions, motions and cones are all that
     equilibrium as a whole is made of. */
  solvers::ExistenceCheck
  make_existence_check(ContactModel &model, const Eigen::VectorXd &mu)
  {
    AssertDimension(mu.size(), model.points.layout().n_nodes());
    const auto system = without_matrix(*model.elasticity().system(), model);
    system->mu        = mu;
    return existence_check(system, model);
  }

  /* Motions that the nodes that hold do not see are the null space of their
     rows. A load that has a part along one of these drives it, whatever the
     nodes carry. */
  bool
  drives_what_is_not_held(const std::vector<bool> &holding,
                          const Eigen::VectorXd   &load,
                          ContactModel            &model)
  {
    constexpr double              zero = 1e-9; // of the largest
    const solvers::ContactSystem &all  = *model.elasticity().system();
    const Eigen::MatrixXd         held = motions_seen_by(holding, all);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      held.transpose() * held);
    const double          most = all.null_space.squaredNorm();
    const Eigen::VectorXd driven =
      modes.eigenvectors().transpose() * (all.null_space.transpose() * load);
    for (Eigen::Index j = 0; j < driven.size(); ++j)
      if (modes.eigenvalues()[j] <= zero * most &&
          std::abs(driven[j]) > zero * driven.norm())
        return true;
    return false;
  }

  /* As if the other nodes were not there. Loads enter by their work on the
     motions: forces on the holding nodes that do the same work stand for them,
     and there are none where these do not see all motions. */
  std::optional<solvers::Existence>
  check_by(const std::vector<bool> &holding,
           const Eigen::VectorXd   &load,
           const Eigen::VectorXd   &start,
           const double             reference_force,
           ContactModel            &model)
  {
    const solvers::ContactSystem &all    = *model.elasticity().system();
    const auto                    system = without_matrix(all, model);
    system->null_space                   = motions_seen_by(holding, all);
    const Eigen::MatrixXd balance        = system->null_space.transpose();
    const auto            solve = balance.completeOrthogonalDecomposition();
    if (solve.rank() < balance.rows())
      return {};
    const auto on_holding = [&](const Eigen::VectorXd &f) -> Eigen::VectorXd {
      return solve.solve(all.null_space.transpose() * f);
    };
    return existence_check(system, model)
      .check(on_holding(load), on_holding(start), reference_force);
  }

  std::optional<solvers::Existence>
  check_where_it_stands(const Eigen::VectorXd &gaps,
                        const Eigen::VectorXd &load,
                        const Eigen::VectorXd &start,
                        const double           reference_force,
                        ContactModel          &model)
  {
    return check_by(
      nearest_nodes(gaps, model), load, start, reference_force, model);
  }

  /* A fraction is told where the load was admissible at its start. Where not
     even that was, what is told is the friction that would be needed, all
     coefficients in proportion. */
  std::string
  describe(const solvers::Existence &refusal,
           const ContactModel       &model,
           const Eigen::VectorXd    &forces)
  {
    std::string text = describe_motion(refusal, model, forces);
    if (refusal.fraction > 1e-9)
      return text + ": of this increment's load " +
             (refusal.motion == solvers::Motion::slides ||
                  refusal.motion == solvers::Motion::turns ?
                "friction" :
                "contact") +
             " can carry at most " + to_text(refusal.fraction);
    const Eigen::VectorXd &mu   = model.points.layout().mu;
    const bool             same = mu.minCoeff() == mu.maxCoeff();
    if (!refusal.friction_needed && mu.maxCoeff() == 0)
      return text + ": the contacts, which have no friction, cannot hold it";
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
  what_slips(const Eigen::VectorXd          &r,
             const Eigen::VectorXd          &friction,
             const std::vector<std::string> &contact_names,
             const ContactModel             &model)
  {
    constexpr double used_up = .99, presses = 1e-6; // of the largest reaction
    const solvers::ContactSystem &layout  = model.points.layout();
    const double                  largest = solvers::largest(r);
    std::vector<int>              slips(contact_names.size(), 0);
    for (Eigen::Index i = 0; i < layout.n_nodes(); ++i)
      {
        const double r_t =
          r.segment(layout.first[i], layout.n_tangents(i)).norm();
        int &state = slips[model.points[i].node->contact];
        if (friction[i] <= presses * largest)
          continue;
        const bool slides = r_t >= used_up * friction[i];
        state             = slides && state >= 0 ? 1 : -1;
      }
    std::vector<std::string> result;
    for (std::size_t c = 0; c < slips.size(); ++c)
      if (slips[c] > 0)
        result.push_back("'" + contact_names[c] + "'");
    return result.empty() ? "" : "all of contact " + join(result) + " slips";
  }

  std::string
  describe_limit(const solvers::Existence       &limit,
                 const Eigen::VectorXd          &last,
                 const Eigen::VectorXd          &friction,
                 const std::vector<std::string> &contact_names,
                 const ContactModel             &model,
                 const Eigen::VectorXd          &forces)
  {
    constexpr double   digits = 1e4; // more are not known
    const std::string  slips = what_slips(last, friction, contact_names, model);
    solvers::Existence told  = limit;
    told.fraction = std::max(std::floor(digits * limit.fraction), 1.) / digits;
    return describe(told, model, forces) +
           (slips.empty() ? "" : ", where " + slips) + ". Apply less load";
  }
} // namespace conetact::contact
