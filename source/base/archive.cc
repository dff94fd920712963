// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/base/archive.h"

#include "conetact/base/atomic_file.h"
#include "conetact/base/errors.h"

#include <deal.II/base/exceptions.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/crc.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace conetact
{
  namespace
  {
    constexpr const char *first_line = "Conetact archive 4";
    constexpr const char *last_word  = "checksum ";

    [[noreturn]] void
    refuse(const std::filesystem::path &file)
    {
      throw InputError(file.string() +
                       " is not a whole checkpoint of this version of the "
                       "program. Run the scene from its start.");
    }

    /** CRC-32 as eight digits: no single byte may be another one. */
    std::string
    checksum(const std::string_view content)
    {
      boost::crc_32_type crc;
      crc.process_bytes(content.data(), content.size());
      std::ostringstream digits;
      digits << std::hex << std::setw(8) << std::setfill('0') << crc.checksum();
      return digits.str();
    }

    /** Content of a file without its checksum, which must be right. */
    std::string
    checked_content(const std::filesystem::path &file)
    {
      std::ifstream      stream(file, std::ios::binary);
      std::ostringstream whole;
      whole << stream.rdbuf();
      std::string       text = whole.str();
      const std::size_t n    = std::strlen(last_word) + 9;
      if (text.rfind(std::string(first_line) + '\n', 0) != 0 ||
          text.size() < n ||
          text.compare(text.size() - n, std::strlen(last_word), last_word) != 0)
        refuse(file);
      const std::string sum = text.substr(text.size() - 9);
      text.resize(text.size() - n);
      if (sum != checksum(text) + '\n')
        throw InputError(file.string() +
                         " has changed since it was written: its checksum is "
                         "another one. Run the scene from its start, or take "
                         "a copy of the file that is whole.");
      return text;
    }

    template <class Kept>
    const Kept &
    named(const std::map<std::string, Kept> &all, const std::string &name)
    {
      const auto found = all.find(name);
      if (found == all.end())
        throw InputError("The checkpoint does not know '" + name +
                         "': it was written by another version of the "
                         "program. Run the scene from its start.");
      return found->second;
    }

    bool
    are_finite(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(), [](const double x) {
        return std::isfinite(x);
      });
    }
  } // namespace



  void
  Archive::put(const std::string               &name,
               const std::vector<Tensor<1, 3>> &vectors)
  {
    Assert(name.find('\n') == name.npos,
           dealii::ExcMessage("Names are words of a line."));
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
      vectors[i / 3][static_cast<unsigned int>(i % 3)] = values[i];
  }



  const std::vector<double> &
  Archive::get(const std::string &name) const
  {
    return named(numbers, name);
  }



  const std::string &
  Archive::get_text(const std::string &name) const
  {
    return named(texts, name);
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
    Assert(std::all_of(numbers.begin(),
                       numbers.end(),
                       [](const auto &list) {
                         return are_finite(list.second);
                       }),
           dealii::ExcMessage("All that a run keeps is finite."));
    std::ostringstream stream;
    stream << first_line << '\n';
    boost::archive::binary_oarchive(stream) << texts << numbers;
    const std::string text = stream.str();
    write_atomically(file, text + last_word + checksum(text) + '\n');
  }



  Archive
  Archive::read(const std::filesystem::path &file)
  {
    std::istringstream stream(checked_content(file));
    std::string        first;
    std::getline(stream, first);
    Archive archive;
    try
      {
        boost::archive::binary_iarchive(stream) >> archive.texts >>
          archive.numbers;
      }
    catch (const boost::archive::archive_exception &)
      {
        refuse(file);
      }
    catch (const std::bad_alloc &) // of a length that is none
      {
        refuse(file);
      }
    catch (const std::length_error &)
      {
        refuse(file);
      }
    for (const auto &[name, values] : archive.numbers)
      if (!are_finite(values))
        throw InputError("The checkpoint " + file.string() +
                         " is damaged: its '" + name +
                         "' holds what is no finite number. Run the scene "
                         "from its start.");
    return archive;
  }
} // namespace conetact
