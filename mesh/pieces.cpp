#include "antigrasp/mesh/pieces.h"

#include <utility>

namespace antigrasp {

Pieces PiecesOf(ParitySets* sets, std::size_t faces) {
  Pieces pieces;
  pieces.of_face.resize(faces);
  std::vector<std::int32_t> number(faces, -1);
  for (std::size_t f = 0; f < faces; ++f) {
    std::int32_t& piece = number[sets->Find(static_cast<std::int32_t>(f)).root];
    if (piece < 0) piece = pieces.count++;
    pieces.of_face[f] = piece;
  }
  return pieces;
}

std::vector<TriangleMesh> Apart(const TriangleMesh& mesh, const Pieces& pieces) {
  std::vector<std::vector<std::size_t>> faces(pieces.count);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) faces[pieces.of_face[f]].push_back(f);
  std::vector<TriangleMesh> parts(pieces.count);
  std::vector<std::int32_t> place(mesh.vertices.size(), -1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const std::size_t f : faces[p]) {
      std::array<std::int32_t, 3> corners = mesh.faces[f];
      for (std::int32_t& v : corners) {
        if (place[v] < 0) {
          place[v] = static_cast<std::int32_t>(parts[p].vertices.size());
          parts[p].vertices.push_back(mesh.vertices[v]);
        }
        v = place[v];
      }
      parts[p].faces.push_back(corners);
    }
    // Another piece may touch this one in a vertex.
    for (const std::size_t f : faces[p]) {
      for (const std::int32_t v : mesh.faces[f]) place[v] = -1;
    }
  }
  return parts;
}

std::vector<double> SixVolumes(const TriangleMesh& mesh, const Pieces& pieces) {
  const Eigen::Vector3d origin = Bounds(mesh).Center();
  std::vector<double> six_volume(pieces.count, 0.0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    six_volume[pieces.of_face[f]] +=
        (mesh.vertices[mesh.faces[f][0]] - origin).dot(FaceCross(mesh, f));
  }
  return six_volume;
}

void Append(const TriangleMesh& part, TriangleMesh* mesh) {
  const auto offset = static_cast<std::int32_t>(mesh->vertices.size());
  mesh->vertices.insert(mesh->vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.faces) {
    mesh->faces.push_back({a + offset, b + offset, c + offset});
  }
}

void TurnOver(TriangleMesh* mesh) {
  for (auto& face : mesh->faces) std::swap(face[1], face[2]);
}

}  // namespace antigrasp
