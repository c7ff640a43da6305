#include "antigrasp/datasets/import_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/statistics.h"

namespace antigrasp {

std::string ImportCsv(const std::vector<ImportedMesh>& meshes) {
  CsvWriter csv({"path", "status", "detail", "nodes"});
  for (const ImportedMesh& mesh : meshes) {
    csv.Text(mesh.path).Text(mesh.status).Text(mesh.detail);
    csv.NumberOrGap(mesh.nodes > 0.0 ? mesh.nodes : std::nan("")).EndRow();
  }
  return csv.text();
}

std::string ImportText(const std::vector<ImportedMesh>& meshes, const std::string& out,
                       int resolution) {
  std::map<std::string, int> counts;
  std::vector<double> nodes;
  std::string text;
  for (const ImportedMesh& mesh : meshes) {
    ++counts[mesh.status];
    if (mesh.status == "skipped") continue;  // of a known set there are several an object
    if (mesh.status != "refused") nodes.push_back(mesh.nodes);
    if (mesh.status == "accepted") continue;
    const std::string padding(mesh.status.size() < 8 ? 8 - mesh.status.size() : 0, ' ');
    text += mesh.status + padding + " " + mesh.path + ": " + mesh.detail + "\n";
  }
  char line[160];
  std::snprintf(line, sizeof line, ": %zu shapes (%d accepted, %d repaired, %d refused",
                nodes.size(), counts["accepted"], counts["repaired"], counts["refused"]);
  text += out + line;
  if (counts["skipped"] > 0) text += ", " + std::to_string(counts["skipped"]) + " skipped";
  text += ")\n";
  const auto [least, most] = std::minmax_element(nodes.begin(), nodes.end());
  std::snprintf(line, sizeof line, "longest sides: %.3g to %.3g of %d nodes, median %.3g\n", *least,
                *most, resolution, DiscretePercentile(nodes, 50.0));
  return text + line;
}

}  // namespace antigrasp
