#include "core/results/mesh_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <stdexcept>

namespace polynya::results {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what + "; it must be a mesh written by ./polynya run");
}

/// Closes an HDF5 identifier at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& path, const std::string& name) : id_(id), close_(close) {
    if (id_ < 0) fail(path, name + " is missing or damaged");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

template <class T>
hid_t memory_type() {
  if (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  return sizeof(T) == 4 ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
}

template <class T>
std::vector<T> read_set(hid_t parent, const std::string& name, std::size_t columns, const std::string& path) {
  const Handle set(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, path, name);
  const Handle space(H5Dget_space(set), H5Sclose, path, name);
  std::vector<T> values(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0)));
  if (values.size() % columns != 0) fail(path, name + " has no " + std::to_string(columns) + " columns");
  if (!values.empty() && H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(path, name + " cannot be read");
  return values;
}

void check_indices(const std::vector<std::int32_t>& indices, std::size_t nodes, const std::string& name,
                   const std::string& path) {
  for (const std::int32_t n : indices)
    if (n < 0 || static_cast<std::size_t>(n) >= nodes)
      fail(path, name + " names node " + std::to_string(n) + " of " + std::to_string(nodes));
}

}  // namespace

MeshFile read_mesh_file(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path, "the file");
  MeshFile mesh;
  mesh.nodes = read_set<double>(file, "nodes", 3, path);
  mesh.elements = read_set<std::int32_t>(file, "elements", 8, path);
  mesh.element_numbers = read_set<std::int64_t>(file, "element_numbers", 1, path);
  if (mesh.element_numbers.size() != mesh.elements.size() / 8) fail(path, "element_numbers does not fit elements");
  const std::size_t nodes = mesh.nodes.size() / 3;
  check_indices(mesh.elements, nodes, "elements", path);
  const Handle sets(H5Gopen2(file, "sets", H5P_DEFAULT), H5Gclose, path, "sets");
  H5G_info_t info;
  if (H5Gget_info(sets, &info) < 0) fail(path, "sets is damaged");
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    char name[256] = {};
    if (H5Lget_name_by_idx(sets, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT) < 0)
      fail(path, "sets is damaged");
    auto& chosen = mesh.sets[name] = read_set<std::int32_t>(sets, name, 1, path);
    check_indices(chosen, nodes, std::string("sets/") + name, path);
  }
  return mesh;
}

}  // namespace polynya::results
