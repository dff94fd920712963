// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/vtu_pieces.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"
#include "conetact/base/index.h"

#include <deal.II/base/exceptions.h>

#include <cstring>

namespace conetact
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Texts and arrays of a file one behind the other, each with its length
     * before it. */
    class Message
    {
    public:
      Message() = default;
      explicit Message(std::vector<char> received)
        : bytes(std::move(received))
      {}
      void
      add(const void *data, const std::size_t size)
      {
        const auto *const length = reinterpret_cast<const char *>(&size);
        bytes.insert(bytes.end(), length, length + sizeof(size));
        const auto *const begin = static_cast<const char *>(data);
        bytes.insert(bytes.end(), begin, begin + size);
      }
      void
      add(const std::string_view text)
      {
        add(text.data(), text.size());
      }
      std::string_view
      next()
      {
        std::size_t size = 0;
        std::memcpy(&size, bytes.data() + place, sizeof(size));
        place += sizeof(size) + size;
        return {bytes.data() + place - size, size};
      }
      bool
      is_at_end() const
      {
        return place == bytes.size();
      }
      const std::vector<char> &
      all() const
      {
        return bytes;
      }

    private:
      std::vector<char> bytes;
      std::size_t       place = 0;
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

    void
    send_piece(const fs::path     &file,
               const VtuGrid      &piece,
               const double        time,
               const unsigned int  increment,
               const int           to,
               const Communicator &processes)
    {
      Message message;
      message.add(fs::absolute(file).string());
      const std::string rest =
        piece.for_each_array(time,
                             increment,
                             [&](const std::string_view before,
                                 const unsigned char   *bytes,
                                 const std::size_t      n_bytes) {
                               message.add(before);
                               message.add(bytes, n_bytes);
                             });
      message.add(rest);
      processes.send(message.all(), to);
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
      send_piece(folder / files[at(p)],
                 grid.part(cells[at(p)]),
                 time,
                 increment,
                 p,
                 processes);
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
    Message        message(processes.receive<char>(0));
    const fs::path file = std::string(message.next());
    std::string    text;
    text.reserve(message.all().size() / 3 * 4);
    for (text += message.next(); !message.is_at_end(); text += message.next())
      {
        const std::string_view array = message.next();
        append_encoded(text,
                       reinterpret_cast<const unsigned char *>(array.data()),
                       array.size());
      }
    const std::string why = try_to_write(file, text);
    processes.send(std::vector<char>(why.begin(), why.end()), 0);
  }
} // namespace conetact
