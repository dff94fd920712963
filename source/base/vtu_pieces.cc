// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtu_pieces.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace conetact
{
  namespace
  {
    namespace fs = std::filesystem;

    /** A piece of a picture on its way to the process that writes it. */
    struct Piece
    {
      std::string  file;
      VtuGrid      grid;
      double       time      = 0;
      unsigned int increment = 0;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &file &grid &time &increment;
      }
    };

    /** A sentence if that failed: others wait for this process. */
    std::string
    try_to_write(const fs::path &file, const std::string_view text)
    {
      try
        {
          write_atomically(file, text);
        }
      catch (const WriteError &error)
        {
          return error.what();
        }
      return {};
    }
  } // namespace



  std::string
  write_pieces(const fs::path                               &folder,
               const std::vector<std::string>               &files,
               const VtuGrid                                &grid,
               const std::vector<std::vector<unsigned int>> &cells,
               const double                                  time,
               const unsigned int                            increment,
               const Communicator                           &processes)
  {
    AssertDimension(files.size(), cells.size());
    AssertDimension(files.size(), at(processes.size()));
    for (int p = 1; p < processes.size(); ++p)
      processes.send(dealii::Utilities::pack(
                       Piece{fs::absolute(folder / files[at(p)]).string(),
                             grid.part(cells[at(p)]),
                             time,
                             increment},
                       /* allow_compression = */ false),
                     p);
    std::string why = try_to_write(folder / files[0],
                                   grid.part(cells[0]).text(time, increment));
    for (int p = 1; p < processes.size(); ++p)
      {
        const std::vector<char> answer = processes.receive<char>(p);
        if (why.empty())
          why.assign(answer.begin(), answer.end());
      }
    return why;
  }



  void
  write_own_piece(const Communicator &processes)
  {
    const auto piece =
      dealii::Utilities::unpack<Piece>(processes.receive<char>(0),
                                       /* allow_compression = */ false);
    const std::string why =
      try_to_write(piece.file, piece.grid.text(piece.time, piece.increment));
    processes.send(std::vector<char>(why.begin(), why.end()), 0);
  }
} // namespace conetact
