#include "core/results/frame.hpp"

#include <hdf5.h>

#include <algorithm>

#include "core/results/durable_file.hpp"
#include "core/results/error.hpp"

namespace polynya::results {
namespace {

/// Closes an HDF5 identifier at the end of its scope and turns failures into errors that name the file.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& file) : id_(id), close_(close) {
    if (id_ < 0) throw ResultsError("cannot write " + file + ": HDF5 refused an operation (disk full?)");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status, const std::string& file) {
  if (status < 0) throw ResultsError("cannot write " + file + ": HDF5 could not store the data (disk full?)");
}

constexpr hsize_t chunk_rows = 1 << 14;

/// One data set of rows x columns (columns 0: one-dimensional), compressed when it is worth it.
void write_array(hid_t group, const std::string& name, hid_t file_type, hid_t memory_type, hsize_t rows,
                 hsize_t columns, const void* data, const std::string& file) {
  const hsize_t shape[2] = {rows, columns};
  const int rank = columns > 0 ? 2 : 1;
  const Handle space(H5Screate_simple(rank, shape, nullptr), H5Sclose, file);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file);
  if (rows > 64) {
    const hsize_t chunk[2] = {std::min(rows, chunk_rows), columns};
    check(H5Pset_chunk(properties, rank, chunk), file);
    check(H5Pset_shuffle(properties), file);
    check(H5Pset_deflate(properties, 1), file);
  }
  const Handle set(H5Dcreate2(group, name.c_str(), file_type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                   file);
  if (rows > 0) check(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), file);
}

void write_number(hid_t group, const char* name, std::size_t value, const std::string& file) {
  const std::int64_t number = static_cast<std::int64_t>(value);
  write_array(group, name, H5T_STD_I64LE, H5T_NATIVE_INT64, 1, 0, &number, file);
}

void write_fields(hid_t parent, const char* group_name, const std::vector<FieldArray>& fields, std::size_t count,
                  bool single, const std::string& file) {
  const Handle group(H5Gcreate2(parent, group_name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, file);
  for (const FieldArray& field : fields) {
    if (field.components < 1 || field.values.size() != count * static_cast<std::size_t>(field.components))
      throw ResultsError("cannot write " + file + ": the field \"" + field.name + "\" of " + group_name + " has " +
                         std::to_string(field.values.size()) + " values, " + std::to_string(count) + " x " +
                         std::to_string(field.components) + " are needed");
    write_array(group, field.name, single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, count,
                field.components > 1 ? static_cast<hsize_t>(field.components) : 0, field.values.data(), file);
  }
}

void write_attributes(hid_t root, const std::string& file) {
  const hsize_t two = 2;
  const std::int32_t version[2] = {1, 0};
  const Handle pair(H5Screate_simple(1, &two, nullptr), H5Sclose, file);
  const Handle number(H5Acreate2(root, "Version", H5T_STD_I32LE, pair, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, file);
  check(H5Awrite(number, H5T_NATIVE_INT32, version), file);

  // The reader of VTK 9.1 understands only strings of fixed length here.
  const std::string type_name = "UnstructuredGrid";
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose, file);
  check(H5Tset_size(text, type_name.size()), file);
  check(H5Tset_strpad(text, H5T_STR_NULLPAD), file);
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, file);
  const Handle type(H5Acreate2(root, "Type", text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, file);
  check(H5Awrite(type, text, type_name.data()), file);
}

void check_cells(const UnstructuredFields& fields, const std::string& file) {
  if (fields.points.size() % 3 != 0 || fields.offsets.size() != fields.types.size() + 1 ||
      fields.offsets.back() != static_cast<std::int64_t>(fields.connectivity.size()))
    throw ResultsError("cannot write " + file +
                       ": points, offsets, types and connectivity of the cells do not fit together");
}

void write_grid(hid_t root, const UnstructuredFields& fields, const std::string& file) {
  write_number(root, "NumberOfPoints", fields.point_count(), file);
  write_number(root, "NumberOfCells", fields.cell_count(), file);
  write_number(root, "NumberOfConnectivityIds", fields.connectivity.size(), file);
  write_array(root, "Points", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, fields.point_count(), 3, fields.points.data(), file);
  write_array(root, "Connectivity", H5T_STD_I64LE, H5T_NATIVE_INT64, fields.connectivity.size(), 0,
              fields.connectivity.data(), file);
  write_array(root, "Offsets", H5T_STD_I64LE, H5T_NATIVE_INT64, fields.offsets.size(), 0, fields.offsets.data(), file);
  write_array(root, "Types", H5T_STD_U8LE, H5T_NATIVE_UINT8, fields.types.size(), 0, fields.types.data(), file);
}

}  // namespace

void UnstructuredFields::add_cell(CellType type, std::span<const std::int64_t> nodes) {
  connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  types.push_back(static_cast<std::uint8_t>(type));
}

void write_frame(const std::string& path, const UnstructuredFields& fields, double time) {
  check_cells(fields, path);
  create_folder_of(path);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are reported once, by ResultsError
  {
    const Handle file(H5Fcreate(aside(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, path);
    const Handle root(H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
    write_attributes(root, path);
    write_grid(root, fields, path);
    write_fields(root, "PointData", fields.point_fields, fields.point_count(), fields.single_precision, path);
    write_fields(root, "CellData", fields.cell_fields, fields.cell_count(), fields.single_precision, path);
    write_fields(root, "FieldData", {FieldArray{"TimeValue", 1, {time}}}, 1, false, path);
    if (!fields.grid.empty()) {
      const Handle lines(H5Gcreate2(file, "Grid", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
      for (const FieldArray& line : fields.grid)
        write_array(lines, line.name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, line.values.size(), 0, line.values.data(),
                    path);
    }
    check(H5Fflush(file, H5F_SCOPE_GLOBAL), path);
  }
  commit_file(path);
}

}  // namespace polynya::results
