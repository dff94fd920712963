// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/pairing/kinematics.h"

#include "conetact/base/text.h"

#include <algorithm>

namespace conetact::pairing
{
  namespace
  {
    struct KinematicsRow
    {
      Kinematics  kinematics;
      std::string name, description;
    };

    /** The first one is the default. */
    const std::vector<KinematicsRow> &
    kinematics_table()
    {
      static const std::vector<KinematicsRow> rows = {
        {Kinematics::automatic,
         "automatic",
         "finite sliding where obstacles or bodies turn, and as soon as "
         "bodies slide by more than a cell or turn by more than 0.25 rad; "
         "small elsewhere. Curved sides that are only pressed and sheared "
         "stay small. A warning names contacts whose normals turn by more than "
         "0.01 rad, or 0.004 rad where friction acts; use finite sliding "
         "there. Round bodies that roll by more than a cell take it "
         "themselves. log.txt says which was taken, and why. Load paths, adaptive meshes, Prestress, a Gap, "
         "frames as masters, bilateral contacts and bodies that meet "
         "themselves do not go with finite sliding and stay small; a run that "
         "would then be wrong by more than a hundredth warns or ends"},
        {Kinematics::finite_sliding,
         "finite sliding",
         "contact is where bodies and obstacles are at the end of each "
         "increment. They may slide, move and turn by any amount, but frames, "
         "bodies on foundations and bodies that are held along some "
         "directions only may turn little. Ties whose sides touch at the "
         "start turn with their bodies, whatever is chosen for them. Each "
         "increment is solved a few times. Friction opposes the slip in the "
         "last tangent plane of the increment, so that the error of a curved "
         "path falls with the size of increments"},
        {Kinematics::small,
         "small",
         "gaps and normals are those of the undeformed bodies, however far "
         "these move, as in [K] and [P]. One warning tells where that is "
         "wrong by more than a hundredth"}};
      return rows;
    }
  } // namespace

  void
  declare_kinematics(dealii::ParameterHandler &prm)
  {
    std::vector<std::string> names;
    std::string              text;
    for (const KinematicsRow &row : kinematics_table())
      {
        names.push_back(row.name);
        text += row.name + ": " + row.description + ". ";
      }
    prm.declare_entry("Kinematics",
                      names.front(),
                      dealii::Patterns::Selection(join(names, "|")),
                      text + "[-]");
  }

  Kinematics
  read_kinematics(const dealii::ParameterHandler &prm)
  {
    return std::find_if(kinematics_table().begin(),
                        kinematics_table().end(),
                        [&](const KinematicsRow &row) {
                          return row.name == prm.get("Kinematics");
                        })
      ->kinematics;
  }

  /* Kinds of contacts that finite sliding does not find again, each with the
     reason that a user is told. Empty: it may slide. */
  std::string
  why_not_sliding(const Contact                                &contact,
                  const std::vector<const bodies::Structure *> &structures)
  {
    if (contact.kind == ContactKind::bilateral)
      return "bilateral contacts stay with what they met at the start";
    if (contact.kind == ContactKind::tie && contact.obstacle != nullptr)
      return "what is tied to an obstacle moves with it, and turns little";
    if (contact.spring)
      return "a spring keeps its direction";
    if (contact.may_part())
      return "a tie that begins or ends keeps its directions";
    if (contact.kind == ContactKind::tie && contact.preload)
      return "a Preload keeps its direction, but ties turn where bodies turn "
             "far";
    if (contact.kind == ContactKind::tie)
      return ""; // it goes with its bodies
    if (!contact.prestress->is_zero())
      return "a Prestress keeps its direction, but normals turn where bodies "
             "slide far";
    if (contact.obstacle != nullptr)
      return "";
    if (contact.body == contact.master)
      return "a body slides far along another one only, not along itself";
    if (contact.gap)
      return "a Gap is that of undeformed bodies, and where they slide far it "
             "comes from geometry";
    for (const bodies::Surface &surface :
         {structures[contact.body]->surface(contact.ids),
          structures[contact.master]->surface(contact.master_ids)})
      if (surface.two_sided || surface.faces.empty())
        return "a frame slides far along obstacles only, not with a Master "
               "body";
    return "";
  }
} // namespace conetact::pairing
