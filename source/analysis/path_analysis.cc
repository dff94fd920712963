// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/path_analysis.h"

#include "conetact/analysis/mechanism_files.h"
#include "conetact/analysis/path_outcome.h"
#include "conetact/application/method_checks.h"
#include "conetact/base/errors.h"
#include "conetact/base/interruption.h"
#include "conetact/base/text.h"
#include "conetact/output/csv.h"
#include "conetact/output/problem_texts.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace conetact::analysis
{
  namespace
  {
    /** Reactions below this part of the largest are those of open nodes. */
    constexpr double path_noise = 1e-12;

    bool
    numbers_are_unique(const contact::ContactPoints &points)
    {
      std::set<unsigned int> numbers;
      for (const contact::ContactPoint &point : points)
        if (!numbers.insert(point.node->node).second)
          return false;
      return true;
    }

    /** What to do about an error that is rounding; empty: it is another. */
    std::string
    advice(const verification::Finding &finding,
           const double                 tolerance,
           const std::string           &shared)
    {
      constexpr double rounding = 1e-6;
      const double     error = std::max(finding.residual, finding.equilibrium);
      if (!(error > tolerance && error < rounding))
        return {};
      return ", which is more than Solver/Tolerance = " + to_text(tolerance) +
             ". Errors this small are mostly rounding of the condensed "
             "stiffness that a path is followed with" +
             (shared.empty() ? ": " :
                               ", which is large where a node stands in "
                               "several contacts, as " +
                                 shared + ": take it out of all but one, or ") +
             "set Solver/Tolerance to " +
             to_text(std::pow(10., std::ceil(std::log10(error))));
    }
  } // namespace



  PathAnalysis::PathAnalysis(const application::Scene &s, Log &l)
    : Analysis(s, l)
    , initial_gap(gaps_at_start(model.points, scene))
    , names_are_unique(numbers_are_unique(model.points))
  {
    options.law       = scene.path.law;
    options.tolerance = scene.solver.tolerance;
    options.cohesion.resize(initial_gap.size());
    Eigen::Index i = 0;
    for (const contact::ContactPoint &point : model.points)
      options.cohesion[i++] = point.node->cohesion;
    if (initial_gap.size() == 0)
      throw InputError("Solver/Method: supports hold all contact nodes, or "
                       "they are bound or face nothing, so that no contact "
                       "state can change. Choose automatic.");
  }



  void
  PathAnalysis::check_history()
  {
    application::check_linear_stages(scene, scene.times);
    Analysis::check_history();
    refuse_falling();
  }



  void
  PathAnalysis::prepare()
  {
    Analysis::prepare();
    system();
  }



  const solvers::ContactSystem &
  PathAnalysis::system()
  {
    if (!stiffness)
      {
        stiffness.emplace(model.elasticity().system());
        if (!stiffness->exists())
          throw InputError(why_dependent(model, scene));
      }
    return *stiffness->system();
  }



  PathAnalysis::Case
  PathAnalysis::case_at(const double t)
  {
    PendingIncrement pending{history, history};
    pending.record.time = t;
    apply_loads(pending);
    Case result;
    result.forces         = *pending.forces;
    result.mechanical     = *pending.mechanical;
    result.each_load      = pending.record.each_load;
    result.load           = pending.load;
    Eigen::VectorXd start = result.load.offset;
    for (Eigen::Index i = 0; i < system().n_nodes(); ++i)
      start[system().normal(i)] += initial_gap[i];
    result.relation = result.load.f;
    if (model.condensed_form() == solvers::Form::compliance)
      result.relation.head(start.size()) += start;
    else
      result.relation += multiply(system(), start);
    result.f = stiffness->load(result.relation);
    return result;
  }



  PathAnalysis::Case
  PathAnalysis::between(const Case &a, const Case &b, const double part)
  {
    Assert(part >= 0 && part <= 1, dealii::ExcMessage("A part of the way."));
    AssertDimension(a.each_load.size(), b.each_load.size());
    const auto mean = [&](const Eigen::VectorXd &x, const Eigen::VectorXd &y) {
      return Eigen::VectorXd(x + part * (y - x));
    };
    Case result;
    result.forces     = mean(a.forces, b.forces);
    result.mechanical = mean(a.mechanical, b.mechanical);
    for (std::size_t i = 0; i < a.each_load.size(); ++i)
      {
        const model::Resultant &x = a.each_load[i], &y = b.each_load[i];
        result.each_load.push_back({x.force + part * (y.force - x.force),
                                    x.moment + part * (y.moment - x.moment)});
      }
    if (a.load.deforms() && b.load.deforms())
      result.load.prescribed = mean(a.load.prescribed, b.load.prescribed);
    else if (b.load.deforms())
      result.load.prescribed = part * b.load.prescribed;
    else if (a.load.deforms())
      result.load.prescribed = (1 - part) * a.load.prescribed;
    result.load.b         = mean(a.load.b, b.load.b);
    result.load.f         = mean(a.load.f, b.load.f);
    result.load.q         = mean(a.load.q, b.load.q);
    result.load.bound     = mean(a.load.bound, b.load.bound);
    result.load.offset    = mean(a.load.offset, b.load.offset);
    result.load.placement = mean(a.load.placement, b.load.placement);
    result.relation       = mean(a.relation, b.relation);
    result.f              = mean(a.f, b.f);
    return result;
  }



  void
  PathAnalysis::run(const std::filesystem::path &f, const bool quiet)
  {
    folder = f;
    MechanismFiles(model, folder).remove();
    create_outputs(folder, 0, quiet);
    events.emplace(folder);
    write_problem_texts();
    Eigen::VectorXd gap = initial_gap.cwiseMax(0.);
    const auto      follower =
      (scene.bodies.dim == 2 ?
         load_path::make_event_follower :
         load_path::make_bracketing_follower)(stiffness->system(),
                                              gap,
                                              options);
    load_path::PathResult result;
    try
      {
        result = follow(*follower);
        flush();
      }
    catch (const AnalysisError &)
      {
        events->finish(last.parameter, "not converged"); // whole, as it is
        throw;
      }
    report_outcome(result);
  }



  /* All of them before the first is followed: they stand alone. */
  void
  PathAnalysis::write_problem_texts()
  {
    if (scene.text_increments.empty())
      return;
    solvers::StoredProblem stored;
    stored.problem.system = stiffness->system();
    stored.problem.gap    = initial_gap.cwiseMax(0.);
    if (solvers::largest(options.cohesion) > 0)
      stored.cohesion = options.cohesion;
    const auto write = [&](const unsigned int     number,
                           const Eigen::VectorXd &from,
                           const Eigen::VectorXd &to) {
      stored.problem.load = from;
      stored.rate         = (to - from) / (stored.end - stored.begin);
      output::write_problem_text(folder, number, stored);
    };
    Case            begin   = case_at(0);
    Eigen::VectorXd f       = begin.f;
    Eigen::VectorXd nothing = multiply(system(), unloaded());
    if (!is_nothing(begin))
      write(0, nothing, f);
    stored.end = 0;
    for (unsigned int k = 1; k <= scene.times.size(); ++k)
      {
        stored.begin               = stored.end;
        stored.end                 = scene.times[k - 1];
        const Eigen::VectorXd next = case_at(stored.end).f;
        if (scene.text_increments.count(k) > 0)
          write(k, f, next);
        f = next;
      }
  }



  load_path::PathResult
  PathAnalysis::follow(load_path::PathFollower &follower)
  {
    Case   begin = case_at(0);
    double start = constant_until(begin);
    if (start > 0)
      begin = between(begin, case_at(scene.times[0]), start / scene.times[0]);
    load_path::PathResult result = apply_constant_loads(follower, begin, start);
    for (const double end : scene.times)
      {
        if (result.outcome != load_path::PathOutcome::target_reached &&
            result.outcome != load_path::PathOutcome::no_further_change)
          return result;
        Case         next   = case_at(end);
        const double length = end - start;
        result              = follower.follow(
          {begin.f, (next.f - begin.f) / length, start, end},
          [&](const load_path::PathPoint &point) {
            record(point,
                   between(begin, next, (point.parameter - start) / length),
                   point.parameter);
          });
        begin = std::move(next);
        start = end;
      }
    return result;
  }



  void
  PathAnalysis::record(const load_path::PathPoint &point,
                       const Case                 &at,
                       const double                t)
  {
    // Nodes that touch before anything acts get their states at p = 0.
    if (n_records == 0 && t == 0 && !point.changes.empty())
      {
        last = point;
        return add_events(point);
      }
    PendingIncrement pending{history, history};
    pending.forces                 = contact::shared(at.forces);
    pending.mechanical             = contact::shared(at.mechanical);
    pending.load                   = at.load;
    model::IncrementRecord &record = pending.record;
    record.each_load               = at.each_load;
    record.increment               = ++n_records;
    record.time                    = t;
    record.report.converged        = true;
    record.report.solver           = "load path";
    record.report.iterations       = 1;
    pending.contact                = point.v;
    pending.state.v                = point.v - last.v;
    pending.state.r                = point.r;
    const double zero              = path_noise * solvers::largest(point.r);
    const double rest              = path_noise * solvers::largest(point.v);
    for (Eigen::Index i = 0; i < system().n_nodes(); ++i)
      {
        const Eigen::Index k = system().normal(i);
        const double       slip =
          pending.state.v
            .segment(system().first[static_cast<std::size_t>(i)],
                     system().n_tangents(i))
            .norm();
        pending.state.v[k] = point.v[k];
        pending.contact[k] -= initial_gap[i];
        pending.state.node.push_back(point.r[k] <= zero ?
                                       solvers::NodeState::open :
                                     slip > rest ? solvers::NodeState::slip :
                                                   solvers::NodeState::stick);
        if (pending.state.node.back() == solvers::NodeState::open &&
            options.cohesion[i] == 0) // but for rounding
          pending.state.r
            .segment(system().first[static_cast<std::size_t>(i)],
                     system().n_tangents(i) + 1)
            .setZero();
      }
    take_primal(at, point, pending);
    waiting.push_back({std::move(pending), point});
    last                    = point;
    last.parameter          = t;
    const std::string words = std::string(" after a ") +
                              (point.jump ? "jump" : "plateau") +
                              " at p = " + to_text(t);
    // several at one load are one to users
    const bool is_told =
      (on_the_way + " ").find(words + " ") != std::string::npos;
    if ((point.jump || point.plateau) && !is_told)
      on_the_way += words;
    const bool stops = Interruption::is_wanted();
    if (stops || waiting.size() >= most_at_once())
      flush();
    if (stops)
      Interruption::stop(interrupted_path(n_records, t, folder));
  }



  void
  PathAnalysis::take_primal(const Case                 &at,
                            const load_path::PathPoint &point,
                            PendingIncrement           &pending)
  {
    pending.motions = Eigen::VectorXd::Zero(model.motions.n_free());
    if (model.condensed_form() == solvers::Form::stiffness)
      {
        pending.primal = pending.contact - at.load.offset;
        return;
      }
    pending.motions = stiffness->motions(at.relation, point.v, pending.state.r);
    pending.primal.resize(point.r.size() + pending.motions.size());
    pending.primal << pending.state.r, pending.motions;
    pending.bound =
      model.elasticity().bound().state(pending.load, pending.primal);
  }



  /* Forces that the recovered displacements leave unbalanced strain the bodies
     a little more, at the same reactions. */
  verification::Finding
  PathAnalysis::judge(PendingIncrement &pending, contact::SharedVector &w)
  {
    verification::Finding finding = acceptance.judge(pending, w);
    for (unsigned int step = 0;
         step < 2 && finding.equilibrium > .1 * scene.solver.tolerance;
         ++step)
      {
        contact::Elasticity    &elastic = model.elasticity();
        const contact::LoadCase change =
          elastic.reduce_unbalanced({acceptance.unbalanced(finding),
                                     {},
                                     finding.missed_by_bound,
                                     {},
                                     {}});
        const auto refined = contact::shared(
          *w +
          elastic.correction(change,
                             Eigen::VectorXd::Zero(pending.primal.size())));
        PendingIncrement better = pending;
        if (change.bound.size() > 0)
          better.load.bound += change.bound;
        better.bound = elastic.bound().state(better.load, better.primal);
        verification::Finding found = acceptance.judge(better, refined);
        if (!(found.equilibrium < .5 * finding.equilibrium) ||
            found.residual > std::max(finding.residual, scene.solver.tolerance))
          break;
        pending = std::move(better);
        finding = std::move(found);
        w       = refined;
      }
    return finding;
  }



  void
  PathAnalysis::flush()
  {
    if (waiting.empty())
      return;
    std::vector<const contact::LoadCase *> cases;
    std::vector<Eigen::VectorXd>           primal;
    for (const Waiting &w : waiting)
      {
        cases.push_back(&w.pending.load);
        primal.push_back(w.pending.primal);
      }
    acceptance.set_stiffness(model.elasticity());
    const std::vector<Eigen::VectorXd> w =
      model.elasticity().expand(cases, primal);
    std::vector<model::IncrementRecord> finished;
    std::string                         failure;
    for (std::size_t i = 0; i < waiting.size() && failure.empty(); ++i)
      {
        PendingIncrement           &pending = waiting[i].pending;
        contact::SharedVector       wi      = contact::shared(w[i]);
        const verification::Finding finding = judge(pending, wi);
        const std::string           why     = complete(pending, finding, wi);
        if (why.empty())
          finished.push_back(std::move(pending.record));
        else
          failure =
            failed(pending.record,
                   why + advice(finding,
                                scene.solver.tolerance,
                                node_in_several_contacts(model, scene)));
      }
    write(finished);
    for (std::size_t i = 0; i < finished.size(); ++i)
      add_events(waiting[i].point);
    events->write();
    waiting.clear();
    if (!failure.empty())
      throw AnalysisError(failure);
  }



  void
  PathAnalysis::add_events(const load_path::PathPoint &point)
  {
    std::vector<output::EventTable::Change> changes;
    for (const load_path::PathChange &change : point.changes)
      changes.push_back({node_name(change.node),
                         state_name(change.from),
                         state_name(change.to)});
    if (!changes.empty() || point.turn)
      events->add(point.parameter, changes, load_name(point));
    if (point.turn && n_turns++ == 0)
      first_turn = point.parameter;
  }



  void
  PathAnalysis::report_outcome(const load_path::PathResult &result)
  {
    PathEnd end{result, {}, on_the_way, constant_stage, n_turns, first_turn};
    if (result.outcome == load_path::PathOutcome::limit_load)
      {
        std::vector<bool> touching;
        for (std::size_t i = 0; i < model.points.size(); ++i)
          touching.push_back(last.state.empty() ||
                             last.state[i] != load_path::PathState::open);
        end.mechanism =
          contact::name_mechanism(model, result.mechanism, touching);
        MechanismFiles(model, folder).write(result.mechanism, end.parameter());
      }
    const std::string sentence = outcome_sentence(end, model, scene);
    events->finish(end.parameter(), outcome_words(end));
    if (result.outcome == load_path::PathOutcome::not_converged)
      throw AnalysisError(sentence);
    log.say(sentence);
  }



  std::string
  PathAnalysis::node_name(const Eigen::Index i) const
  {
    const pairing::ContactNode &node   = *model.points[i].node;
    const std::string           number = std::to_string(node.node);
    return names_are_unique ? number :
                              scene.contact_names[node.contact] + ":" + number;
  }



  std::string
  PathAnalysis::name(const model::IncrementRecord &record) const
  {
    return "Point " + std::to_string(record.increment) + " of the path";
  }
} // namespace conetact::analysis
