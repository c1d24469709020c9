#pragma once
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// The few operations of HDF5 that the files of a record need besides data sets. For record_file.cpp alone.
namespace polynya::exchange::hdf5 {

/// HDF5 refused an operation; the text is the name of the object.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline void check(herr_t status, const std::string& name) {
  if (status < 0) throw Refused(name);
}

/// Closes an identifier at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& name) : id_(id), close_(close) {
    if (id_ < 0) throw Refused(name);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// UTF-8 of any length, as h5py reads it.
inline Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a type");
  check(H5Tset_size(type, H5T_VARIABLE), "a type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "a type");
  return type;
}

inline void write_text(hid_t object, const char* name, const std::string& text) {
  const Handle type = text_type();
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  const char* pointer = text.c_str();
  check(H5Awrite(attribute, type, &pointer), name);
}

inline std::string read_text(hid_t object, const char* name) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
  const Handle type = text_type();
  char* pointer = nullptr;
  check(H5Aread(attribute, type, &pointer), name);
  std::string text = pointer == nullptr ? "" : pointer;
  H5free_memory(pointer);
  return text;
}

template <class T>
hid_t number_type() {
  return std::is_same_v<T, double> ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

template <class T>
void write_numbers(hid_t object, const char* name, std::span<const T> numbers) {
  const hsize_t count = numbers.size();
  const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  const Handle attribute(H5Acreate2(object, name, number_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  check(H5Awrite(attribute, number_type<T>(), numbers.data()), name);
}

template <class T>
std::vector<T> read_numbers(hid_t object, const char* name) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, name);
  const Handle space(H5Aget_space(attribute), H5Sclose, name);
  std::vector<T> numbers(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0)));
  check(H5Aread(attribute, number_type<T>(), numbers.data()), name);
  return numbers;
}

}  // namespace polynya::exchange::hdf5
