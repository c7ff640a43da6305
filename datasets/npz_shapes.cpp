#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/spool.h"
#include "antigrasp/datasets/npy_grids.h"
#include "antigrasp/datasets/npy_text.h"
#include "antigrasp/datasets/npz_archive.h"
#include "antigrasp/mesh/text_scanner.h"

// Grids and what they mean as an archive of NumPy's arrays.
namespace antigrasp {
namespace {

constexpr const char* kNpzFormat = "antigrasp.sdf";
constexpr std::size_t kLongestText = std::size_t{64} << 20;  // of all names

// The arrays of an archive beside its grids.
class NpzMeaning {
 public:
  NpzMeaning(const NpzArchive& archive, std::string path)
      : archive_(archive), path_(std::move(path)) {}
  bool Has(const std::string& name) const {
    return std::find(archive_.Names().begin(), archive_.Names().end(), name) !=
           archive_.Names().end();
  }
  std::vector<std::string> Texts(const std::string& name) const {
    return Has(name) ? NpyTexts(archive_.Read(name, kLongestText), Where(name))
                     : std::vector<std::string>();
  }
  std::string Text(const std::string& name) const {
    const std::vector<std::string> texts = Texts(name);
    if (texts.size() == 1) return texts[0];
    throw InputError("no usable " + name, path_, name + ", a string");
  }
  std::vector<double> Numbers(const std::string& name, std::size_t count) const {
    const std::vector<double> numbers = NpyNumbers(Bytes(name), Where(name));
    if (numbers.size() == count &&
        std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
      return numbers;
    }
    throw InputError("no usable " + name, path_, name + ", " + std::to_string(count) + " numbers");
  }
  std::string Bytes(const std::string& name) const {
    if (Has(name)) return archive_.Read(name, kLongestNpyHeader);
    throw InputError("no " + name + " in the archive", path_, "the array " + name);
  }
  std::string Where(const std::string& name) const { return path_ + ", " + name; }

 private:
  const NpzArchive& archive_;
  std::string path_;
};

// The array of the grids: sdf, or the only one.
std::string NameOfGrids(const NpzArchive& archive, const std::string& path) {
  const std::vector<std::string>& names = archive.Names();
  if (std::find(names.begin(), names.end(), "sdf") != names.end()) return "sdf";
  if (names.size() == 1) return names[0];
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 8); ++i) {
    text += (text.empty() ? "" : ", ") + Quoted(names[i]);
  }
  throw InputError(names.empty() ? "no array in the archive" : "arrays " + text, path,
                   "one named sdf");
}

void ReadMeaning(const NpzMeaning& says, const std::string& path, ForeignGrids* grids) {
  if (says.Has("spacing")) {
    grids->spacing = says.Numbers("spacing", 1)[0];
    if (!(grids->spacing > 0.0)) throw InputError("no usable spacing", path, "a length above 0");
  }
  if (!says.Has("format") || says.Text("format") != kNpzFormat) return;
  grids->says = true;
  if (says.Text("sign") != "positive inside") {
    throw InputError("sign = " + Quoted(says.Text("sign")), path, "sign = \"positive inside\"");
  }
  grids->info.kind = says.Text("kind");
  grids->info.provenance = says.Text("provenance");
  grids->info.seed = NpySeed(says.Bytes("seed"), says.Where("seed"));
  grids->info.truncation = says.Numbers("truncation", 1)[0];
  if (says.Has("side")) grids->info.side = says.Numbers("side", 1)[0];
  const std::vector<double> origin = says.Numbers("origin", 3);
  grids->origin = Eigen::Vector3d(origin.data());
  if (!(grids->spacing > 0.0 && grids->info.truncation >= 0.0 && grids->info.side >= 0.0)) {
    throw InputError("spacing, truncation or side below 0", path, "lengths");
  }
}

class NpzSink : public GridSink {
 public:
  explicit NpzSink(const std::filesystem::path& path)
      : target_(path), grids_(path.string() + ".sdf"), archive_(path.string() + ".zip") {}

  void Begin(const ShapeSet& about, std::size_t count, const SdfGrid& first) override {
    const auto n = static_cast<std::uint64_t>(first.n);
    grids_.Append(NpyHeaderText("<f4", {count, n, n, n}));
    arrays_.emplace_back("format", NpyOfTexts({kNpzFormat}, true));
    arrays_.emplace_back("sign", NpyOfTexts({"positive inside"}, true));
    arrays_.emplace_back("unit", NpyOfTexts({"side of the unit cube"}, true));
    arrays_.emplace_back("kind", NpyOfTexts({about.kind}, true));
    arrays_.emplace_back("seed", NpyOfSeed(about.seed));
    arrays_.emplace_back("spacing", NpyOfNumbers({first.spacing}, true));
    arrays_.emplace_back(
        "origin", NpyOfNumbers({first.origin.x(), first.origin.y(), first.origin.z()}, false));
    arrays_.emplace_back("truncation", NpyOfNumbers({about.truncation}, true));
    if (about.side > 0.0) arrays_.emplace_back("side", NpyOfNumbers({about.side}, true));
    arrays_.emplace_back("provenance", NpyOfTexts({about.provenance}, true));
  }
  void Add(const std::vector<float>& values) override {
    grids_.Append({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
  }
  void Commit(const std::vector<std::string>& names) override {
    NpzOutput zip(archive_.temp_path());
    zip.AddFile("sdf", grids_.temp_path());
    zip.Add("names", NpyOfTexts(names, false));
    for (auto& [name, bytes] : arrays_) zip.Add(name, std::move(bytes));
    zip.Close();
    std::ifstream in(archive_.temp_path(), std::ios::binary);
    std::string piece(std::size_t{1} << 20, '\0');
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0) {
      target_.Append({piece.data(), static_cast<std::size_t>(in.gcount())});
    }
    target_.Commit();
  }

 private:
  AtomicFile target_;
  // libzip reads what it packs from files and puts another file in the place of its own: these two
  // are never committed.
  AtomicFile grids_, archive_;
  std::vector<std::pair<std::string, std::string>> arrays_;
};

}  // namespace

ForeignGrids ReadNpzGrids(const std::filesystem::path& path) {
  RequireFile(path, "a NumPy archive of grids");
  const NpzArchive archive(path);
  const std::string sdf = NameOfGrids(archive, path.string());
  const NpzMeaning says(archive, path.string());
  const NpyGrids array =
      NpyGridsOf(ParseNpyHeader(says.Bytes(sdf), says.Where(sdf)), says.Where(sdf));
  ForeignGrids grids;
  grids.info.format = ShapeFormat::kNpz;
  grids.info.count = static_cast<int>(array.count);
  grids.info.n = static_cast<int>(array.n);
  ReadMeaning(says, path.string(), &grids);
  grids.names = says.Texts("names");
  if (grids.names.empty() && !grids.says) grids.names = NamesAfterFile(path, array.count);
  if (grids.names.size() != array.count) {
    throw InputError(std::to_string(grids.names.size()) + " names", path.string(),
                     std::to_string(array.count) + ", one a grid");
  }
  const auto spool =
      std::make_shared<Spool>(std::filesystem::temp_directory_path() / "antigrasp-npz");
  archive.ReadAll(sdf, array.bytes(),
                  [&](std::string_view piece) { spool->Append(piece.data(), piece.size()); });
  grids.read = [spool, array](int i, std::span<float> values) {
    std::string bytes(values.size() * array.float_size, '\0');
    spool->Read(array.begin + static_cast<std::uint64_t>(i) * bytes.size(), bytes.data(),
                bytes.size());
    NpyToFloats(bytes, array.float_size, values);
  };
  return grids;
}

std::unique_ptr<GridSink> MakeNpzSink(const std::filesystem::path& path) {
  return std::make_unique<NpzSink>(path);
}

}  // namespace antigrasp
