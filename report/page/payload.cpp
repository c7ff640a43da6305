#include "antigrasp/report/page/payload.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "antigrasp/report/page/display_mesh.h"
#include "antigrasp/report/page/report_json.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// One mesh with its grasps as bytes.
struct EncodedShape {
  std::optional<DisplayMesh> mesh;
  std::string positions, indices, grasps;
};

struct EncodedObject {
  EncodedShape shape, original;
  std::string displacement;
  double max_displacement = 0.0;
};

class Blob {
 public:
  // [offset, length] of the part.
  Json Append(const std::string& part) {
    constexpr std::size_t kAlignment = 4;
    bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
    const Json place = {bytes_.size(), part.size()};
    bytes_ += part;
    return place;
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// 17 float32 a grasp, best first: contact points, outward normals, approach, quality, width.
std::string EncodeGrasps(std::vector<ScoredGrasp> grasps, double metres_per_unit) {
  static_assert(std::endian::native == std::endian::little);
  std::stable_sort(grasps.begin(), grasps.end(), [](const ScoredGrasp& a, const ScoredGrasp& b) {
    return a.quality > b.quality;
  });
  std::vector<float> values;
  const auto add = [&](const Vector3d& v) {
    for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(v[k]));
  };
  for (const auto& [grasp, quality, draws, candidate] : grasps) {
    for (const Contact& contact : grasp.contacts) add(contact.point / metres_per_unit);
    for (const Contact& contact : grasp.contacts) add(contact.normal);
    add(grasp.approach);
    values.push_back(static_cast<float>(quality));
    values.push_back(static_cast<float>(grasp.width / metres_per_unit));
  }
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

EncodedShape Encode(const ReportShape& shape, std::size_t max_triangles) {
  EncodedShape encoded;
  encoded.mesh = MakeDisplayMesh(shape.mesh, max_triangles);
  if (encoded.mesh) {
    encoded.positions = EncodePositions(*encoded.mesh);
    encoded.indices = EncodeIndices(*encoded.mesh);
  }
  encoded.grasps = EncodeGrasps(shape.grasps, shape.metres_per_unit);
  return encoded;
}

EncodedObject Encode(const ReportObject& object, std::size_t max_triangles) {
  EncodedObject encoded;
  encoded.shape = Encode(object.shape, max_triangles);
  if (!object.original) return encoded;
  encoded.original = Encode(object.original->shape, max_triangles);
  if (!encoded.shape.mesh || !encoded.original.mesh) return encoded;
  const MeshDistance surface(object.original->shape.mesh);
  std::vector<double> distances;
  for (const Vector3d& vertex : encoded.shape.mesh->vertices) {
    distances.push_back(surface.Unsigned(vertex));
  }
  const double largest = *std::max_element(distances.begin(), distances.end());
  for (const double distance : distances) {
    const double share = largest > 0.0 ? distance / largest : 0.0;
    encoded.displacement += static_cast<char>(std::lround(255.0 * share));
  }
  encoded.max_displacement = largest;
  return encoded;
}

Json MeshJson(const EncodedShape& shape, Blob* blob) {
  if (!shape.mesh) return nullptr;
  const DisplayMesh& mesh = *shape.mesh;
  Json json = {{"vertices", mesh.vertices.size()}, {"triangles", mesh.indices.size() / 3}};
  json["positions"] = blob->Append(shape.positions);
  json["indices"] = blob->Append(shape.indices);
  json["min"] = VectorJson(mesh.min);
  json["extent"] = mesh.extent;
  if (mesh.full_triangles > mesh.indices.size() / 3) json["full_triangles"] = mesh.full_triangles;
  return json;
}

void AddShape(const ReportShape& shape, const EncodedShape& encoded, Blob* blob, Json* json) {
  (*json)["score"] = shape.score ? ScoreJson(*shape.score) : Json();
  (*json)["mesh"] = MeshJson(encoded, blob);
  (*json)["metres_per_unit"] = shape.metres_per_unit;
  (*json)["com"] = encoded.mesh ? VectorJson(CenterOfMass(shape.mesh)) : Json();
  (*json)["grasps"] = encoded.grasps.empty() ? Json() : blob->Append(encoded.grasps);
}

Json ObjectJson(const ReportObject& object, const EncodedObject& encoded, Blob* blob) {
  Json json = {{"name", object.name}, {"group", object.group}};
  if (object.elite) json["elite"] = *object.elite;
  if (!object.random) json["random"] = false;
  json["status"] = object.status;
  AddShape(object.shape, encoded.shape, blob, &json);
  if (object.original) {
    Json& pair = json["pair"] = {{"label", object.original->label}};
    AddShape(object.original->shape, encoded.original, blob, &pair);
    if (!encoded.displacement.empty()) {
      pair["displacement"] = blob->Append(encoded.displacement);
      pair["max_displacement"] = encoded.max_displacement;
    }
  }
  json["numbers"] = PairsJson(object.numbers);
  json["print"] = object.print ? PrintJson(*object.print) : Json();
  if (object.trials) {
    Json& trials = json["trials"] = TrialsJson(*object.trials);
    for (std::size_t i = 0; i < object.trials->replays.size(); ++i) {
      trials["replays"][i]["frames"] = blob->Append(object.trials->replays[i].frames);
    }
  }
  return json;
}

// No name of an object can end the script element that holds the text.
std::string InScript(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else if (c == '>') {
      text += "\\u003e";
    } else if (c == '&') {
      text += "\\u0026";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

ReportPayload EncodeReport(const Report& report, const PayloadOptions& options,
                           const ProgressFn& progress) {
  std::vector<EncodedObject> encoded(report.objects.size());
  ParallelFor(
      std::ssize(report.objects), options.threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        encoded[slot] = Encode(report.objects[slot], options.max_triangles);
      },
      progress);
  Blob blob;
  Json json = HeadJson(report);
  Json& objects = json["objects"] = Json::array();
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    objects.push_back(ObjectJson(report.objects[i], encoded[i], &blob));
  }
  return {InScript(json.dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace)),
          blob.Take()};
}

}  // namespace antigrasp
