#include "antigrasp/export/print_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

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

PrintTable::PrintTable(const PrintOptions& options)
    : options_(options),
      csv_({"object",
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
            "notes",
            "file"}),
      thinnest_(std::numeric_limits<double>::infinity()) {}

void PrintTable::Add(PrintedObject object) {
  const PrintCheck& check = object.check;
  const auto add = [&](const Eigen::Vector3d& v) { csv_.Numbers({v.x(), v.y(), v.z()}); };
  csv_.Text(object.name).Count(check.watertight);
  add(check.size_mm);
  csv_.NumberOrGap(check.wall_mm.value_or(std::nan("")));
  csv_.Number(check.thin_share);
  add(check.print_size_mm);
  csv_.Numbers({check.overhang_share, check.contact_mm2, check.pose_probability});
  for (int row = 0; row < 3; ++row) add(check.table_from_object.row(row));
  std::string notes;
  for (const std::string& note : check.notes) notes += (notes.empty() ? "" : " ") + note;
  csv_.Text(notes).Text(object.file).EndRow();

  const double wall = check.wall_mm.value_or(std::numeric_limits<double>::infinity());
  thinnest_ = std::min(thinnest_, wall);
  thin_ += check.thin ? 1 : 0;
  largest_overhang_ = std::max(largest_overhang_, check.overhang_share);
  hanging_ += check.overhang_share > options_.max_overhang ? 1 : 0;
  ++size_;
  if (first_.size() <= kMostLines) first_.push_back(std::move(object));
}

std::string PrintTable::Summary() const {
  char text[300];
  std::snprintf(
      text, sizeof text,
      "print check (print.csv): %zu watertight; %zu with a wall below %g mm, the thinnest "
      "%s mm; %zu with more than %.0f %% overhang, the most %.0f %%\n",
      size_, thin_, options_.min_wall_mm, std::isinf(thinnest_) ? "-" : WallText(thinnest_).c_str(),
      hanging_, 100.0 * options_.max_overhang, 100.0 * largest_overhang_);
  return (size_ <= kMostLines ? Table(first_) : std::string()) + text;
}

}  // namespace antigrasp
