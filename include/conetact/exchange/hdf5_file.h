// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef conetact_exchange_hdf5_file_h
#define conetact_exchange_hdf5_file_h

#include <hdf5.h>

#include <string>
#include <vector>

namespace conetact::exchange
{
  /**
   * An HDF5 file open for reading. FCLib ends the process when a dataset is
   * missing and trusts all sizes; here everything is checked, and every fault
   * is an InputError that names the file and the dataset. While an object
   * lives HDF5 itself prints nothing.
   */
  class Hdf5File
  {
  public:
    explicit Hdf5File(const std::string &path);
    ~Hdf5File();
    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &
    operator=(const Hdf5File &) = delete;

    /** Whether there is a group or dataset of this name. */
    bool
    has(const std::string &name) const;

    /** Numbers in a dataset; 0 if there is none. */
    std::size_t
    size(const std::string &name) const;

    /** A scalar; a dataset of exactly `size` numbers. */
    int
    integer(const std::string &name) const;
    std::vector<int>
    integers(const std::string &name, const std::size_t size) const;
    std::vector<double>
    numbers(const std::string &name, const std::size_t size) const;

    /** Throws an InputError: "file 'x': " and the sentence. */
    [[noreturn]] void
    fail(const std::string &sentence) const;

  private:
    template <typename T>
    std::vector<T>
    read(const std::string &name, const std::size_t size) const;

    std::string path;
    hid_t       id = -1;
  };

  /** Switches the error messages of HDF5 off as long as it lives. */
  class QuietHdf5
  {
  public:
    QuietHdf5();
    ~QuietHdf5();
    QuietHdf5(const QuietHdf5 &) = delete;
    QuietHdf5 &
    operator=(const QuietHdf5 &) = delete;

  private:
    H5E_auto2_t function = nullptr;
    void       *data     = nullptr;
  };
} // namespace conetact::exchange

#endif
