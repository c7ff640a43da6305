#include "bench/peer_evaluation.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

#include "antigrasp/quality/robust_quality.h"
#include "tests/quality/qhull_oracle.h"

namespace antigrasp::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>;

Kernel::Point_3 ToPoint(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::optional<std::array<Contact, 2>> CloseJaws(const CgalRays& rays, const Eigen::Vector3d& center,
                                                const Eigen::Vector3d& axis, double opening,
                                                double friction) {
  std::array<Contact, 2> contacts;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3d closing = i == 0 ? axis : Eigen::Vector3d(-axis);
    const auto hit = rays.Closest(center - 0.5 * opening * closing, closing, 0.5 * opening);
    if (!hit || hit->normal.dot(closing) >= 0.0 || Slips(-hit->normal, closing, friction)) {
      return std::nullopt;
    }
    contacts[i] = {hit->point, hit->normal, std::max(-closing.dot(hit->normal), 0.0)};
  }
  return contacts;
}

}  // namespace

struct CgalRays::Impl {
  Surface surface;
  std::vector<Kernel::Vector_3> normals;
  CGAL::AABB_tree<Traits> tree;
};

CgalRays::CgalRays(const TriangleMesh& mesh) : impl_(std::make_unique<Impl>()) {
  for (const Eigen::Vector3d& v : mesh.vertices) impl_->surface.add_vertex(ToPoint(v));
  for (const auto& face : mesh.faces) {
    impl_->surface.add_face(Surface::Vertex_index(static_cast<std::uint32_t>(face[0])),
                            Surface::Vertex_index(static_cast<std::uint32_t>(face[1])),
                            Surface::Vertex_index(static_cast<std::uint32_t>(face[2])));
  }
  for (const auto face : faces(impl_->surface)) {
    impl_->normals.push_back(
        CGAL::Polygon_mesh_processing::compute_face_normal(face, impl_->surface));
  }
  impl_->tree.insert(faces(impl_->surface).begin(), faces(impl_->surface).end(), impl_->surface);
  impl_->tree.build();
}

CgalRays::~CgalRays() = default;

std::optional<CgalRays::Hit> CgalRays::Closest(const Eigen::Vector3d& origin,
                                               const Eigen::Vector3d& direction,
                                               double max_distance) const {
  const Kernel::Ray_3 ray(ToPoint(origin),
                          Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
  const auto found = impl_->tree.first_intersection(ray);
  if (!found) return std::nullopt;
  const auto* point = boost::get<Kernel::Point_3>(&found->first);
  if (point == nullptr) return std::nullopt;
  const Kernel::Vector_3& n = impl_->normals[found->second];
  const Hit hit{{point->x(), point->y(), point->z()}, {n.x(), n.y(), n.z()}};
  if ((hit.point - origin).norm() > max_distance) return std::nullopt;
  return hit;
}

double EpsilonByQhull(const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com,
                      const WrenchModel& model) {
  const double depth = HullDepthByQhull(GraspMatrix(contacts, com, model));
  return depth > 1e-10 ? depth : 0.0;
}

std::vector<double> PeerQualities(const TriangleMesh& mesh, const std::vector<ScoredGrasp>& grasps,
                                  const MetricOptions& options) {
  const CgalRays rays(mesh);
  const Eigen::Vector3d com = CenterOfMass(mesh);
  std::vector<double> qualities;
  for (std::size_t g = 0; g < grasps.size(); ++g) {
    RngStream rng(1, "noise", 0, g);
    double sum = 0.0;
    for (int draw = 0; draw < options.num_draws; ++draw) {
      const NoiseDraw noise = DrawNoise(options, &rng);
      const auto [center, axis] = ExecutedPose(grasps[g].grasp, com, noise);
      const auto contacts = CloseJaws(rays, center, axis, options.jaw_opening, noise.friction);
      if (!contacts) continue;
      sum += EpsilonByQhull(*contacts, com, WrenchModelOf(options, noise.friction));
    }
    qualities.push_back(sum / options.num_draws);
  }
  return qualities;
}

}  // namespace antigrasp::bench
