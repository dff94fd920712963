// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_solvers_automatic_h
#define conetact_solvers_automatic_h

#include "conetact/solvers/active_set.h"
#include "conetact/solvers/contact_solver.h"
#include "conetact/solvers/load_parts.h"
#include "conetact/solvers/smoothing_newton.h"
#include "conetact/solvers/stiffness_form.h"

#include <limits>
#include <optional>

namespace conetact::solvers
{
  /**
   * The order of methods that loses nothing: active set from the last states;
   * where bodies are free, the same without their motions, the shortest way out
   * of what overlaps, and springs against falls that are taken away again; a
   * few sweeps of Gauss-Seidel, then smoothing to globalise. Each ends with an
   * active set attempt to make the result exact. Where the whole increment
   * cannot be solved, the increment in parts. The
   * load of a part lies on the line between the loads at start and end,
   * @f$b(s) = b_0 + s (b_1 - b_0)@f$, where b0 follows from the state at the
   * start: @f$b_0 = K v_0 - r_0@f$ with @f$v_0 = (0, g_0)@f$ (compliance:
   * @f$b_0 = v_0 - W r_0@f$). Parts change the answer of an incremental law, so
   * they are the last resort and the report counts them. Of bodies that float
   * parts tell first whether there is a limit, beyond which no method is of
   * use; where they lead to the end, slower methods may take some hundred
   * solves to find that of the whole. They also tell what the increment comes
   * to where its end as a whole is doubtful: loose where a jam goes on, or far
   * away beyond a limit.
   */
  class Automatic : public ContactSolver
  {
  public:
    explicit Automatic(const SolverOptions &options);

    SolverReport
    solve(const ContactProblem &problem, ContactState &state) override;

  private:
    /** The increment, or a part of it, in one. */
    SolverReport
    solve_whole(const ContactProblem &problem,
                ContactState         &state,
                const bool            thorough);
    /** By active set from the last states. */
    SolverReport
    solve_fast(const ContactProblem &problem, ContactState &state);
    /** By all other methods, after that one, whose report goes on. */
    void
    solve_slowly(const ContactProblem &problem,
                 ContactState         &state,
                 const bool            thorough,
                 SolverReport         &report);
    /** What the fast method comes to in parts. */
    struct FastParts
    {
      SolverReport report; ///< substeps 0: not even the smallest part is solved
      ContactState last;
    };
    /** Whether the caller wants no other method, or none is of use. */
    bool
    ends_at_once(const ContactProblem &problem,
                 ContactState         &state,
                 FastParts            &fast,
                 SolverReport         &report);
    /** By other methods, as long as it pays; true if the fast parts are what is
     * left. */
    bool
    solve_slowly_or_in_parts(const ContactProblem &problem,
                             const FastParts      &fast,
                             ContactState         &state,
                             SolverReport         &report);

    /** Follows the increment in parts where its end is doubtful. Of a limit
     * that is reached on the way it makes a failure. */
    void
    follow_doubtful(const ContactProblem &problem,
                    const ContactState   &start,
                    ContactState         &state,
                    SolverReport         &report);
    /** What is left of a jam: by the increment as a whole if it has such an
     * end, too. */
    void
    take_jam(const ContactProblem &problem,
             const ContactState   &start,
             const ContactState   &jammed,
             SolverReport          parts,
             ContactState         &state,
             SolverReport         &report);

    /** The same from another start; true if it is solved. */
    bool
    solve_again(const ContactProblem &problem,
                ContactState         &state,
                SolverReport         &report);

    static constexpr unsigned int any_number =
      std::numeric_limits<unsigned int>::max();
    /** Active set from an estimate of the end of the increment, in at most so
     * many steps. */
    bool
    polish(const ContactProblem &problem,
           ContactState         &state,
           SolverReport         &report,
           const unsigned int    most = any_number);
    /** Smoothing from m0 on, with attempts to polish on the way. */
    bool
    smooth(const ContactProblem &problem,
           ContactState         &state,
           const double          m0,
           SolverReport         &report);
    static bool
    move_out(const ContactProblem &problem,
             ContactState         &state,
             SolverReport         &report);
    bool
    eliminate_motions(const ContactProblem &problem,
                      ContactState         &state,
                      const bool            thorough,
                      SolverReport         &report);
    bool
    stiffen(const ContactProblem &problem,
            ContactState         &state,
            SolverReport         &report);
    bool
    stiffen_from(double                softer,
                 const double          friction,
                 const ContactProblem &problem,
                 ContactState         &state,
                 SolverReport         &report) const;
    /** Some sweeps of Gauss-Seidel, then polish. */
    bool
    relax(const ContactProblem &problem,
          ContactState         &state,
          const unsigned int    sweeps,
          SolverReport         &report);

    SolverReport
    solve_in_parts(const ContactProblem &problem, ContactState &state);
    /** The same by the fast method, and by another one where it is stuck. */
    SolverReport
    solve_in_fast_parts(const ContactProblem &problem, ContactState &state);
    LoadParts
    parts_of(const ContactProblem &problem, const ContactState &state) const;

    SolverOptions                 options;
    ActiveSet                     active_set;
    unsigned int                  most_solves = any_number; ///< of slow methods
    std::optional<LinearRelation> relation;
    /** Stiffness form of the system solved last, if it was needed. */
    std::optional<StiffnessForm> eliminated;
  };

  std::unique_ptr<ContactSolver>
  make_automatic(const SolverOptions &options);
} // namespace conetact::solvers

#endif
