#include "antigrasp/datasets/hdf5_file.h"

#include <algorithm>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/hdf5_chunk.h"
#include "antigrasp/datasets/hdf5_handle.h"
#include "antigrasp/datasets/hdf5_lock.h"
#include "antigrasp/datasets/hdf5_output.h"

namespace antigrasp {
namespace {

using Handle = Hdf5Handle;

Handle Utf8Type(std::size_t bytes) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), bytes);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  return type;
}

// Memory type for reading strings stored as `file_type`: same length and character set.
Handle StringMemoryType(const Handle& file_type, bool variable) {
  Handle type = Utf8Type(variable ? H5T_VARIABLE : H5Tget_size(file_type.get()));
  H5Tset_cset(type.get(), H5Tget_cset(file_type.get()));
  return type;
}

// The index of chunks grows with the set, and by default the library keeps up to 32 MB of it. What
// is read or written grid by grid needs the way from its root to one leaf.
void KeepFewIndexNodes(hid_t access) {
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(access, &cache);
  cache.set_initial_size = true;
  cache.initial_size = cache.min_size = cache.max_size = 1 << 18;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  H5Pset_mdc_config(access, &cache);
}

// Strings of either kind; `read` fills a buffer of the given memory type.
template <typename Read>
std::optional<std::vector<std::string>> ReadStringsOf(const Handle& file_type, const Handle& space,
                                                      const Read& read) {
  constexpr hssize_t kMostStrings = 10'000'000;
  constexpr std::size_t kMostBytes = 1U << 20;
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (H5Tget_class(file_type.get()) != H5T_STRING || count < 0 || count > kMostStrings) return {};
  const auto size = static_cast<std::size_t>(count);
  const bool variable = H5Tis_variable_str(file_type.get()) > 0;
  const Handle type = StringMemoryType(file_type, variable);
  std::vector<std::string> strings(size);
  if (variable) {
    std::vector<char*> pointers(size, nullptr);
    const bool ok = read(type.get(), pointers.data());
    for (std::size_t i = 0; ok && i < size; ++i) strings[i] = pointers[i] ? pointers[i] : "";
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, pointers.data());
    if (!ok) return {};
    return strings;
  }
  const std::size_t bytes = H5Tget_size(file_type.get());
  if (bytes == 0 || bytes > kMostBytes || size * bytes > (std::size_t{1} << 30)) return {};
  std::vector<char> buffer(size * bytes + 1, '\0');
  if (!read(type.get(), buffer.data())) return {};
  for (std::size_t i = 0; i < size; ++i) {
    const char* first = buffer.data() + i * bytes;
    strings[i].assign(first, std::find(first, first + bytes, '\0'));
  }
  return strings;
}

}  // namespace

struct Hdf5File::Impl {
  std::optional<Hdf5Output> output;  // of a new file; outlives it
  Handle file{-1, H5Fclose};
  // The dataset that is being written, item by item.
  Handle values{-1, H5Dclose};
  std::vector<hsize_t> next, chunk;  // where the next item goes, and its extents

  Handle Attribute(const std::string& name, const std::string& object = "/") const {
    const bool there = H5Lexists(file.get(), object.c_str(), H5P_DEFAULT) > 0 &&
                       H5Aexists_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
    return {
        there ? H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT)
              : -1,
        H5Aclose};
  }
  Handle Dataset(const std::string& name) const {
    const bool there = H5Lexists(file.get(), name.c_str(), H5P_DEFAULT) > 0;
    return {there ? H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT) : -1, H5Dclose};
  }
  void Require(bool ok) const {
    if (output) output->RequireWritten();
    if (!ok) throw RuntimeFailure("HDF5 cannot write: out of memory, or a text over 64 KiB");
  }

  // All values of a numeric attribute, converted to the native type of T.
  template <typename T>
  std::optional<std::vector<T>> Numbers(const std::string& name, hid_t native,
                                        std::initializer_list<H5T_class_t> accepted,
                                        const std::string& object = "/") const {
    const Handle attribute = Attribute(name, object);
    if (!attribute) return {};
    const Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    const hssize_t count = H5Sget_simple_extent_npoints(space.get());
    const H5T_class_t kind = H5Tget_class(type.get());
    if (count < 1 || count > 1024 ||
        std::find(accepted.begin(), accepted.end(), kind) == accepted.end()) {
      return {};
    }
    std::vector<T> values(static_cast<std::size_t>(count));
    if (H5Aread(attribute.get(), native, values.data()) < 0) return {};
    return values;
  }

  void Write(const std::string& object, const std::string& name, const Handle& space, hid_t type,
             const void* data) const {
    const Handle attribute(H5Acreate_by_name(file.get(), object.c_str(), name.c_str(), type,
                                             space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    Require(attribute && H5Awrite(attribute.get(), type, data) >= 0);
  }

  // Without time stamps, so that the same content is the same bytes.
  Handle DatasetProperties() const {
    Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.get(), false);
    return properties;
  }
};

Hdf5File::Hdf5File(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Hdf5File::~Hdf5File() {
  const Hdf5Lock lock;
  impl_.reset();
}

std::unique_ptr<Hdf5File> Hdf5File::Open(const std::filesystem::path& path) {
  const Hdf5Lock lock;
  auto impl = std::make_unique<Impl>();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  KeepFewIndexNodes(access.get());
  impl->file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  if (!impl->file) return nullptr;
  return std::unique_ptr<Hdf5File>(new Hdf5File(std::move(impl)));
}

std::unique_ptr<Hdf5File> Hdf5File::Create(const std::filesystem::path& path) {
  const Hdf5Lock lock;
  auto impl = std::make_unique<Impl>();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  KeepFewIndexNodes(access.get());
  // The file format of HDF5 1.8 (2008) has check sums on its metadata: in the default one a damaged
  // byte can lead the library out of its buffers. In later ones chunks have an index that readers
  // besides the library do not know.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  impl->output.emplace(path);
  impl->output->Catch(access.get());
  impl->file =
      Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  impl->Require(static_cast<bool>(impl->file));
  return std::unique_ptr<Hdf5File>(new Hdf5File(std::move(impl)));
}

std::optional<std::string> Hdf5File::StringAttribute(const std::string& name,
                                                     const std::string& object) const {
  const Hdf5Lock lock;
  const Handle attribute = impl_->Attribute(name, object);
  if (!attribute) return {};
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  auto strings = ReadStringsOf(type, space, [&](hid_t memory_type, void* data) {
    return H5Aread(attribute.get(), memory_type, data) >= 0;
  });
  if (!strings || strings->size() != 1) return {};
  return strings->front();
}

std::optional<std::uint64_t> Hdf5File::UintAttribute(const std::string& name) const {
  const Hdf5Lock lock;
  const auto values = impl_->Numbers<std::uint64_t>(name, H5T_NATIVE_UINT64, {H5T_INTEGER});
  if (!values || values->size() != 1) return {};
  return values->front();
}

std::optional<std::vector<double>> Hdf5File::DoublesAttribute(const std::string& name,
                                                              const std::string& object) const {
  const Hdf5Lock lock;
  return impl_->Numbers<double>(name, H5T_NATIVE_DOUBLE, {H5T_FLOAT, H5T_INTEGER}, object);
}

std::optional<double> Hdf5File::DoubleAttribute(const std::string& name,
                                                const std::string& object) const {
  const auto values = DoublesAttribute(name, object);
  if (!values || values->size() != 1) return {};
  return values->front();
}

std::vector<std::uint64_t> Hdf5File::Extents(const std::string& name) const {
  const Hdf5Lock lock;
  const Handle dataset = impl_->Dataset(name);
  if (!dataset) return {};
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank <= 0) return {};
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

std::uint64_t Hdf5File::StoredBytes(const std::string& name) const {
  const Hdf5Lock lock;
  const Handle dataset = impl_->Dataset(name);
  return dataset ? H5Dget_storage_size(dataset.get()) : 0;
}

bool Hdf5File::HoldsFloats(const std::string& name) const {
  const Hdf5Lock lock;
  const Handle dataset = impl_->Dataset(name);
  if (!dataset) return false;
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  return H5Tget_class(type.get()) == H5T_FLOAT;
}

bool Hdf5File::ReadFloats(const std::string& name, std::uint64_t item, float* values) const {
  const Hdf5Lock lock;
  const Handle dataset = impl_->Dataset(name);
  const std::vector<std::uint64_t> extents = Extents(name);
  if (!dataset || extents.empty()) return false;
  std::vector<hsize_t> start(extents.size(), 0), count(extents.begin(), extents.end());
  start[0] = item;
  count[0] = 1;
  if (!ItemIsStored(dataset, start, count)) return false;
  const Handle file_space(H5Dget_space(dataset.get()), H5Sclose);
  const Handle memory_space(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                            H5Sclose);
  return H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(),
                             nullptr) >= 0 &&
         H5Dread(dataset.get(), H5T_NATIVE_FLOAT, memory_space.get(), file_space.get(), H5P_DEFAULT,
                 values) >= 0;
}

std::optional<std::vector<std::string>> Hdf5File::ReadStrings(const std::string& name) const {
  const Hdf5Lock lock;
  const Handle dataset = impl_->Dataset(name);
  if (!dataset) return {};
  const Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Handle space(H5Dget_space(dataset.get()), H5Sclose);
  return ReadStringsOf(type, space, [&](hid_t memory_type, void* data) {
    return H5Dread(dataset.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
  });
}

void Hdf5File::WriteAttribute(const std::string& name, const std::string& value,
                              const std::string& object) {
  const Hdf5Lock lock;
  std::string padded = value;
  padded.resize(std::max<std::size_t>(value.size(), 1));  // HDF5 has no strings of length 0
  impl_->Write(object, name, {H5Screate(H5S_SCALAR), H5Sclose}, Utf8Type(padded.size()).get(),
               padded.data());
}

void Hdf5File::WriteAttribute(const std::string& name, std::uint64_t value) {
  const Hdf5Lock lock;
  impl_->Write("/", name, {H5Screate(H5S_SCALAR), H5Sclose}, H5T_NATIVE_UINT64, &value);
}

void Hdf5File::WriteAttribute(const std::string& name, double value, const std::string& object) {
  const Hdf5Lock lock;
  impl_->Write(object, name, {H5Screate(H5S_SCALAR), H5Sclose}, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::WriteAttribute(const std::string& name, const std::vector<double>& values) {
  const Hdf5Lock lock;
  const hsize_t count = values.size();
  impl_->Write("/", name, {H5Screate_simple(1, &count, nullptr), H5Sclose}, H5T_NATIVE_DOUBLE,
               values.data());
}

void Hdf5File::CreateFloats(const std::string& name, std::uint64_t count,
                            const std::vector<std::uint64_t>& item_extents) {
  const Hdf5Lock lock;
  std::vector<hsize_t> extents(1, count), chunk(1, 1);
  extents.insert(extents.end(), item_extents.begin(), item_extents.end());
  chunk.insert(chunk.end(), item_extents.begin(), item_extents.end());
  const int rank = static_cast<int>(extents.size());
  const Handle space(H5Screate_simple(rank, extents.data(), nullptr), H5Sclose);
  const Handle properties = impl_->DatasetProperties();
  H5Pset_chunk(properties.get(), rank, chunk.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), 4);
  H5Pset_fletcher32(properties.get());  // damage is an error, not another shape
  impl_->values = Handle(H5Dcreate2(impl_->file.get(), name.c_str(), H5T_IEEE_F32LE, space.get(),
                                    H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                         H5Dclose);
  impl_->Require(static_cast<bool>(impl_->values));
  impl_->next.assign(extents.size(), 0);
  impl_->chunk = std::move(chunk);
}

void Hdf5File::AppendFloats(const float* values) {
  const Hdf5Lock lock;
  const Handle space(H5Dget_space(impl_->values.get()), H5Sclose);
  const Handle chunk_space(
      H5Screate_simple(static_cast<int>(impl_->chunk.size()), impl_->chunk.data(), nullptr),
      H5Sclose);
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, impl_->next.data(), nullptr, impl_->chunk.data(),
                      nullptr);
  impl_->Require(H5Dwrite(impl_->values.get(), H5T_NATIVE_FLOAT, chunk_space.get(), space.get(),
                          H5P_DEFAULT, values) >= 0);
  ++impl_->next[0];
}

void Hdf5File::WriteStrings(const std::string& name, const std::vector<std::string>& values) {
  const Hdf5Lock lock;
  impl_->Require(impl_->values.Release());  // what is before these in the file is all there
  std::size_t bytes = 1;
  for (const std::string& value : values) bytes = std::max(bytes, value.size());
  std::vector<char> buffer(bytes * values.size() + 1, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::copy(values[i].begin(), values[i].end(),
              buffer.begin() + static_cast<std::ptrdiff_t>(i * bytes));
  }
  const hsize_t count = values.size();
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle type = Utf8Type(bytes);
  const Handle properties = impl_->DatasetProperties();
  const Handle dataset(H5Dcreate2(impl_->file.get(), name.c_str(), type.get(), space.get(),
                                  H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                       H5Dclose);
  impl_->Require(dataset && H5Dwrite(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                     buffer.data()) >= 0);
}

void Hdf5File::Close() {
  const Hdf5Lock lock;
  const bool closed = impl_->values.Release() && impl_->file.Release();
  impl_->Require(closed);
}

}  // namespace antigrasp
