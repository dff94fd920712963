// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later

#include "conetact/exchange/hdf5_file.h"

#include "conetact/base/errors.h"

#include <filesystem>
#include <fstream>
#include <type_traits>

namespace conetact::exchange
{
  QuietHdf5::QuietHdf5()
  {
    H5Eget_auto2(H5E_DEFAULT, &function, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }



  QuietHdf5::~QuietHdf5()
  {
    H5Eset_auto2(H5E_DEFAULT, function, data);
  }



  Hdf5File::Hdf5File(const std::string &file)
    : path(file)
  {
    const QuietHdf5 quiet;
    std::error_code error;
    if (!std::filesystem::exists(path, error))
      fail("there is no such file");
    if (std::filesystem::is_directory(path, error))
      fail("this is a folder, not a file");
    if (!std::ifstream(path))
      fail("it cannot be opened for reading");
    const bool is_hdf5 = H5Fis_hdf5(path.c_str()) > 0;
    if (!is_hdf5)
      fail("this is not an HDF5 file");
    id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id < 0)
      fail("it cannot be opened as HDF5: truncated, damaged, or in use");
  }



  Hdf5File::~Hdf5File()
  {
    if (id >= 0)
      H5Fclose(id);
  }



  void
  Hdf5File::fail(const std::string &sentence) const
  {
    throw InputError("File '" + path + "': " + sentence + ".");
  }



  bool
  Hdf5File::has(const std::string &name) const
  {
    const QuietHdf5 quiet;
    const hid_t     object = H5Oopen(id, name.c_str(), H5P_DEFAULT);
    if (object < 0)
      return false;
    H5Oclose(object);
    return true;
  }



  std::size_t
  Hdf5File::size(const std::string &name) const
  {
    const QuietHdf5 quiet;
    const hid_t     set = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
    if (set < 0)
      return 0;
    const hid_t    space = H5Dget_space(set);
    const hssize_t found = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
    H5Dclose(set);
    return found > 0 ? static_cast<std::size_t>(found) : 0;
  }



  /* Sizes are compared before memory is taken: a damaged file may ask for
     any amount of it. */
  template <typename T>
  std::vector<T>
  Hdf5File::read(const std::string &name, const std::size_t size) const
  {
    constexpr bool  integer = std::is_same_v<T, int>;
    const QuietHdf5 quiet;
    const hid_t     set = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
    if (set < 0)
      fail("the dataset '" + name + "' is missing");
    const hid_t       space = H5Dget_space(set);
    const hid_t       type  = H5Dget_type(set);
    const hssize_t    found = H5Sget_simple_extent_npoints(space);
    const H5T_class_t is    = H5Tget_class(type);
    H5Tclose(type);
    H5Sclose(space);

    const bool     numeric = is == H5T_INTEGER || (is == H5T_FLOAT && !integer);
    const bool     fits    = found == static_cast<hssize_t>(size);
    std::vector<T> result(numeric && fits ? size : 0);
    const hid_t    memory = integer ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
    const bool     done =
      result.empty() ||
      H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()) >= 0;
    H5Dclose(set);
    if (!numeric)
      fail("the dataset '" + name + "' does not hold " +
           (integer ? "integers" : "numbers"));
    if (!fits)
      fail("the dataset '" + name + "' has " + std::to_string(found) +
           " entries instead of " + std::to_string(size));
    if (!done)
      fail("the dataset '" + name + "' cannot be read: the file is damaged");
    return result;
  }



  int
  Hdf5File::integer(const std::string &name) const
  {
    return integers(name, 1)[0];
  }



  std::vector<int>
  Hdf5File::integers(const std::string &name, const std::size_t size) const
  {
    return read<int>(name, size);
  }



  std::vector<double>
  Hdf5File::numbers(const std::string &name, const std::size_t size) const
  {
    return read<double>(name, size);
  }
} // namespace conetact::exchange
