#include "antigrasp/render/contact_sheet.h"

#include <algorithm>

namespace antigrasp {

Image ContactSheet(const std::vector<std::vector<const TriangleMesh*>>& rows, const View& view,
                   int threads, const ProgressFn& progress) {
  std::size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  Image sheet(static_cast<int>(columns) * view.pixels, static_cast<int>(rows.size()) * view.pixels);
  const auto draw = [&](std::int64_t i) {
    const std::size_t row = static_cast<std::size_t>(i) / columns;
    const std::size_t column = static_cast<std::size_t>(i) % columns;
    if (column >= rows[row].size() || rows[row][column] == nullptr) return;
    Paste(RenderMesh(*rows[row][column], view), static_cast<int>(column) * view.pixels,
          static_cast<int>(row) * view.pixels, &sheet);
  };
  ParallelFor(static_cast<std::int64_t>(rows.size() * columns), threads, draw, progress);
  return sheet;
}

}  // namespace antigrasp
