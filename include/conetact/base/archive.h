// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_base_archive_h
#define conetact_base_archive_h

#include "conetact/base/points.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace conetact
{
  /**
   * Named lists of numbers, to the last bit, and texts, which a file keeps
   * while the program is not running. For the machine that wrote it. The file
   * ends with a checksum of all before it.
   */
  class Archive
  {
  public:
    /** Of std::vector<double> or Eigen::VectorXd. */
    template <class Vector>
    void
    put(const std::string &name, const Vector &v)
    {
      numbers[name].assign(v.data(), v.data() + v.size());
    }
    void
    put(const std::string &name, const double number)
    {
      numbers[name] = {number};
    }
    void
    put(const std::string &name, const std::vector<Tensor<1, 3>> &vectors);
    void
    put_text(const std::string &name, const std::string &text)
    {
      texts[name] = text;
    }

    /** Throw InputError where there is no such thing. */
    const std::vector<double> &
    get(const std::string &name) const;
    const std::string &
    get_text(const std::string &name) const;
    bool
    has(const std::string &name) const
    {
      return numbers.count(name) > 0;
    }
    /** Into what has its size already. Throws InputError where that differs. */
    template <class Vector>
    void
    fill(const std::string &name, Vector &v) const
    {
      const std::vector<double> &values = get(name);
      check_size(name, values.size(), static_cast<std::size_t>(v.size()));
      std::copy(values.begin(), values.end(), v.data());
    }
    void
    fill(const std::string &name, double &number) const
    {
      check_size(name, get(name).size(), 1);
      number = get(name)[0];
    }
    void
    fill(const std::string &name, std::vector<Tensor<1, 3>> &vectors) const;
    /** Into what may have any size. */
    template <class Vector>
    void
    fill_any(const std::string &name, Vector &v) const
    {
      const std::vector<double> &values = get(name);
      v.resize(static_cast<decltype(v.size())>(values.size()));
      std::copy(values.begin(), values.end(), v.data());
    }

    /** Throws WriteError; see write_atomically(). */
    void
    write(const std::filesystem::path &file) const;
    /** Throws InputError. */
    static Archive
    read(const std::filesystem::path &file);

  private:
    static void
    check_size(const std::string &name,
               const std::size_t  found,
               const std::size_t  expected);

    std::map<std::string, std::vector<double>> numbers;
    std::map<std::string, std::string>         texts;
  };
} // namespace conetact

#endif
