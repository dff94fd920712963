// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_application_contact_kinematics_h
#define conetact_application_contact_kinematics_h

#include "conetact/application/restart.h"
#include "conetact/application/scene_objects.h"
#include "conetact/pairing/kinematics.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace conetact::application
{
  /** What runs before this one say of contacts whose kinematics is automatic.
   */
  struct FormerKinematics
  {
    /** Contacts, by number, that have shown to need finite sliding, and why, a
     * part of a sentence. */
    std::map<unsigned int, std::string> shown_to_slide;
    /** A run that is continued has decided. */
    const Restart *restart = nullptr;
  };

  /**
   * Finds which contacts slide far: those that are asked for, or that geometry,
   * prescribed motions and former runs tell; and with that their nodes.
   */
  class ContactKinematicsChoice
  {
  public:
    /** `chosen`: what each contact asks for. */
    ContactKinematicsChoice(const RunSettings                       &settings,
                            const FormerKinematics                  &former,
                            SceneObjects                            &scene,
                            std::vector<pairing::ContactKinematics> &chosen);

    /**
     * Gives the scene's bodies their contact nodes, with the kinematics that
     * each contact needs; gaps of `adjusted` contacts are moved by a constant.
     * Returns how each contact was paired. Throws InputError.
     */
    std::vector<pairing::Pairing>
    pair(const std::vector<unsigned int> &adjusted);

    /** Of each contact, nodes that belong to contacts before it. */
    const std::vector<unsigned int> &
    n_shared() const
    {
      return shared;
    }

  private:
    std::string
    why_not_sliding(const pairing::Contact &contact) const;
    std::string
    why_it_turns(const pairing::Contact &contact) const;
    void
    begin(const unsigned int contact);
    bool
    change(const unsigned int contact, const std::string &held);

    const RunSettings                       &settings;
    const FormerKinematics                  &former;
    SceneObjects                            &scene;
    std::vector<pairing::ContactKinematics> &kinematics;
    std::vector<unsigned int>                shared;
  };

  /** A run that continues this one must take contacts as it does. */
  void
  save_kinematics(const std::vector<pairing::Contact> &contacts,
                  Archive                             &archive);
} // namespace conetact::application

#endif
