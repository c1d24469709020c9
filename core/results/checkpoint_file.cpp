#include "core/results/checkpoint_file.hpp"

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "core/results/durable_file.hpp"

namespace polynya::results {
namespace {

using Entry = compute::StateArchive::Entry;
using Kind = compute::StateArchive::Kind;

constexpr std::int64_t file_format = 2;
constexpr const char* values_group = "state";

/// Closes an HDF5 identifier at the end of its scope; negative ones are left to the caller to see.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  bool valid() const { return id_ >= 0; }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

hid_t type_of(const Entry& entry) {
  if (entry.kind == Kind::real) return entry.size == 8 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_FLOAT;
  if (entry.kind == Kind::bytes) return H5T_NATIVE_UINT8;
  return entry.size == 8   ? H5T_NATIVE_INT64
         : entry.size == 4 ? H5T_NATIVE_INT32
         : entry.size == 2 ? H5T_NATIVE_INT16
                           : H5T_NATIVE_INT8;
}

/// FNV-1a over words of eight bytes, the rest byte by byte.
std::uint64_t checksum(const void* data, std::size_t bytes) {
  constexpr std::uint64_t prime = 1099511628211u;
  std::uint64_t sum = 1469598103934665603u;
  const auto* at = static_cast<const unsigned char*>(data);
  for (; bytes >= 8; bytes -= 8, at += 8) {
    std::uint64_t word;
    std::memcpy(&word, at, 8);
    sum = (sum ^ word) * prime;
    sum ^= sum >> 29;
  }
  for (; bytes > 0; --bytes, ++at) sum = (sum ^ *at) * prime;
  return sum;
}

/// Of the program that runs: two builds of one version may round differently.
std::int64_t build_checksum() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return static_cast<std::int64_t>(checksum(bytes.data(), bytes.size()));
}

bool write_attribute(hid_t object, const char* name, hid_t type, const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute, type, value) >= 0;
}

bool read_attribute(hid_t object, const char* name, hid_t type, void* value) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Aread(attribute, type, value) >= 0;
}

/// Texts are data sets of bytes: a resolved scene may be longer than an attribute.
bool write_text(hid_t group, const char* name, const std::string& text) {
  const hsize_t length = text.size();
  const Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  const Handle set(H5Dcreate2(group, name, H5T_NATIVE_UINT8, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  return set.valid() &&
         (text.empty() || H5Dwrite(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0);
}

bool read_text(hid_t group, const char* name, std::string& text) {
  const Handle set(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
  if (!set.valid()) return false;
  const Handle space(H5Dget_space(set), H5Sclose);
  text.resize(static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
  return text.empty() || H5Dread(set, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0;
}

std::set<std::string> names_in(hid_t group) {
  std::set<std::string> names;
  H5G_info_t info{};
  H5Gget_info(group, &info);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto name_of = [&](char* text, std::size_t size) {
      return H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_NATIVE, i, text, size, H5P_DEFAULT);
    };
    std::string name(static_cast<std::size_t>(std::max<ssize_t>(0, name_of(nullptr, 0))), ' ');
    name_of(name.data(), name.size() + 1);
    names.insert(name);
  }
  return names;
}

/// Keys of a resolved scene that may change while a run goes on: they decide when it ends, who computes and what is
/// reported, not what is computed.
const std::set<std::string> free_sections{"checkpoint", "record", "title", "name", "level", "estimate"};
const std::set<std::string> free_keys{"/run/end_time", "/run/join_timeout", "/run/filter_frequency"};
const std::set<std::string> free_of_participants{"command", "launch", "threads"};

nlohmann::json fixed_part(const std::string& scene) {
  nlohmann::json parsed = nlohmann::json::parse(scene, nullptr, false);
  if (!parsed.is_object()) return {};
  for (const std::string& section : free_sections) parsed.erase(section);
  if (parsed.contains("participants"))
    for (auto& [name, participant] : parsed["participants"].items())
      for (const std::string& key : free_of_participants)
        if (participant.is_object()) participant.erase(key);
  if (parsed.contains("effects"))
    for (auto& [name, effect] : parsed["effects"].items())
      if (effect.is_object()) effect.erase("reason");
  return parsed.flatten();
}

std::string dotted(std::string pointer) {
  pointer.erase(0, 1);
  std::replace(pointer.begin(), pointer.end(), '/', '.');
  return pointer;
}

}  // namespace

std::string scene_difference(const std::string& there, const std::string& here) {
  const nlohmann::json a = fixed_part(there), b = fixed_part(here);
  const auto value = [](const nlohmann::json& scene, const std::string& key) {
    return scene.contains(key) ? scene.at(key).dump() : std::string("absent");
  };
  std::set<std::string> keys;
  for (const nlohmann::json* scene : {&a, &b})
    for (const auto& [key, found] : scene->items()) keys.insert(key);
  for (const std::string& key : keys)
    if (!free_keys.contains(key) && value(a, key) != value(b, key))
      return dotted(key) + " is " + value(a, key) + " there and " + value(b, key) + " here";
  return {};
}

struct CheckpointWriter::File {
  std::string path;
  Handle file, group;
};

CheckpointWriter::CheckpointWriter(std::string path, const CheckpointStamp& stamp) : StateArchive(false) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  create_folder_of(path);
  Handle file(H5Fcreate(aside(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  Handle group(file.valid() ? H5Gcreate2(file, values_group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT) : -1, H5Gclose);
  const std::int64_t build = build_checksum();
  const bool good = group.valid() && write_attribute(file, "format", H5T_NATIVE_INT64, &file_format) &&
                    write_attribute(file, "build", H5T_NATIVE_INT64, &build) &&
                    write_attribute(file, "time", H5T_NATIVE_DOUBLE, &stamp.time) &&
                    write_attribute(file, "step", H5T_NATIVE_INT64, &stamp.step) &&
                    write_text(file, "program", stamp.program) && write_text(file, "version", POLYNYA_VERSION) &&
                    write_text(file, "scene", stamp.scene);
  if (!good) throw ResultsError("cannot write " + path + ": HDF5 refused an operation (disk full?)");
  file_ = std::make_unique<File>(File{std::move(path), std::move(file), std::move(group)});
}

CheckpointWriter::~CheckpointWriter() = default;

std::size_t CheckpointWriter::stored(const std::string&, Entry) {
  return 0;
}

void CheckpointWriter::transfer(const std::string& name, Entry entry, void* data, std::size_t count) {
  const bool rows = entry.kind == Kind::bytes;
  const hsize_t shape[2] = {count, entry.size};
  const Handle space(H5Screate_simple(rows ? 2 : 1, shape, nullptr), H5Sclose);
  const Handle set(H5Dcreate2(file_->group, name.c_str(), type_of(entry), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                   H5Dclose);
  const auto sum = static_cast<std::int64_t>(checksum(data, count * entry.size));
  const bool good = set.valid() &&
                    (count == 0 || H5Dwrite(set, type_of(entry), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0) &&
                    write_attribute(set, "checksum", H5T_NATIVE_INT64, &sum);
  if (!good) throw ResultsError("cannot write " + file_->path + ": HDF5 could not store '" + name + "' (disk full?)");
}

void CheckpointWriter::commit() {
  const std::string path = file_->path;
  const bool good = H5Fflush(file_->file, H5F_SCOPE_GLOBAL) >= 0;
  file_.reset();
  if (!good) throw ResultsError("cannot write " + path + ": HDF5 could not store the data (disk full?)");
  commit_file(path);
}

struct CheckpointReader::File {
  std::string path;
  Handle file, group;
  std::set<std::string> unread;
};

CheckpointReader::CheckpointReader(std::string path, const std::string& program, const std::string& scene)
    : StateArchive(true) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (!std::filesystem::exists(path)) throw CheckpointError(path + ": is missing; there is no such checkpoint");
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  Handle group(file.valid() ? H5Gopen2(file, values_group, H5P_DEFAULT) : -1, H5Gclose);
  std::int64_t format = 0, build = 0;
  std::string wrote, version, scene_there;
  const bool good = group.valid() && read_attribute(file, "format", H5T_NATIVE_INT64, &format) &&
                    read_attribute(file, "build", H5T_NATIVE_INT64, &build) &&
                    read_attribute(file, "time", H5T_NATIVE_DOUBLE, &time_) &&
                    read_attribute(file, "step", H5T_NATIVE_INT64, &step_) && read_text(file, "program", wrote) &&
                    read_text(file, "version", version) && read_text(file, "scene", scene_there);
  if (!good) throw CheckpointError(path + ": is no checkpoint, or was cut short");
  file_ = std::make_unique<File>(File{std::move(path), std::move(file), std::move(group), {}});
  if (wrote != program) throw_unfit("was written by " + wrote + ", this is " + program);
  if (format != file_format || version != POLYNYA_VERSION)
    throw_unfit("was written by version " + version + " (format " + std::to_string(format) + "), this is version " +
                POLYNYA_VERSION + " (format " + std::to_string(file_format) + ")");
  if (const std::string difference = scene_difference(scene_there, scene); !difference.empty())
    throw_unfit("belongs to another scene: " + difference);
  if (build != build_checksum())
    remark_ =
        file_->path + " was written by another build of " + program + ": the run goes on, perhaps with other bits";
  file_->unread = names_in(file_->group);
}

CheckpointReader::~CheckpointReader() = default;

void CheckpointReader::throw_unfit(const std::string& what) const {
  throw CheckpointError(file_->path + ": does not fit: " + what);
}

std::size_t CheckpointReader::stored(const std::string& name, Entry entry) {
  const Handle set(H5Dopen2(file_->group, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) throw_unfit("it holds no '" + name + "'");
  const Handle space(H5Dget_space(set), H5Sclose), type(H5Dget_type(set), H5Tclose);
  std::array<hsize_t, 2> shape{0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  const int rank_needed = entry.kind == Kind::bytes ? 2 : 1;
  const H5T_class_t kind = entry.kind == Kind::real ? H5T_FLOAT : H5T_INTEGER;
  const std::size_t size = entry.kind == Kind::bytes ? 1 : entry.size;
  if (rank == rank_needed) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  if (rank != rank_needed || H5Tget_class(type) != kind || H5Tget_size(type) != size ||
      (rank == 2 && shape[1] != entry.size))
    throw_unfit("'" + name + "' is of another type than here");
  return shape[0];
}

void CheckpointReader::transfer(const std::string& name, Entry entry, void* data, std::size_t count) {
  const Handle set(H5Dopen2(file_->group, name.c_str(), H5P_DEFAULT), H5Dclose);
  std::int64_t sum = 0;
  const bool good = set.valid() &&
                    (count == 0 || H5Dread(set, type_of(entry), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0) &&
                    read_attribute(set, "checksum", H5T_NATIVE_INT64, &sum);
  if (!good || sum != static_cast<std::int64_t>(checksum(data, count * entry.size)))
    throw CheckpointError(file_->path + ": is damaged: '" + name + "' is not what was written");
  file_->unread.erase(name);
}

void CheckpointReader::finish() {
  if (!file_->unread.empty())
    throw_unfit("it holds '" + *file_->unread.begin() + "', which this program does not know");
}

}  // namespace polynya::results
