#include "core/exchange/record_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "core/exchange/errors.hpp"
#include "core/exchange/hdf5_handle.hpp"
#include "core/exchange/record_values.hpp"
#include "core/exchange/wire.hpp"
#include "core/results/durable_file.hpp"
#include "core/results/error.hpp"

namespace polynya::exchange {
namespace {

using hdf5::check;
using hdf5::Handle;

constexpr const char* format_name = "polynya-record";
constexpr std::int64_t format_version = 3;
constexpr std::size_t chunk_bytes = 1 << 18;
constexpr std::size_t numbers_of_rows = sizeof(RowsOfMessage) / sizeof(std::int64_t);

hid_t type_of(const std::string& type) {
  if (type == "f8") return H5T_IEEE_F64LE;
  if (type == "i8") return H5T_STD_I64LE;
  if (type == "i4") return H5T_STD_I32LE;
  return H5T_STD_U8LE;
}

/// Names of links: "/" and "%" are escaped, and so is a name that HDF5 would not take.
std::string link_name(const std::string& name) {
  std::string link;
  for (const char c : name) link += c == '/' ? "%2F" : c == '%' ? "%25" : std::string(1, c);
  return link.empty() ? "%" : link == "." ? "%2E" : link;
}

Handle group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name};
}

/// Rows in chunks that are compressed one by one.
void compress_rows(hid_t properties, const char* name, hid_t type, std::vector<hsize_t> shape) {
  hsize_t row = H5Tget_size(type);
  for (std::size_t d = 1; d < shape.size(); ++d) row *= shape[d];
  shape[0] = std::min(shape[0], std::max<hsize_t>(1, chunk_bytes / row));
  check(H5Pset_chunk(properties, static_cast<int>(shape.size()), shape.data()), name);
  check(H5Pset_shuffle(properties), name);
  check(H5Pset_deflate(properties, 1), name);
}

/// A data set, empty yet.
Handle make_rows(hid_t parent, const char* name, hid_t type, const std::vector<hsize_t>& shape,
                 Compression compression = Compression::none) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, name);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
  const bool empty = std::find(shape.begin(), shape.end(), 0) != shape.end();
  if (compression == Compression::deflate && !empty) {
    compress_rows(properties, name, type, shape);
  } else {  // at one place, which is known at once
    check(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), name);
    check(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), name);
  }
  return {H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name};
}

/// Numbers, or rows of numbers.
template <class T>
void write_column(hid_t parent, const char* name, hid_t type, const std::vector<T>& values,
                  std::vector<hsize_t> trailing = {}) {
  trailing.insert(trailing.begin(), values.size());
  const Handle set = make_rows(parent, name, type, trailing);
  if (!values.empty()) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
}

void write_texts(hid_t parent, const char* name, const std::vector<std::string>& texts) {
  const Handle type = hdf5::text_type();
  const hsize_t count = texts.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  const Handle set(H5Dcreate2(parent, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, name);
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  if (count > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), name);
}

void write_label(hid_t file, const RecordLabel& label) {
  hdf5::write_text(file, "format", format_name);
  hdf5::write_numbers<std::int64_t>(file, "version", {&format_version, 1});
  const std::int64_t protocol = protocol_version;
  hdf5::write_numbers<std::int64_t>(file, "protocol", {&protocol, 1});
  hdf5::write_text(file, "run", label.run);
  hdf5::write_text(file, "participant", label.participant);
  const RecordSelection& selection = label.selection;
  if (!selection.times.empty()) hdf5::write_numbers<double>(file, "times", selection.times);
  if (!selection.windows.empty()) hdf5::write_numbers<std::int64_t>(file, "windows", selection.windows);
  if (label.region) hdf5::write_numbers<double>(file, "region", *label.region);
}

/// Makes the data sets of a series. Values that are not compressed are left to be written to their place, which is
/// added to `placed`: HDF5 goes through the kernel's cache.
void write_series(hid_t parent, const std::string& name, const ArraySeries& series, Compression compression,
                  std::vector<PlacedValues>& placed) {
  const Handle home = group(parent, link_name(name));
  std::vector<hsize_t> shape{static_cast<hsize_t>(series.count)};
  for (const std::int64_t extent : series.trailing) shape.push_back(static_cast<hsize_t>(extent));
  hdf5::write_text(home, "type", series.type);
  const std::int64_t scalar = series.scalar ? 1 : 0;
  hdf5::write_numbers<std::int64_t>(home, "scalar", {&scalar, 1});
  const hid_t type = type_of(series.type);
  const Handle set = make_rows(home, "values", type, shape, compression);
  const std::span<const std::byte> values(series.values.data(), series.values.size());
  if (compression != Compression::none) {
    if (!values.empty()) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  } else if (!values.empty()) {
    const haddr_t offset = H5Dget_offset(set);
    check(offset == HADDR_UNDEF ? -1 : 0, name);
    placed.push_back({offset, values});
  }
  write_column(home, "rows", H5T_STD_I64LE, series.rows, {numbers_of_rows});
}

/// All but the values that are left to be placed, which it returns.
std::vector<PlacedValues> write_structure(const std::string& path, const RecordSegment& segment,
                                          const RecordLabel& label, Compression compression) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path);
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), path);  // small groups: half the work
  check(H5Pset_alignment(access, least_past_cache, disk_block), path);
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, path);
  write_label(file, label);
  {
    const Handle messages = group(file, "messages");
    write_column(messages, "from_coupler", H5T_STD_U8LE, segment.sender);
    write_column(messages, "window", H5T_STD_I64LE, segment.window);
    write_column(messages, "time", H5T_IEEE_F64LE, segment.time);
    write_texts(messages, "header", segment.header);
  }
  const Handle arrays = group(file, "arrays");
  std::string kind;
  std::optional<Handle> home;
  std::vector<PlacedValues> placed;
  for (const auto& [key, series] : segment.series) {
    if (series.rows.empty()) continue;
    if (!home || kind != key.first) home.reset(), home.emplace(group(arrays, link_name(kind = key.first)));
    write_series(*home, key.second, series, compression, placed);
  }
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), path);
  return placed;
}

/// A column of numbers, or one of rows of numbers if that is what T is.
template <class T>
std::vector<T> read_column(hid_t parent, const char* name, hid_t type) {
  const Handle set(H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  const auto count = static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0));
  const std::size_t numbers = sizeof(T) / H5Tget_size(type);
  check(count % numbers == 0 ? 0 : -1, name);
  std::vector<T> values(count / numbers);
  if (!values.empty()) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

std::vector<std::string> read_texts(hid_t parent, const char* name) {
  const Handle type = hdf5::text_type();
  const Handle set(H5Dopen2(parent, name, H5P_DEFAULT), H5Dclose, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  std::vector<char*> pointers(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0)));
  if (pointers.empty()) return {};
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), name);
  std::vector<std::string> texts(pointers.begin(), pointers.end());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  return texts;
}

ArraySeries read_series(hid_t kind, const std::string& name) {
  const Handle home(H5Gopen2(kind, link_name(name).c_str(), H5P_DEFAULT), H5Gclose, name);
  ArraySeries series;
  series.type = hdf5::read_text(home, "type");
  series.scalar = hdf5::read_numbers<std::int64_t>(home, "scalar").at(0) != 0;
  series.rows = read_column<RowsOfMessage>(home, "rows", H5T_STD_I64LE);
  const hid_t type = type_of(series.type);
  const Handle set(H5Dopen2(home, "values", H5P_DEFAULT), H5Dclose, name);
  const Handle space(H5Dget_space(set), H5Sclose, name);
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 1)));
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), name);
  series.count = static_cast<std::int64_t>(shape[0]);
  series.trailing.assign(shape.begin() + 1, shape.end());
  const bool inside = std::all_of(series.rows.begin(), series.rows.end(), [&](const auto& rows) {
    return rows.first >= 0 && rows.first <= rows.last && rows.last <= series.count;
  });
  if (!inside) throw RecordError("the rows of the array '" + name + "' are not where its messages have them");
  const std::size_t size = shape[0] * series.row_bytes();
  if (size > 0) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, series.values.extend(size)), name);
  return series;
}

/// Which arrays there are stands in the headers.
void read_arrays(hid_t file, RecordSegment& segment) {
  const Handle arrays(H5Gopen2(file, "arrays", H5P_DEFAULT), H5Gclose, "arrays");
  for (const std::string& frame : segment.header) {
    Envelope envelope;
    const Message message = decode_header(frame, envelope);
    for (const Array& array : message.arrays) {
      const std::pair key(message.kind(), array.name);
      if (segment.series.contains(key)) continue;
      const Handle kind(H5Gopen2(arrays, link_name(key.first).c_str(), H5P_DEFAULT), H5Gclose, key.first);
      segment.series[key] = read_series(kind, array.name);
    }
  }
}

RecordSegment read_all(const std::string& path, RecordLabel& label) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path);
  if (hdf5::read_text(file, "format") != format_name) throw RecordError("is not part of a record");
  if (hdf5::read_numbers<std::int64_t>(file, "version").at(0) != format_version ||
      hdf5::read_numbers<std::int64_t>(file, "protocol").at(0) != protocol_version)
    throw RecordError("was written by another version of the recorder or of the protocol");
  label = {hdf5::read_text(file, "run"), hdf5::read_text(file, "participant"), {}, {}};
  if (H5Aexists(file, "times") > 0) label.selection.times = hdf5::read_numbers<double>(file, "times");
  if (H5Aexists(file, "windows") > 0) label.selection.windows = hdf5::read_numbers<std::int64_t>(file, "windows");
  if (H5Aexists(file, "region") > 0) {
    const std::vector<double> box = hdf5::read_numbers<double>(file, "region");
    std::copy_n(box.begin(), std::min<std::size_t>(box.size(), 6), label.region.emplace().begin());
  }
  RecordSegment segment;
  const Handle messages(H5Gopen2(file, "messages", H5P_DEFAULT), H5Gclose, "messages");
  segment.sender = read_column<std::uint8_t>(messages, "from_coupler", H5T_STD_U8LE);
  segment.window = read_column<std::int64_t>(messages, "window", H5T_STD_I64LE);
  segment.time = read_column<double>(messages, "time", H5T_IEEE_F64LE);
  segment.header = read_texts(messages, "header");
  const std::size_t count = segment.header.size();
  if (segment.sender.size() != count || segment.window.size() != count || segment.time.size() != count)
    throw RecordError("holds message columns of different lengths");
  read_arrays(file, segment);
  return segment;
}

}  // namespace

std::string segment_path(const std::string& folder, const std::string& participant, int number) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "-%05d.h5", number);
  return folder + "/" + participant + digits;
}

void write_segment(const std::string& path, const RecordSegment& segment, const RecordLabel& label,
                   Compression compression, Route route) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are reported once, by the exception
  results::create_folder_of(path);
  std::vector<PlacedValues> placed;
  try {
    placed = write_structure(results::aside(path), segment, label, compression);
  } catch (const hdf5::Refused& error) {
    throw results::ResultsError("cannot write " + path + ": HDF5 could not store " + error.what() + " (disk full?)");
  }
  write_placed_values(results::aside(path), placed, route);
  // No fsync: the record survives the process, whose frames survive the machine; waiting for the disk would cost the
  // run.
  if (std::rename(results::aside(path).c_str(), path.c_str()) != 0) results::throw_file_error(path, errno);
}

RecordSegment read_segment(const std::string& path, RecordLabel& label) {
  if (!std::filesystem::exists(path)) throw RecordError(path + ": there is no such file");
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  try {
    return read_all(path, label);
  } catch (const hdf5::Refused& error) {
    throw RecordError(path + ": HDF5 could not read " + error.what() + "; the file is damaged");
  } catch (const std::runtime_error& error) {
    throw RecordError(path + ": " + error.what());
  }
}

}  // namespace polynya::exchange
