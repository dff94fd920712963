// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_analysis_mechanism_files_h
#define conetact_analysis_mechanism_files_h

#include "conetact/contact/contact_model.h"

#include <filesystem>
#include <string>

namespace conetact::analysis
{
  /** Pictures of the mechanism that a load path ends with. */
  class MechanismFiles
  {
  public:
    /** What is given must outlive the object. */
    MechanismFiles(contact::ContactModel       &model,
                   const std::filesystem::path &folder);

    /** Draws the motion of contact nodes, as all bodies follow it. */
    void
    write(const Eigen::VectorXd &velocity, const double t) const;
    /** Those of an earlier run must not pass for those of this one. */
    void
    remove() const;

  private:
    Eigen::VectorXd
    displacements(const Eigen::VectorXd &velocity) const;
    std::string
    name(const std::size_t body) const;

    contact::ContactModel       &model;
    const std::filesystem::path &folder;
  };
} // namespace conetact::analysis

#endif
