// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/archive.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"

#include <cstring>
#include <fstream>
#include <sstream>

namespace conetact
{
  namespace
  {
    constexpr const char *first_line = "Conetact archive 1";

    [[noreturn]] void
    refuse(const std::filesystem::path &file)
    {
      throw InputError(file.string() +
                       " is not a whole checkpoint of this version of the "
                       "program. Run the scene from its start.");
    }

    // "numbers BYTES NAME", then so many bytes and the end of the line
    void
    append(std::string       &text,
           const char        *kind,
           const std::string &name,
           const char        *data,
           const std::size_t  size)
    {
      text +=
        std::string(kind) + ' ' + std::to_string(size) + ' ' + name + '\n';
      text.append(data, size);
      text += '\n';
    }
  } // namespace



  void
  Archive::put(const std::string               &name,
               const std::vector<Tensor<1, 3>> &vectors)
  {
    std::vector<double> values;
    for (const Tensor<1, 3> &v : vectors)
      for (unsigned int d = 0; d < 3; ++d)
        values.push_back(v[d]);
    put(name, values);
  }



  void
  Archive::fill(const std::string         &name,
                std::vector<Tensor<1, 3>> &vectors) const
  {
    const std::vector<double> &values = get(name);
    check_size(name, values.size(), 3 * vectors.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      vectors[i / 3][i % 3] = values[i];
  }



  const std::vector<double> &
  Archive::get(const std::string &name) const
  {
    const auto found = numbers.find(name);
    if (found == numbers.end())
      throw InputError("The checkpoint does not know '" + name +
                       "': it was written by another version of the program. "
                       "Run the scene from its start.");
    return found->second;
  }



  const std::string &
  Archive::get_text(const std::string &name) const
  {
    const auto found = texts.find(name);
    if (found == texts.end())
      throw InputError("The checkpoint does not know '" + name +
                       "': it was written by another version of the program. "
                       "Run the scene from its start.");
    return found->second;
  }



  void
  Archive::check_size(const std::string &name,
                      const std::size_t  found,
                      const std::size_t  expected)
  {
    if (found != expected)
      throw InputError("The checkpoint does not fit the scene: its '" + name +
                       "' has " + std::to_string(found) +
                       " numbers, the scene " + std::to_string(expected) +
                       ". Meshes, supports of contact nodes and contacts must "
                       "be those of the run that is continued.");
  }



  void
  Archive::write(const std::filesystem::path &file) const
  {
    std::string text = std::string(first_line) + '\n';
    for (const auto &[name, value] : texts)
      append(text, "text", name, value.data(), value.size());
    for (const auto &[name, values] : numbers)
      append(text,
             "numbers",
             name,
             reinterpret_cast<const char *>(values.data()),
             sizeof(double) * values.size());
    append(text, "end", "end", "", 0);
    write_atomically(file, text);
  }



  Archive
  Archive::read(const std::filesystem::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    std::string   line;
    if (!std::getline(stream, line) || line != first_line)
      refuse(file);
    const std::uintmax_t most = std::filesystem::file_size(file);
    for (Archive archive; std::getline(stream, line);)
      {
        std::istringstream head(line);
        std::string        kind, name;
        std::size_t        size = 0;
        if (!(head >> kind >> size) || head.get() != ' ' ||
            !std::getline(head, name) || size > most)
          refuse(file);
        std::string bytes(size, '\0');
        if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)) ||
            stream.get() != '\n')
          refuse(file);
        if (kind == "end")
          return archive;
        if (kind == "text")
          archive.texts[name] = bytes;
        else
          {
            std::vector<double> values(size / sizeof(double));
            if (size > 0)
              std::memcpy(values.data(), bytes.data(), size);
            archive.numbers[name] = std::move(values);
          }
      }
    refuse(file);
  }
} // namespace conetact
