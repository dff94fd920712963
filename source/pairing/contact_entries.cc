// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/contact_entries.h"

#include "conetact/base/errors.h"
#include "conetact/base/text.h"
#include "conetact/pairing/contact_nodes.h"
#include "conetact/pairing/kinematics.h"

#include <algorithm>

namespace conetact::pairing
{
  namespace
  {
    /** The way of pairing that each kind of contact has by itself. */
    const std::string by_kind = "automatic";

    void
    declare_kind(dealii::ParameterHandler &prm)
    {
      std::vector<std::string> names;
      std::string              kinds;
      for (const KindRow &row : contact_kinds())
        {
          names.push_back(row.name);
          kinds +=
            (kinds.empty() ? "" : "; ") + row.name + ": " + row.description;
        }
      prm.declare_entry(
        "Kind",
        names.front(),
        dealii::Patterns::Selection(join(names, "|")),
        "What holds between both sides, from the undeformed state on. " +
          kinds +
          ". Ties and bilateral contacts have reactions of any sign and take "
          "no friction, Prestress or Cohesion; an obstacle serves as a master "
          "body does; nodes of frames stay free to turn. [-]");
    }

    void
    declare_pairing(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      std::vector<std::string> names = {by_kind};
      std::string              ways;
      for (const PairingRow &row : pairings())
        {
          names.push_back(row.name);
          ways += "; " + row.name + ": " + row.description;
        }
      std::string own;
      for (const KindRow &row : contact_kinds())
        own +=
          (own.empty() ? "" : ", ") + row.pairing + " for Kind = " + row.name;
      prm.declare_entry(
        "Pairing",
        by_kind,
        Selection(join(names, "|")),
        "How nodes find what they touch on a master body. " + by_kind + ": " +
          own + ways +
          ". Frames, and nodes at edges and corners that meet a "
          "face, are paired node to face always. [-]");
      prm.declare_entry(
        "Sharp edge angle",
        "40",
        Anything(),
        "Where faces of the body turn by more than this at a node, the node "
        "has a normal and a contact for each side of the edge. Where they "
        "turn by less, it has one mean normal. Faces oppose each other up to "
        "half of it (mortar only; beyond, up to the Largest angle, node to "
        "face). 0 to 90. [degrees]");
      prm.declare_entry(
        "Largest angle",
        "60",
        Anything(),
        "A node meets a master's face only if an outward normal "
        "of the node's own faces and the reversed one of that "
        "face differ by at most this, from 0 to 90; so tops are "
        "not paired with bottoms where all boundary ids are "
        "given. [degrees]");
      prm.declare_entry(
        "Largest interference",
        "",
        Anything(),
        "Nodes may start this deep in the obstacle or the master "
        "body; deeper ones are an error, for most often a body "
        "is out of place. Give the overlap of a press fit here: nodes that "
        "start inside, deeper than facets stand off, are warned of where "
        "the entry is empty. "
        "Empty: a quarter of the longest edge of the faces that "
        "meet, which the facets of curved surfaces need. A Gap "
        "that is written down is not limited. [length]");
      prm.declare_entry("Gap",
                        "",
                        Anything(),
                        "Gap to the master body as a function of x, y, z and "
                        "t; negative: an interference, as of a press fit. "
                        "Ties and bilateral contacts close it. adjust, with an "
                        "obstacle, too: 0 at nodes that are drawn to touch, "
                        "which are those whose gap, positive or negative, is "
                        "within one and a half times of how far the plane "
                        "facets of both sides stand off curved surfaces; "
                        "others keep the gap that is drawn. An interference "
                        "that small has to be written down. Empty: from "
                        "geometry; ties and bilateral contacts keep that as "
                        "it is. [length]");
    }

    void
    declare_preload(dealii::ParameterHandler &prm)
    {
      const auto declare =
        [&](const char *key, const char *value, const char *text) {
          prm.declare_entry(key, value, dealii::Patterns::Anything(), text);
        };
      declare("Preload",
              "",
              "Kind = tie: the tension across it, a function of t, as of a "
              "bolt that is cut in two and tightened. The sides slip over "
              "each other along Preload axis, all nodes by the same length, "
              "until this force draws them together; otherwise they stay "
              "tied. Give the force of the part that is modelled: half of it "
              "for half a bolt. The closing lines on the screen and "
              "increments.csv tell tension and shortening. Empty: none. "
              "[force]");
      declare("Preload axis",
              "",
              "Direction of the Preload, of any length and either sense. "
              "Empty: the normal of the faces, which must be plane.");
      declare("Preload locked from",
              "",
              "From this time on the shortening by the Preload stays as it "
              "is, as when the nut is no longer turned, and the tension "
              "follows what happens to the joint. An increment must end at "
              "this time. Empty: the force stays prescribed. [time]");
    }

    void
    declare_friction(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      prm.declare_entry("Friction coefficient",
                        "0",
                        Anything(),
                        "Coulomb's mu, 0 or more; mu in [K] (5). A function of "
                        "x, y, z (undeformed place), t, T (change of the "
                        "temperature of Body there), s (way slipped so far), p "
                        "(pressure) and v (slip of the increment over its "
                        "time): 0.2 + 0.1*exp(-s/0.5), table(p; 0 : 0.5; 100 : "
                        "0.3), if(t < 1, 0, 0.2). Of s the value at the start "
                        "of the increment counts, of the others that at its "
                        "end. [-]");
      prm.declare_entry("Shear limit",
                        "",
                        Anything(),
                        "Largest traction of friction, whatever the pressure "
                        "(Tresca): |traction| <= min(mu p, limit). It is a "
                        "function of x, y, z, t, T, s, and may fall to 0, as "
                        "mu may; values below 0 count as 0. Empty: none. "
                        "[stress]");
      prm.declare_entry("Second friction coefficient",
                        "",
                        Anything(),
                        "Friction coefficient across the first axis, for an "
                        "elliptic cone ([K] remark 3.3; 3D): what slips does "
                        "so along the normal of the ellipse. A function as "
                        "Friction coefficient, which is that along the first "
                        "axis then; a Shear limit bounds both, and Cohesion "
                        "adds to both. Empty: isotropic. [-]");
      prm.declare_entry("Friction angle",
                        "0",
                        Anything(),
                        "Angle of the first axis from the tangent t1 towards "
                        "t2, for an elliptic cone. [degrees]");
      prm.declare_entry(
        "Prestress",
        "0",
        Anything(),
        "Force that presses the two sides together at each "
        "contact node from t = 0 on, 0 or more, a function of x, "
        "y, z; the prestress of [P], whose tightening weight Fc "
        "is a prestress Fc and a cohesion (1 - mu) Fc. [force]");
      declare_bond(prm);
      declare_fluid(prm);
    }
  } // namespace

  void
  declare_contact_law(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Reach",
                      "",
                      Anything(),
                      "Nodes further than this from the master's faces stay "
                      "free. Empty: the diagonal of the box around both "
                      "bodies. [length]");
    declare_kind(prm);
    declare_pairing(prm);
    declare_kinematics(prm);
    declare_friction(prm);
    declare_layer(prm);
    prm.declare_entry("Active",
                      "1",
                      Anything(),
                      "An expression of t. Where it is 0 at the end of an "
                      "increment, the sides do not see each other, as with a "
                      "part that is not mounted yet. A tie holds its sides as "
                      "they are at the start of the increment in which it "
                      "begins, and lets go of them in the one in which it "
                      "ends. Not for Kind = bilateral.");
  }

  void
  declare_contact(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.declare_entry("Body", "", Anything(), "Name of the body.");
    prm.declare_entry("Boundary ids",
                      "",
                      Anything(),
                      "Boundary ids of the body whose nodes may touch, "
                      "separated by commas.");
    prm.declare_entry("Obstacle",
                      "",
                      Anything(),
                      "Name of the rigid obstacle they may touch. Empty: "
                      "another body.");
    prm.declare_entry("Master body",
                      "",
                      Anything(),
                      "Instead of Obstacle: name of the body they may touch. "
                      "Where meshes differ, let Body be the finer or softer "
                      "one; where a frame meets a continuum, the continuum.");
    prm.declare_entry("Master boundary ids",
                      "",
                      Anything(),
                      "Boundary ids of the master body. Those of single nodes "
                      "of a frame, as the end of a beam that runs against a "
                      "stop: these nodes meet the body's faces.");
    declare_contact_law(prm);
    declare_preload(prm);
    declare_spring(prm);
  }

  namespace
  {
    /** An entry that says nothing without another one. */
    struct IdleRow
    {
      const char               *entry, *idle; ///< and what it is left at
      std::vector<const char *> others;       ///< one of them is to be given
      const char               *sentence;
    };

    const std::vector<IdleRow> &
    idle_entries()
    {
      static const std::vector<const char *> friction = {"Friction coefficient",
                                                         "Cohesion"};
      static const std::vector<const char *> bond     = {"Cohesion",
                                                         "Tensile strength"};
      static const std::vector<IdleRow>      rows     = {
                 {"Friction angle",
                  "0",
                  {"Second friction coefficient"},
                  "friction is the same along all directions. Give a Second friction "
                           "coefficient, too, or leave the entry at 0."},
                 {"Shear limit",
                  "",
                  friction,
                  "there is no friction that it could limit. Give a Friction "
                           "coefficient or Cohesion, too, or leave the entry empty."},
                 {"Wear share",
                  "1",
                  {"Wear coefficient"},
                  "nothing wears. Give a Wear coefficient, too, or leave the entry at "
                           "1."},
                 {"Wear acceleration",
                  "1",
                  {"Wear coefficient"},
                  "nothing wears. Give a Wear coefficient, too, or leave the entry at "
                           "1."},
                 {"Wear integration",
                  "explicit",
                  {"Wear coefficient"},
                  "nothing wears. Give a Wear coefficient, too, or leave the entry at "
                           "explicit."},
                 {"Unloading compliance",
                  "",
                  {"Compliance"},
                  "nothing has closed. Give a Compliance, too, or leave the entry "
                           "empty."},
                 {"Cohesion lost",
                  "never",
                  bond,
                  "there is none. Give Cohesion or Tensile strength, or leave the entry "
                           "at never."}};
      return rows;
    }

    /** Tells whether an entry says what is idle, as text or as an expression
     * that is 0 or 1 everywhere. */
    bool
    is_left_at(const dealii::ParameterHandler &prm,
               const std::string              &entry,
               const std::string              &idle,
               const std::string              &in)
    {
      const std::string text = prm.get(entry);
      if (text == idle || text.empty() || (idle != "0" && idle != "1"))
        return text == idle;
      return Expression(text + " - " + idle, in + entry, names_of_situation())
        .is_zero();
    }

    /** Tells whether an entry is given. One that is 0 by default may be 0 in
     * other words. */
    bool
    is_given(const dealii::ParameterHandler &prm,
             const std::string              &entry,
             const std::string              &in)
    {
      const bool may_be_zero = entry == "Friction coefficient" ||
                               entry == "Cohesion" ||
                               entry == "Tensile strength";
      return may_be_zero ? !is_left_at(prm, entry, "0", in) :
                           !prm.get(entry).empty();
    }
  } // namespace

  void
  refuse_idle_entries(const dealii::ParameterHandler &prm,
                      const std::string              &in)
  {
    for (const IdleRow &row : idle_entries())
      if (!is_left_at(prm, row.entry, row.idle, in) &&
          std::none_of(row.others.begin(),
                       row.others.end(),
                       [&](const char *other) {
                         return is_given(prm, other, in);
                       }))
        throw InputError(in + row.entry + ": " + row.sentence);
  }
} // namespace conetact::pairing
