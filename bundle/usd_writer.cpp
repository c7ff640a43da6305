#include "antigrasp/bundle/usd_writer.h"

#include "antigrasp/core/check.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

constexpr std::size_t kIndent = 4;

std::string List(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return "[" + text + "]";
}

}  // namespace

std::string UsdString(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string UsdTuple(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + FormatDouble(value + 0.0);
  return "(" + text + ")";
}

std::string UsdTuple(const Eigen::Vector3d& v) { return UsdTuple({v.x(), v.y(), v.z()}); }

UsdWriter::UsdWriter(std::string_view default_prim, std::string_view comment) {
  text_ = "#usda 1.0\n(\n    defaultPrim = " + UsdString(default_prim) +
          "\n    doc = " + UsdString(comment) +
          "\n    kilogramsPerUnit = 1\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n";
}

void UsdWriter::Open(std::string_view type, std::string_view name,
                     const std::vector<std::string>& schemas,
                     const std::vector<std::string>& metadata) {
  text_ += "\n";
  std::string head = "def " + std::string(type) + " " + UsdString(name);
  if (schemas.empty() && metadata.empty()) {
    Line(head);
  } else {
    Line(head + " (");
    std::vector<std::string> quoted;
    for (const std::string& schema : schemas) quoted.push_back(UsdString(schema));
    if (!schemas.empty()) Line("    prepend apiSchemas = " + List(quoted));
    for (const std::string& line : metadata) Line("    " + line);
    Line(")");
  }
  Line("{");
  ++open_;
}

void UsdWriter::Line(std::string_view text) {
  text_ += std::string(kIndent * open_, ' ') + std::string(text) + "\n";
}

void UsdWriter::Close() {
  AG_CHECK(open_ > 0, "an open prim");
  --open_;
  Line("}");
}

void UsdWriter::Triangles(const TriangleMesh& mesh) {
  std::vector<std::string> points, counts(mesh.faces.size(), "3"), indices;
  for (const Eigen::Vector3d& v : mesh.vertices) points.push_back(UsdTuple(v));
  for (const auto& face : mesh.faces) {
    for (const std::int32_t corner : face) indices.push_back(std::to_string(corner));
  }
  const BoundingBox box = Bounds(mesh);
  Line("float3[] extent = " + List({UsdTuple(box.min), UsdTuple(box.max)}));
  Line("int[] faceVertexCounts = " + List(counts));
  Line("int[] faceVertexIndices = " + List(indices));
  Line("uniform token orientation = \"rightHanded\"");
  Line("point3f[] points = " + List(points));
  Line("uniform token subdivisionScheme = \"none\"");  // else it is a cage to be rounded
}

std::string UsdWriter::Take() {
  AG_CHECK(open_ == 0, "every prim closed");
  return std::move(text_);
}

}  // namespace antigrasp
