#include "antigrasp/export/print_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/core/csv_writer.h"

namespace antigrasp {
namespace {

constexpr std::size_t kMostLines = 12;  // more objects get totals only

std::string SizeText(const Eigen::Vector3d& mm) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f x %.1f x %.1f", mm.x(), mm.y(), mm.z());
  return text;
}

std::string WallText(const std::optional<double>& mm) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", mm.value_or(0.0));
  return mm ? text : "-";
}

std::string Line(const std::string& name, const std::string& size, const std::string& wall,
                 const std::string& overhang, const std::string& contact,
                 const std::string& probability, std::size_t width) {
  const auto padded = [](const std::string& text, std::size_t to) {
    return text + std::string(text.size() < to ? to - text.size() : 0, ' ') + "  ";
  };
  return "  " + padded(name, width) + padded(size, 20) + padded(wall, 7) + padded(overhang, 8) +
         padded(contact, 12) + probability + "\n";
}

std::string Table(const std::vector<PrintedObject>& objects) {
  std::size_t width = 6;
  for (const PrintedObject& item : objects) width = std::max(width, item.name.size());
  std::string text = Line("object", "size in the pose, mm", "wall mm", "overhang", "on plate mm2",
                          "pose probability", width);
  for (const PrintedObject& item : objects) {
    char overhang[32], contact[32], probability[32];
    std::snprintf(overhang, sizeof overhang, "%.0f %%", 100.0 * item.check.overhang_share);
    std::snprintf(contact, sizeof contact, "%.0f", item.check.contact_mm2);
    std::snprintf(probability, sizeof probability, "%.0f %%", 100.0 * item.check.pose_probability);
    text += Line(item.name, SizeText(item.check.print_size_mm), WallText(item.check.wall_mm),
                 overhang, contact, probability, width);
  }
  return text;
}

}  // namespace

std::string PrintCsv(const std::vector<PrintedObject>& objects) {
  CsvWriter csv({"object",
                 "watertight",
                 "size_x_mm",
                 "size_y_mm",
                 "size_z_mm",
                 "wall_mm",
                 "thin_share",
                 "print_x_mm",
                 "print_y_mm",
                 "print_z_mm",
                 "overhang_share",
                 "contact_mm2",
                 "pose_probability",
                 "r00",
                 "r01",
                 "r02",
                 "r10",
                 "r11",
                 "r12",
                 "r20",
                 "r21",
                 "r22",
                 "notes"});
  const auto add = [&](const Eigen::Vector3d& v) { csv.Numbers({v.x(), v.y(), v.z()}); };
  for (const PrintedObject& item : objects) {
    const PrintCheck& check = item.check;
    csv.Text(item.name).Count(check.watertight);
    add(check.size_mm);
    csv.NumberOrGap(check.wall_mm.value_or(std::nan("")));
    csv.Number(check.thin_share);
    add(check.print_size_mm);
    csv.Numbers({check.overhang_share, check.contact_mm2, check.pose_probability});
    for (int row = 0; row < 3; ++row) add(check.table_from_object.row(row));
    std::string notes;
    for (const std::string& note : check.notes) notes += (notes.empty() ? "" : " ") + note;
    csv.Text(notes).EndRow();
  }
  return csv.text();
}

std::string PrintSummary(const std::vector<PrintedObject>& objects, const PrintOptions& options) {
  std::size_t thin = 0, hanging = 0;
  double thinnest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const PrintedObject& item : objects) {
    const double wall = item.check.wall_mm.value_or(std::numeric_limits<double>::infinity());
    thinnest = std::min(thinnest, wall);
    thin += item.check.thin ? 1 : 0;
    largest = std::max(largest, item.check.overhang_share);
    hanging += item.check.overhang_share > options.max_overhang ? 1 : 0;
  }
  char text[300];
  std::snprintf(
      text, sizeof text,
      "print check (print.csv): %zu watertight; %zu with a wall below %g mm, the thinnest "
      "%s mm; %zu with more than %.0f %% overhang, the most %.0f %%\n",
      objects.size(), thin, options.min_wall_mm,
      std::isinf(thinnest) ? "-" : WallText(thinnest).c_str(), hanging,
      100.0 * options.max_overhang, 100.0 * largest);
  return (objects.size() <= kMostLines ? Table(objects) : std::string()) + text;
}

}  // namespace antigrasp
