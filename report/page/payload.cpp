#include "antigrasp/report/page/payload.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "antigrasp/report/page/deflated_part.h"
#include "antigrasp/report/page/display_mesh.h"
#include "antigrasp/report/page/packed_grasps.h"
#include "antigrasp/report/page/report_json.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// One mesh with its grasps as bytes.
struct EncodedShape {
  std::optional<DisplayMesh> mesh;
  DeflatedPart positions, indices, grasps;
};

struct EncodedObject {
  EncodedShape shape, original;
  DeflatedPart displacement;
  double max_displacement = 0.0;
  std::vector<DeflatedPart> frames;  // of the replays
};

class Blob {
 public:
  // [offset, length, size] of the part.
  Json Append(const DeflatedPart& part) {
    const Json place = {bytes_.size(), part.stream.size(), part.size};
    bytes_ += part.stream;
    return place;
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

EncodedShape Encode(const ReportShape& shape, std::size_t max_triangles) {
  EncodedShape encoded;
  encoded.mesh = MakeDisplayMesh(shape.mesh, max_triangles);
  if (encoded.mesh) {
    encoded.positions = Deflated(EncodePositions(*encoded.mesh));
    encoded.indices = Deflated(EncodeIndices(*encoded.mesh));
  }
  encoded.grasps = Deflated(PackGrasps(shape.grasps, shape.metres_per_unit));
  return encoded;
}

EncodedObject Encode(const ReportObject& object, std::size_t max_triangles) {
  EncodedObject encoded;
  encoded.shape = Encode(object.shape, max_triangles);
  if (object.trials) {
    for (const ReportReplay& replay : object.trials->replays) {
      encoded.frames.push_back(Deflated(replay.frames));
    }
  }
  if (!object.original) return encoded;
  encoded.original = Encode(object.original->shape, max_triangles);
  if (!encoded.shape.mesh || !encoded.original.mesh) return encoded;
  const MeshDistance surface(object.original->shape.mesh);
  std::vector<double> distances;
  for (const Vector3d& vertex : encoded.shape.mesh->vertices) {
    distances.push_back(surface.Unsigned(vertex));
  }
  const double largest = *std::max_element(distances.begin(), distances.end());
  std::string shares;
  for (const double distance : distances) {
    const double share = largest > 0.0 ? distance / largest : 0.0;
    shares += static_cast<char>(std::lround(255.0 * share));
  }
  encoded.displacement = Deflated(shares);
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
  (*json)["grasps"] = encoded.grasps.size == 0 ? Json() : blob->Append(encoded.grasps);
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
    if (encoded.displacement.size > 0) {
      pair["displacement"] = blob->Append(encoded.displacement);
      pair["max_displacement"] = encoded.max_displacement;
    }
  }
  json["numbers"] = PairsJson(object.numbers);
  json["print"] = object.print ? PrintJson(*object.print) : Json();
  if (object.trials) {
    Json& trials = json["trials"] = TrialsJson(*object.trials);
    for (std::size_t i = 0; i < encoded.frames.size(); ++i) {
      trials["replays"][i]["frames"] = blob->Append(encoded.frames[i]);
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
