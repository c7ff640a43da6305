#include "antigrasp/datasets/hdf5_tree.h"

#include <algorithm>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/hdf5_chunk.h"
#include "antigrasp/datasets/hdf5_handle.h"
#include "antigrasp/datasets/hdf5_lock.h"
#include "antigrasp/datasets/hdf5_output.h"

namespace antigrasp {
namespace {

constexpr hssize_t kMostNumbers = hssize_t{1} << 24;
constexpr std::size_t kLongestText = 1U << 16;

Hdf5Handle FreeText() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle SpaceOf(const std::vector<std::uint64_t>& extents) {
  const std::vector<hsize_t> sizes(extents.begin(), extents.end());
  return {sizes.empty() ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
          H5Sclose};
}

// One text of either kind; `read` fills a buffer of the given memory type.
template <typename Read>
std::optional<std::string> OneText(const Hdf5Handle& type, const Hdf5Handle& space,
                                   const Read& read) {
  if (H5Tget_class(type.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) {
    return {};
  }
  const Hdf5Handle memory(H5Tcopy(type.get()), H5Tclose);
  if (H5Tis_variable_str(type.get()) > 0) {
    char* text = nullptr;
    if (!read(memory.get(), &text) || text == nullptr) return {};
    std::string copy = text;
    H5Dvlen_reclaim(memory.get(), space.get(), H5P_DEFAULT, &text);
    return copy;
  }
  const std::size_t bytes = H5Tget_size(type.get());
  if (bytes == 0 || bytes > kLongestText) return {};
  std::string text(bytes, '\0');
  if (!read(memory.get(), text.data())) return {};
  return text.substr(0, text.find('\0'));
}

std::optional<std::vector<std::uint64_t>> ExtentsOf(const Hdf5Handle& type,
                                                    const Hdf5Handle& space) {
  const H5T_class_t kind = H5Tget_class(type.get());
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || count < 1 || count > kMostNumbers || rank < 0) {
    return {};
  }
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
  return std::vector<std::uint64_t>(extents.begin(), extents.end());
}

}  // namespace

struct Hdf5Tree::Impl {
  std::optional<Hdf5Output> output;  // of a new file; outlives it
  Hdf5Handle file{-1, H5Fclose};

  void Require(bool ok) const {
    if (output) output->RequireWritten();
    if (!ok) throw RuntimeFailure("HDF5 cannot write: out of memory, or a text over 64 KiB");
  }

  bool Exists(const std::string& path) const {
    // The library asks for every step of the way.
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      if (part != "/" && H5Lexists(file.get(), part.c_str(), H5P_DEFAULT) <= 0) return false;
      if (end == std::string::npos) return true;
    }
  }
  Hdf5Handle Dataset(const std::string& path) const {
    return {Exists(path) ? H5Dopen2(file.get(), path.c_str(), H5P_DEFAULT) : -1, H5Dclose};
  }
  Hdf5Handle Attribute(const std::string& object, const std::string& name) const {
    const bool there = Exists(object) &&
                       H5Aexists_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
    return {
        there ? H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT)
              : -1,
        H5Aclose};
  }
  // Without time stamps, so that the same content is the same bytes.
  void MakeGroups(const std::string& path) const {
    const Hdf5Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.get(), false);
    for (std::size_t end = path.find('/', 1); end != std::string::npos;
         end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      if (H5Lexists(file.get(), part.c_str(), H5P_DEFAULT) > 0) continue;
      const Hdf5Handle group(
          H5Gcreate2(file.get(), part.c_str(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
          H5Gclose);
      Require(static_cast<bool>(group));
    }
  }
  void WriteDataset(const std::string& path, const Hdf5Handle& space, hid_t stored, hid_t memory,
                    const void* values) const {
    MakeGroups(path);
    const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.get(), false);
    const Hdf5Handle dataset(H5Dcreate2(file.get(), path.c_str(), stored, space.get(), H5P_DEFAULT,
                                        properties.get(), H5P_DEFAULT),
                             H5Dclose);
    Require(dataset && H5Dwrite(dataset.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  }
  void WriteAttribute(const std::string& object, const std::string& name, const Hdf5Handle& space,
                      hid_t stored, hid_t memory, const void* values) const {
    const Hdf5Handle attribute(
        H5Acreate_by_name(file.get(), object.c_str(), name.c_str(), stored, space.get(),
                          H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    Require(attribute && H5Awrite(attribute.get(), memory, values) >= 0);
  }
};

Hdf5Tree::Hdf5Tree(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Hdf5Tree::~Hdf5Tree() {
  const Hdf5Lock lock;
  impl_.reset();
}

std::unique_ptr<Hdf5Tree> Hdf5Tree::Open(const std::filesystem::path& path) {
  const Hdf5Lock lock;
  auto impl = std::make_unique<Impl>();
  impl->file = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!impl->file) return nullptr;
  return std::unique_ptr<Hdf5Tree>(new Hdf5Tree(std::move(impl)));
}

std::unique_ptr<Hdf5Tree> Hdf5Tree::Create(const std::filesystem::path& path) {
  const Hdf5Lock lock;
  auto impl = std::make_unique<Impl>();
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  impl->output.emplace(path);
  impl->output->Catch(access.get());
  impl->file =
      Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  impl->Require(static_cast<bool>(impl->file));
  return std::unique_ptr<Hdf5Tree>(new Hdf5Tree(std::move(impl)));
}

std::vector<std::string> Hdf5Tree::Children(const std::string& group) const {
  const Hdf5Lock lock;
  const Hdf5Handle opened(
      impl_->Exists(group) ? H5Gopen2(impl_->file.get(), group.c_str(), H5P_DEFAULT) : -1,
      H5Gclose);
  std::vector<std::string> names;
  if (!opened) return names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  hsize_t next = 0;
  H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, &next, add, &names);
  return names;
}

std::optional<Hdf5Numbers> Hdf5Tree::Numbers(const std::string& path) const {
  const Hdf5Lock lock;
  const Hdf5Handle dataset = impl_->Dataset(path);
  if (!dataset) return {};
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const auto extents = ExtentsOf(type, space);
  if (!extents) return {};
  Hdf5Numbers numbers{*extents, std::vector<double>(static_cast<std::size_t>(std::max<hssize_t>(
                                    H5Sget_simple_extent_npoints(space.get()), 0)))};
  const std::vector<hsize_t> start(extents->size(), 0), whole(extents->begin(), extents->end());
  if (!whole.empty() && !ItemIsStored(dataset, start, whole)) return {};
  if (H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
              numbers.values.data()) < 0) {
    return {};
  }
  return numbers;
}

std::optional<std::string> Hdf5Tree::Text(const std::string& path) const {
  const Hdf5Lock lock;
  const Hdf5Handle dataset = impl_->Dataset(path);
  if (!dataset) return {};
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose);
  return OneText(type, space, [&](hid_t memory, void* data) {
    return H5Dread(dataset.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
  });
}

std::optional<Hdf5Numbers> Hdf5Tree::NumbersAttribute(const std::string& object,
                                                      const std::string& name) const {
  const Hdf5Lock lock;
  const Hdf5Handle attribute = impl_->Attribute(object, name);
  if (!attribute) return {};
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  const auto extents = ExtentsOf(type, space);
  if (!extents) return {};
  Hdf5Numbers numbers{
      *extents,
      std::vector<double>(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())))};
  if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, numbers.values.data()) < 0) return {};
  return numbers;
}

std::optional<std::string> Hdf5Tree::TextAttribute(const std::string& object,
                                                   const std::string& name) const {
  const Hdf5Lock lock;
  const Hdf5Handle attribute = impl_->Attribute(object, name);
  if (!attribute) return {};
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  return OneText(type, space, [&](hid_t memory, void* data) {
    return H5Aread(attribute.get(), memory, data) >= 0;
  });
}

void Hdf5Tree::Group(const std::string& path) {
  const Hdf5Lock lock;
  impl_->MakeGroups(path + "/");
}

void Hdf5Tree::Write(const std::string& path, const Hdf5Numbers& numbers) {
  const Hdf5Lock lock;
  impl_->WriteDataset(path, SpaceOf(numbers.extents), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
                      numbers.values.data());
}

void Hdf5Tree::WriteWhole(const std::string& path, const Hdf5Numbers& numbers) {
  const Hdf5Lock lock;
  const std::vector<std::int64_t> values(numbers.values.begin(), numbers.values.end());
  impl_->WriteDataset(path, SpaceOf(numbers.extents), H5T_STD_I64LE, H5T_NATIVE_INT64,
                      values.data());
}

void Hdf5Tree::WriteText(const std::string& path, const std::string& text) {
  const Hdf5Lock lock;
  const char* const pointer = text.c_str();
  const Hdf5Handle type = FreeText();
  impl_->WriteDataset(path, SpaceOf({}), type.get(), type.get(), &pointer);
}

void Hdf5Tree::WriteAttribute(const std::string& object, const std::string& name,
                              const Hdf5Numbers& numbers) {
  const Hdf5Lock lock;
  impl_->WriteAttribute(object, name, SpaceOf(numbers.extents), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
                        numbers.values.data());
}

void Hdf5Tree::WriteWholeAttribute(const std::string& object, const std::string& name,
                                   std::int64_t value) {
  const Hdf5Lock lock;
  impl_->WriteAttribute(object, name, SpaceOf({}), H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void Hdf5Tree::WriteTextAttribute(const std::string& object, const std::string& name,
                                  const std::string& text) {
  const Hdf5Lock lock;
  const char* const pointer = text.c_str();
  const Hdf5Handle type = FreeText();
  impl_->WriteAttribute(object, name, SpaceOf({}), type.get(), type.get(), &pointer);
}

void Hdf5Tree::Close() {
  const Hdf5Lock lock;
  const bool closed = impl_->file.Release();
  impl_->Require(closed);
}

}  // namespace antigrasp
