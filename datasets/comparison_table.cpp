#include "antigrasp/datasets/comparison_table.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/core/csv_writer.h"

namespace antigrasp {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string Cell(double value, double factor) {
  if (std::isnan(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", factor * value);
  return text;
}

std::string Line(const char* label, const std::string& samples, const std::string& reference) {
  char text[96];
  std::snprintf(text, sizeof text, "%-36s %10s %10s\n", label, samples.c_str(), reference.c_str());
  return text;
}

}  // namespace

ComparisonTable::ComparisonTable(const SurfaceComparison& found, std::size_t count,
                                 int samples_left_out, int reference_left_out) {
  const auto shapes = static_cast<double>(count);
  const SetComparison& sets = found.sets;
  const SpreadComparison& spread = found.spread;
  const SetLook &a = found.samples, &b = found.reference;
  rows_ = {
      {"shapes", "shapes", shapes, shapes},
      {"left_out", "left out: no solid", double(samples_left_out), double(reference_left_out)},
      {"size", "size (mean diagonal)", a.size, b.size},
      {"coverage", "coverage (COV), %", sets.coverage, kNone, 100.0},
      {"nna", "1-NN accuracy (1-NNA), %", sets.nna, kNone, 100.0},
      {"matching", "minimum matching distance (MMD)", sets.matching, kNone},
      {"nearest_reference", "to the nearest reference shape", sets.to_reference,
       sets.within_reference},
      {"floor", "two samplings of one shape", a.floor, b.floor},
      {"near_duplicates", "near-duplicates, %", spread.samples.duplicates,
       spread.reference.duplicates, 100.0},
      {"mean_distance", "mean distance of two shapes", spread.samples.mean_distance,
       spread.reference.mean_distance},
      {"diversity", "diversity, by the reference's", spread.diversity, kNone},
      {"vendi", "different shapes (Vendi score)", a.vendi, b.vendi},
      {"roughness", "roughness (dihedral), degrees", a.roughness, b.roughness},
      {"flat_share", "edges below 2 degrees, % of length", a.flat, b.flat, 100.0},
      {"crease_share", "edges above 30 degrees, %", a.crease, b.crease, 100.0},
      {"dihedral_distance", "edge angles apart, degrees", found.dihedral_distance, kNone},
  };
  if (found.normals) {
    rows_.push_back(
        {"coverage_normals", "COV with normals, %", found.normals->coverage, kNone, 100.0});
    rows_.push_back({"nna_normals", "1-NNA with normals, %", found.normals->nna, kNone, 100.0});
  }
  if (!found.memorisation) return;
  const Memorisation& m = *found.memorisation;
  rows_.push_back({"nearest_training", "to the nearest training shape", m.samples, m.reference});
  rows_.push_back(
      {"nearer_to_training", "nearer to it than held-out ones, %", m.nearer, kNone, 100.0});
}

std::string ComparisonTable::Csv() const {
  CsvWriter csv({"measure", "samples", "reference"});
  for (const Row& row : rows_) {
    csv.Text(row.name).NumbersOrGaps({row.samples, row.reference});
    csv.EndRow();
  }
  return csv.text();
}

std::string ComparisonTable::Text() const {
  std::string text = Line("", "samples", "reference");
  for (const Row& row : rows_) {
    text += Line(row.label, Cell(row.samples, row.factor), Cell(row.reference, row.factor));
  }
  return text;
}

std::vector<std::string> DoubtsOf(const SurfaceComparison& found) {
  std::vector<std::string> doubts;
  char text[200];
  const double ratio = found.samples.size / found.reference.size;
  if (ratio > 2.0 || ratio < 0.5) {
    std::snprintf(text, sizeof text,
                  "the samples are %.3g times as large as the reference: same unit?", ratio);
    doubts.emplace_back(text);
  }
  const double nearest = found.sets.within_reference;
  if (nearest < 1.25 * found.reference.floor) {
    std::snprintf(text, sizeof text,
                  "reference shapes are %.3g from their nearest, two samplings of one shape %.3g: "
                  "coverage, 1-NNA and near-duplicates are largely chance; more --points",
                  nearest, found.reference.floor);
    doubts.emplace_back(text);
  }
  return doubts;
}

}  // namespace antigrasp
