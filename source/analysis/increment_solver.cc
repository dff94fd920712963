// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/increment_solver.h"

#include "conetact/analysis/cost.h"
#include "conetact/base/errors.h"
#include "conetact/base/interruption.h"
#include "conetact/base/team.h"
#include "conetact/base/text.h"
#include "conetact/solvers/large_newton.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace conetact::analysis
{
  namespace
  {
    /** Without free motions. */
    solvers::ContactState
    of_contacts(const solvers::ContactState &state, const Eigen::Index n)
    {
      return {state.v.head(n), state.r.head(n), state.node};
    }

    /** What is joined for good has no strength that could be too small. */
    bool
    has_bonded_nodes(const solvers::ContactProblem &problem)
    {
      bool any = false;
      for (Eigen::Index i = 0; i < problem.system->n_nodes(); ++i)
        any = any || problem.is_bonded(i);
      return any;
    }

    /** Whether forces, if any are known yet, are less than the rounding of what
     * displacements do. */
    bool
    is_lost_in_rounding(const solvers::ContactProblem &problem,
                        const solvers::ContactState   &start)
    {
      const solvers::ContactSystem &system = *problem.system;
      if (system.large || system.form != solvers::Form::compliance)
        return false;
      const Eigen::Index n = system.n_contact_unknowns();
      const double       force =
        std::max(problem.reference_force, solvers::largest(start.r.head(n)));
      return force > 0 && force * system.matrix.diagonal().head(n).mean() <
                            1e-13 * solvers::largest(problem.load.head(n));
    }

    std::string
    why_unsolved(const solvers::SolverReport   &report,
                 const solvers::ContactProblem &problem,
                 const solvers::ContactState   &start)
    {
      const std::string why = report.reason.empty() ?
                                "the residual is " + to_text(report.residual) :
                                report.reason;
      if (is_lost_in_rounding(problem, start))
        return why + ", for loads are less than the rounding of what the given "
                     "displacements do: give loads and displacements of sizes "
                     "that go together";
      return has_bonded_nodes(problem) ?
               why + "; where bonds give way, or fluids press bodies apart, "
                     "nothing may hold at this load: move bodies by supports, "
                     "or take smaller increments" :
               why;
    }

    /** Where all contacts are bound, foundations alone hold what floats. */
    solvers::SolverReport
    solve_motions(const solvers::ContactProblem &problem,
                  const contact::RigidMotions   &motions,
                  solvers::ContactState         &state)
    {
      state.r = -problem.system->matrix.fullPivLu().solve(problem.load);
      // what they do not resist, such as a ring's spin, stays as it is
      const Eigen::MatrixXd &loose = motions.unresisted();
      state.r -= loose * (loose.transpose() * state.r);
      state.v = Eigen::VectorXd::Zero(state.r.size());
      solvers::SolverReport report;
      report.converged  = true;
      report.solver     = "linear";
      report.iterations = report.factorizations = 1;
      return report;
    }
  } // namespace

  IncrementSolver::IncrementSolver(RunContext &r)
    : search(r.scene.sliding_contacts(), r.model)
    , fluid(r)
    , run(r)
    , solver(create_solver())
    , equilibrium(r, search.is_needed())
    , uniqueness(r, search.is_needed())
    , branches(r, search.is_needed())
  {}

  std::unique_ptr<solvers::ContactSolver>
  IncrementSolver::create_solver()
  {
    solvers::SolverOptions options = run.scene.solver;
    options.ends_early             = [this] { return leaves_slow_increment(); };
    // processes of a team see it at different times
    options.stop = [this] {
      return team().size() == 1 &&
             (is_slow ? Interruption::is_wanted() : Interruption::is_urgent());
    };
    options.is_limit = [this](const solvers::ContactState &last,
                              const double                 more) {
      Assert(problem_at_hand != nullptr, dealii::ExcInternalError());
      return equilibrium.is_limit(*problem_at_hand,
                                  *increment_at_hand,
                                  last.r,
                                  more);
    };
    return run.backend->create_solver(options, run.scene, run.model);
  }

  bool
  IncrementSolver::leaves_slow_increment()
  {
    constexpr Eigen::Index many = 300; // unknowns: fewer take no minutes
    is_slow                     = true;
    if (!start_is_known || fast_only)
      return true;
    Assert(increment_at_hand != nullptr, dealii::ExcInternalError());
    const model::IncrementRecord &record = increment_at_hand->record;
    if (run.model.points.n_unknowns() >= many &&
        std::exchange(slow_increment, record.increment) != record.increment)
      run.log.say(run.increment_name(record) +
                  ": the fast method does not find the states of contacts, "
                  "slower ones are tried, which may take minutes, above all "
                  "where there is no equilibrium");
    return wants_to_stop();
  }

  PendingIncrement
  IncrementSolver::start(const unsigned int k, const double t)
  {
    model::IncrementRecord record;
    record.increment = k;
    record.time      = t;
    if (search.is_needed())
      if (const std::string why = take(search.guess(t)); !why.empty())
        throw AnalysisError(run.increment_name(record) + " (t = " + to_text(t) +
                            "): " + why + (why.back() == '.' ? "" : "."));
    PendingIncrement increment{run.history, run.history};
    increment.record = std::move(record);
    run.apply_loads(increment);
    return increment;
  }

  Failure
  IncrementSolver::solve(PendingIncrement &increment)
  {
    if (const std::string why = search.turns_too_far(increment.record.time);
        !why.empty())
      return {why, false, true};
    return solve_from(run.history.start(), increment);
  }

  Failure
  IncrementSolver::solve_from(const solvers::ContactState &guess,
                              PendingIncrement            &increment)
  {
    increment.record.report = {};
    increment.end           = guess;
    if (guess.v.size() == 0)
      {
        increment.record.report.converged = true;
        increment.record.report.solver    = "linear";
        increment.motions                 = run.history.free_motions();
        increment.primal                  = run.history.primal();
        take_bound(increment);
        return {};
      }
    solvers::ContactProblem problem = run.history.problem(increment.load);
    if (const std::string why = equilibrium.refusal(problem, increment);
        !why.empty())
      return {why};
    find(guess, increment, problem);
    if (const solvers::SolverReport &report = increment.record.report;
        !report.converged)
      {
        if (is_slow && (!start_is_known || fast_only))
          return {"it is postponed", false, false, true};
        const std::string limit = equilibrium.limit(problem, increment);
        // Of smaller parts it is the limit, too; fluids change what is held.
        const bool has_fluid =
          std::count(increment.wet.begin(), increment.wet.end(), true) > 0;
        return {limit.empty() ? why_unsolved(report, problem, guess) +
                                  equilibrium.limit_ahead(problem, increment) :
                                limit,
                limit.empty() || has_fluid};
      }
    if (run.scene.judges_uniqueness)
      uniqueness.judge(increment, problem);
    take_result(increment, problem);
    if (run.scene.follows_branches)
      branches.follow(increment, problem);
    if (start_is_known)
      shorten_way(increment, problem);
    return {};
  }

  void
  IncrementSolver::find(const solvers::ContactState &guess,
                        PendingIncrement            &increment,
                        solvers::ContactProblem     &problem)
  {
    solvers::ContactState &state  = increment.end;
    solvers::SolverReport &report = increment.record.report;
    problem_at_hand               = &problem;
    increment_at_hand             = &increment;
    is_slow                       = false;
    report                        = problem.system->n_nodes() == 0 ?
                                      solve_motions(problem, run.model.motions, state) :
                                      solver->solve(problem, state);
    if (!report.converged && state.nearby.size() > 0 &&
        run.history.linearise_about(problem, state))
      {
        run.done.add(report);
        problem = run.history.problem(increment.load);
        state   = run.history.start();
        report  = solver->solve(problem, state);
      }
    run.done.add(report);
    let_fluid_in(guess, increment, problem);
    problem_at_hand   = nullptr;
    increment_at_hand = nullptr;
  }

  void
  IncrementSolver::let_fluid_in(const solvers::ContactState &guess,
                                PendingIncrement            &increment,
                                solvers::ContactProblem     &problem)
  {
    solvers::ContactState &state  = increment.end;
    solvers::SolverReport &report = increment.record.report;
    while (report.converged && fluid.advances(increment))
      {
        const solvers::ContactState dry = std::exchange(state, guess);
        state.r                         = dry.r;
        state.node                      = dry.node;
        problem                         = run.history.problem(increment.load);
        solvers::SolverReport wet       = solver->solve(problem, state);
        run.done.add(wet);
        add_work(wet, report);
        report = wet;
      }
  }

  void
  IncrementSolver::take_result(PendingIncrement              &increment,
                               const solvers::ContactProblem &problem)
  {
    rest_idle_bodies(increment, run.model);
    solvers::ContactState &state = increment.end;
    if (problem.system->form == solvers::Form::stiffness &&
        !problem.system->large) // which has it
      state.u = solvers::elastic_part(problem, state);
    const unsigned int number = increment.record.increment;
    if (run.scene.fclib_increments.count(number) +
          run.scene.text_increments.count(number) >
        0)
      increment.record.condensed =
        std::make_shared<const model::CondensedIncrement>(
          model::CondensedIncrement{
            solvers::with_coefficients_of(state, problem),
            increment.record.report.substeps == 1 ?
              std::optional<solvers::ContactState>(state) :
              std::nullopt});
    increment.record.errors = solvers::kanno_errors(problem, state);
    increment.base          = run.history.linearised_at();
    const contact::IncrementLaws *const laws = increment.load.laws.get();
    run.history.advance(state, increment.record.time, laws);
    if (laws != nullptr)
      run.model.points.set_friction(laws->coefficients(state));
    increment.state   = of_contacts(state, run.model.points.n_unknowns());
    increment.contact = run.history.displacements();
    increment.primal  = run.history.primal();
    increment.motions = run.history.free_motions();
    increment.after   = run.history;
    take_bound(increment);
  }

  void
  IncrementSolver::take_bound(PendingIncrement &increment)
  {
    increment.bound =
      run.model.elasticity().bound().state(increment.load, increment.primal);
  }

  contact::OpenMotions
  IncrementSolver::open_motions(const PendingIncrement &increment) const
  {
    return {run.model.motions,
            run.model.points,
            increment.state,
            run.history.largest_force(),
            increment.load.laws.get()};
  }

  void
  IncrementSolver::shorten_way(PendingIncrement              &increment,
                               const solvers::ContactProblem &problem)
  {
    const contact::OpenMotions open = open_motions(increment);
    if (!open.exist())
      return;
    const contact::Coordinates &coordinates = run.model.coordinates;
    const Eigen::VectorXd       w           = run.model.elasticity()
                                .expand({&increment.load}, {increment.primal})
                                .front();
    Eigen::VectorXd way =
      coordinates.in_frames(run.acceptance.displacements(increment, w));
    const Eigen::VectorXd &start = run.acceptance.accepted_displacements();
    way -= coordinates.in_frames(
      start.size() > 0 ? start : Eigen::VectorXd::Zero(way.size()).eval());
    const Eigen::VectorXd change = open.shortening(way);
    if (change.size() == 0)
      return;
    const double largest = run.history.largest_force();
    run.history          = increment.before;
    run.history.linearise_at(increment.base);
    run.history.move(increment.end, change, largest);
    take_result(increment, problem);
  }

  std::optional<Eigen::VectorXd>
  IncrementSolver::correct(PendingIncrement            &increment,
                           const Eigen::VectorXd       &w,
                           const verification::Finding &finding)
  {
    // the relation holds for rounded matrices; the true one leaves forces
    // unbalanced, and contacts elsewhere than the recovered displacements
    const contact::Elasticity &elastic = run.model.elasticity();
    const contact::LoadCase    change  = elastic.reduce_unbalanced(
      {run.acceptance.unbalanced(finding),
           finding.displacements.head(run.model.points.n_unknowns()) -
             increment.contact,
           finding.missed_by_bound,
           increment.motions - increment.base,
           w});
    increment.load.f += change.f;
    if (change.bound.size() > 0)
      increment.load.bound += change.bound;
    run.history = increment.before;
    run.history.linearise_at(increment.motions);
    const solvers::ContactState guess =
      elastic.states().restart(run.history.start(), increment.end);
    const unsigned int    before = increment.record.report.iterations;
    const Eigen::VectorXd old    = increment.primal;
    if (solve_from(guess, increment))
      return {};
    increment.record.report.iterations += before;
    return w + elastic.correction(change, increment.primal - old);
  }

  std::vector<model::ContactRow>
  IncrementSolver::rows_of(const AnotherSolution         &solution,
                           const contact::ContactHistory &before,
                           const PendingIncrement        &increment)
  {
    const contact::ContactHistory now   = run.history;
    PendingIncrement              other = increment;
    run.history = other.before = before;
    run.history.linearise_at(increment.base);
    other.end = solution.end;
    take_result(other, solution.problem);
    run.history = now;
    auto w      = run.model.elasticity().expand({&other.load}, {other.primal});
    return run.acceptance.rows_of(other, contact::shared(std::move(w.front())));
  }

  void
  IncrementSolver::add_other_solutions(PendingIncrement &increment)
  {
    if (increment.another)
      increment.record.other_rows =
        rows_of(*increment.another, increment.before, increment);
    if (!run.scene.follows_branches)
      return;
    increment.record.branches.clear();
    for (const Branch &branch : branches.last())
      increment.record.branches.push_back(
        {branch.number,
         branch.parent,
         rows_of(branch.solution, branch.before, increment)});
  }

  std::string
  IncrementSolver::why_it_leaves(const unsigned int k, const double t)
  {
    if (const std::string why = take(search.guess(search.time())); !why.empty())
      return why;
    PendingIncrement increment{run.history, run.history};
    increment.record.increment = k;
    increment.record.time      = t;
    run.apply_loads(increment);
    return equilibrium.refusal_where_it_stands(increment);
  }

  std::string
  IncrementSolver::take(ContactSearch::Found found)
  {
    if (std::string why = search.take(std::move(found), run.history);
        !why.empty())
      return why;
    run.acceptance.relink();
    equilibrium.reset();
    if (const std::string why = run.model.why_not(); !why.empty())
      {
        if (!fits_condensed(run.model,
                            run.scene.times.size(),
                            run.scene.n_drawings()))
          return "Contacts have slid to where Backend = iterative " + why +
                 ", and condensed bodies take more memory than this machine "
                 "has.";
        condense_from_here("Contacts have slid to where Backend = iterative " +
                           why + ".");
      }
    return {};
  }

  void
  IncrementSolver::must_take(ContactSearch::Found found)
  {
    if (const std::string why = take(std::move(found)); !why.empty())
      throw AnalysisError(why);
  }

  Failure
  IncrementSolver::solve_with(ContactSearch::Found found,
                              PendingIncrement    &increment)
  {
    const Eigen::VectorXd w =
      run.model.elasticity().states().deformation(increment.primal);
    const Eigen::VectorXd motions = increment.motions;
    run.history                   = increment.before;
    if (std::string lost = take(std::move(found)); !lost.empty())
      {
        if (lost.back() == '.') // the sentence goes on
          lost.pop_back();
        return {lost};
      }
    increment.before = run.history;
    run.apply_loads(increment);
    solvers::ContactState guess = run.history.start();
    guess.node                  = increment.end.node;
    guess.nearby                = run.history.nearby(w, motions);
    const unsigned int before   = increment.record.report.iterations;
    const Failure      failure  = solve_from(guess, increment);
    increment.record.report.iterations += before;
    return failure;
  }

  void
  IncrementSolver::forget()
  {
    equilibrium.reset();
    solver = create_solver();
  }

  void
  IncrementSolver::solve_in_parts()
  {
    solver = std::make_unique<solvers::LargeNewton>(run.scene.solver);
  }

  void
  IncrementSolver::condense_from_here(const std::string &why)
  {
    run.acceptance.gather();
    leave_to_first();
    if (!is_in_team())
      return;
    run.log.say(why +
                " From here on bodies are condensed, which has more methods.");
    run.log.time("an increment that has not been solved");
    run.backend = run.backend->otherwise;
    run.model.solve_by(*run.backend->elasticity);
    forget();
    try
      {
        run.make_elasticity();
      }
    catch (const InputError &error) // too late for one
      {
        throw AnalysisError(error.what());
      }
    run.history.see_elasticity();
  }
} // namespace conetact::analysis
