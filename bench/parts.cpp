// How convex parts fit the objects of files, and what they take: bench_parts MOST OBJECT...
// How the hulls of other meshes fit a solid: bench_parts given SOLID PART...
// One thread; processor time.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/bundle/convex_parts.h"
#include "antigrasp/bundle/part_errors.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/mesh/mesh_file.h"

namespace {

using namespace antigrasp;

double ProcessorSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Column {
  const char* name;
  double bar;
  std::vector<double> values;
};

void PrintColumn(Column column) {
  std::sort(column.values.begin(), column.values.end());
  const auto held = std::count_if(column.values.begin(), column.values.end(),
                                  [&](double value) { return value <= column.bar; });
  const std::size_t n = column.values.size();
  std::printf("%-10s median %.3g  90 %% %.3g  worst %.3g  at most %g: %lld of %zu\n", column.name,
              column.values[n / 2], column.values[n * 9 / 10], column.values[n - 1], column.bar,
              static_cast<long long>(held), n);
}

const char* kHead =
    "object,parts,covered,missing,hausdorff_cells,dent_cells,seconds,measuring_seconds\n";

// The row of a solid and its parts; percent, cells, seconds.
std::vector<double> Row(const std::string& name, const TriangleMesh& solid,
                        const std::function<std::vector<ConvexPart>()>& make) {
  const double cell = CellOf(solid), start = ProcessorSeconds();
  const std::vector<ConvexPart> parts = make();
  const double made = ProcessorSeconds();
  const PartErrors errors = MeasureParts(solid, parts, cell);
  const std::vector<double> values{
      static_cast<double>(parts.size()), 100.0 * errors.covered, 100.0 * errors.missing,
      errors.hausdorff / cell,           errors.dent / cell,     made - start,
      ProcessorSeconds() - made};
  std::printf("%s", name.c_str());
  for (const double value : values) std::printf(",%.4g", value);
  std::printf("\n");
  std::fflush(stdout);
  return values;
}

void PrintGiven(const std::string& solid, const std::vector<std::string>& parts) {
  std::printf("%s", kHead);
  Row(solid, ReadMesh(solid), [&] {
    std::vector<ConvexPart> hulls;
    for (const std::string& part : parts) {
      ConvexPart hull = MakeConvexPart(ReadMesh(part).vertices);
      if (!hull.empty()) hulls.push_back(std::move(hull));
    }
    return hulls;
  });
}

int PrintMade(int most, const std::vector<std::string>& files) {
  PartOptions options;
  options.parts = most;
  const ObjectSource objects(files, GridUnit::kOfFiles);
  std::vector<Column> columns{{"parts", 32, {}},      {"covered %", 2, {}}, {"missing %", 2, {}},
                              {"Hausdorff", 0.5, {}}, {"dent", 1, {}},      {"seconds", 1, {}},
                              {"measuring", 1, {}}};
  int all = 0;
  std::printf("%s", kHead);
  for (std::int64_t i = 0; i < objects.size(); ++i) {
    const InputObject object = objects.Load(i);
    if (!object.ok()) continue;
    const auto values =
        Row(object.name, object.mesh, [&] { return ConvexParts(object.mesh, options); });
    bool holds = true;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      columns[k].values.push_back(values[k]);
      if (k > 0 && k < 5) holds = holds && values[k] <= columns[k].bar;
    }
    all += holds ? 1 : 0;
  }
  if (columns[0].values.empty()) return 1;
  for (const Column& column : columns) PrintColumn(column);
  std::printf("all bars of error: %d of %zu\n", all, columns[0].values.size());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "bench_parts MOST OBJECT...\nbench_parts given SOLID PART...\n");
    return 2;
  }
  const std::vector<std::string> files(argv + 2, argv + argc);
  if (std::string(argv[1]) != "given") return PrintMade(std::atoi(argv[1]), files);
  PrintGiven(files[0], {files.begin() + 1, files.end()});
  return 0;
}
