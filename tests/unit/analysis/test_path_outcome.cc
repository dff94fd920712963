// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/analysis/path_outcome.h"

#include "scene_fixture.h"

using namespace conetact;
using namespace conetact::analysis;
using namespace conetact::contact;
using namespace conetact::load_path;

namespace
{
  PathEnd
  end(const PathOutcome outcome, const double parameter)
  {
    PathEnd end;
    end.result.outcome   = outcome;
    end.result.parameter = parameter;
    return end;
  }

  /** Foot 0 opens while foot 1 stays. */
  PathEnd
  tipping()
  {
    PathEnd limit   = end(PathOutcome::limit_load, .5);
    limit.mechanism = Mechanism{"tipping", {}, {1}, {0}};
    return limit;
  }
} // namespace



TEST(PathOutcome, Words)
{
  EXPECT_EQ(outcome_words(end(PathOutcome::target_reached, 1)),
            "target reached");
  EXPECT_EQ(outcome_words(end(PathOutcome::no_further_change, 1)),
            "no further change");
  EXPECT_EQ(outcome_words(end(PathOutcome::turning_point, 1)), "turning point");
  EXPECT_EQ(outcome_words(end(PathOutcome::not_converged, 1)), "not converged");
  PathEnd limit = tipping();
  EXPECT_EQ(outcome_words(limit), "limit load: tipping");
  limit.on_the_way = " after a jump at p = 0.25";
  limit.constant   = true;
  EXPECT_EQ(outcome_words(limit),
            "limit load: tipping after a jump at p = 0.25 under the constant "
            "loads");
  EXPECT_EQ(limit.parameter(), 0);
  EXPECT_EQ(tipping().parameter(), .5);
}



TEST(PathOutcome, SentencesNameNodesAndReasons)
{
  const auto         scene = test::make_scene(test::triangle_on_floor(
    "set Supports = top\n", test::held_top(), "|Friction coefficient = 0.2"));
  const ContactModel model(scene->bodies, {1});
  EXPECT_EQ(outcome_sentence(tipping(), model, *scene),
            "Limit load at p = 0.5, a mechanism of tipping: node 1 of contact "
            "'feet' is the pivot, node 0 of contact 'feet' lifts off.");
  PathEnd failed       = end(PathOutcome::not_converged, .25);
  failed.result.reason = "no point was found";
  EXPECT_EQ(outcome_sentence(failed, model, *scene),
            "The path is not converged at p = 0.25: no point was found. All "
            "events before it are on disk.");
  EXPECT_EQ(outcome_sentence(end(PathOutcome::target_reached, 2),
                             model,
                             *scene),
            "Target reached at p = 2.");
}



TEST(PathOutcome, NamesOfStates)
{
  EXPECT_STREQ(state_name(PathState::slip_plus), "slip+");
  EXPECT_STREQ(state_name(PathState::open_minus), "open-");
  EXPECT_STREQ(state_name(PathState::stick), "stick");
}
