// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_output_graphics_h
#define conetact_output_graphics_h

#include "conetact/output/output.h"
#include "conetact/output/skin.h"

#include <string>
#include <vector>

namespace conetact::output
{
  /** Name of a block and its file, of one time. */
  using Block = std::pair<std::string, std::string>;

  /**
   * A ParaView collection: which file shows which time. Rewritten with each
   * file, so that it lists finished files only.
   */
  class PvdFile
  {
  public:
    /** What an old one lists beyond the increment `n_kept` is forgotten. */
    explicit PvdFile(const std::filesystem::path &path,
                     const unsigned int           n_kept = 0);
    void
    add(const double time, const std::vector<Block> &blocks);

  private:
    void
    write() const;

    const std::filesystem::path file;
    std::string                 entries;
  };

  /**
   * Pictures of every `vtu_every`-th increment and, as increment 0, of the
   * undeformed bodies for ParaView:
   * - `solution.pvd` and `solution-BODY-0001.vtu`, drawn by the bodies; of
   *   large ones that processes share `solution-BODY-0001.pvtu`, which joins
   *   `solution-BODY-0001.0.vtu`, `...1.vtu`;
   * - `surface.pvd` and `surface-BODY-0001.vtu`: their surfaces with contact;
   * - `contact.pvd` and `contact-0001.vtu`: the contact nodes as points;
   * - `scene.pvd`: the bodies alone, which carry the fields of their contacts;
   *   surfaces and nodes would lie where they are, and pictures flicker.
   * All have `displacement` and, for each cell, `body`, its place in the list
   * of bodies. Double precision.
   */
  class Graphics : public Output
  {
  public:
    /** Removes files of these names that an earlier run left. */
    explicit Graphics(const RunDescription &description);
    void
    begin(const model::IncrementRecord &undeformed) override;
    void
    write(const std::vector<model::IncrementRecord> &finished) override;
    OutputWork
    work() const override;
    bool
    is_shared() const override
    {
      return true;
    }

  private:
    void
    draw(const model::IncrementRecord &record);
    /** By all processes: what is theirs of the bodies. */
    void
    write_bodies(const model::IncrementRecord &record);
    void
    write_body(const model::IncrementRecord &record, const unsigned int body);
    /** By the first one: the rest, and what joins all. */
    void
    write_rest(const model::IncrementRecord &record);
    std::string
    stem(const model::IncrementRecord &record, const std::size_t body) const;
    /** With the units that the scene names. */
    std::string
    text_of(VtuGrid grid, const model::IncrementRecord &record) const;
    std::vector<Block>
    write_surfaces(const model::IncrementRecord &record) const;
    std::vector<Block>
    write_contacts(const model::IncrementRecord &record) const;

    const RunDescription           run;
    const std::vector<std::string> names;  ///< of bodies, in those of files
    const unsigned int             n_kept; ///< increments that stay
    PvdFile                        solution, surface, contact, scene;
    std::vector<Skin>              skins; ///< of the bodies, once known
    /** How a body is drawn, known once it has been. */
    struct Pieces
    {
      int                       n = 0;
      std::vector<unsigned int> own;   ///< cells, where there are several
      std::string               joint; ///< text of the file that joins them
    };
    std::vector<Pieces> pieces; ///< of the bodies
    unsigned int        drawings = 0;
  };
} // namespace conetact::output

#endif
