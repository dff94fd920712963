// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_path_analysis_h
#define conetact_analysis_path_analysis_h

#include "conetact/analysis/analysis.h"
#include "conetact/load_path/load_path.h"
#include "conetact/output/event_table.h"
#include "conetact/solvers/stiffness_form.h"

#include <optional>
#include <string>
#include <vector>

namespace conetact::analysis
{
  /** Signed gaps of contact nodes before anything acts. */
  Eigen::VectorXd
  gaps_at_start(const contact::ContactPoints &points,
                const application::Scene     &scene);

  /**
   * The load-parameter path of a scene, [P]: what acts at t = 0 is applied
   * first, then one stage up to each of the scene's times, in which the
   * parameter is t. Each event and each end of a stage becomes a record like
   * an increment's; changes of state and the outcome go to events.csv.
   */
  class PathAnalysis : public Analysis
  {
  public:
    /** Throws InputError. */
    PathAnalysis(const application::Scene &scene, Log &log);
    void
    check_history() override;
    /** Refuses contacts that depend on each other, too. */
    void
    prepare() override;
    void
    refuse_falling() const;
    /** Throws AnalysisError where the path does not converge. */
    void
    run(const std::filesystem::path &folder, const bool quiet) override;

  private:
    /** Everything that acts at an end of a stage. */
    struct Case
    {
      Eigen::VectorXd forces, mechanical; ///< nodal, all dofs [force]
      std::vector<model::Resultant> each_load;
      contact::LoadCase             load;
      Eigen::VectorXd relation; ///< load of the system, v = (u_t, g)
      Eigen::VectorXd f;        ///< total: K v = r + f with v = (u_t, g)
    };
    Case
    case_at(const double t);
    static Case
    between(const Case &a, const Case &b, const double part);

    /** In stiffness form, made when first asked for. */
    const solvers::ContactSystem &
    system();
    /** What Output/Text increments asks for. */
    void
    write_problem_texts();
    Eigen::VectorXd
    unloaded();
    /** Beside all that acts later, and all that cancels in K (0, gap). */
    bool
    is_nothing(const Case &constant);
    /** The parameter up to which what acts at t = 0 is applied with the loads
     * of the first stage. */
    double
    constant_until(const Case &constant);
    load_path::PathResult
    follow(load_path::PathFollower &follower);
    load_path::PathResult
    apply_constant_loads(load_path::PathFollower &follower,
                         Case                    &constant,
                         const double             t);
    void
    record(const load_path::PathPoint &point, const Case &at, const double t);
    void
    take_primal(const Case                 &at,
                const load_path::PathPoint &point,
                PendingIncrement           &pending);
    verification::Finding
    judge(PendingIncrement &pending, contact::SharedVector &w);
    void
    flush();
    void
    add_events(const load_path::PathPoint &point);
    void
    report_outcome(const load_path::PathResult &result);
    std::string
    node_name(const Eigen::Index i) const;
    std::string
    name(const model::IncrementRecord &record) const override;

    struct Waiting
    {
      PendingIncrement     pending;
      load_path::PathPoint point;
    };
    Eigen::VectorXd        initial_gap; ///< of each contact node, signed
    load_path::PathOptions options;
    std::optional<solvers::StiffnessForm> stiffness;
    std::vector<Waiting>                  waiting;
    load_path::PathPoint                  last; ///< of the path
    std::optional<output::EventTable>     events;
    std::filesystem::path                 folder;
    bool                                  names_are_unique; ///< node numbers
    bool                                  constant_stage = false;
    std::string                           on_the_way; ///< jumps and plateaus
    unsigned int                          n_records  = 0;
    unsigned int                          n_turns    = 0; ///< of the parameter
    double                                first_turn = 0;
  };
} // namespace conetact::analysis

#endif
