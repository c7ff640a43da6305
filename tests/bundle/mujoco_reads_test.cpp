// Bundles in MuJoCo, a reader that is not ours.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/stable_poses.h"
#include "tests/bundle/dented_solids.h"
#include "tests/support/random_draws.h"

#ifdef ANTIGRASP_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace antigrasp {
namespace {

#ifdef ANTIGRASP_HAS_MUJOCO

using Eigen::Vector3d;

struct Simulation {
  explicit Simulation(const std::filesystem::path& path) {
    char error[1000] = "";
    model = mj_loadXML(path.c_str(), nullptr, error, sizeof error);
    if (model == nullptr) throw std::runtime_error(error);
    data = mj_makeData(model);
  }
  ~Simulation() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  void Run(double seconds) {
    while (data->time < seconds) mj_step(model, data);
  }
  double Height(const char* body) const {
    return data->xpos[3 * mj_name2id(model, mjOBJ_BODY, body) + 2];
  }

  mjModel* model = nullptr;
  mjData* data = nullptr;
};

// The bundle of a solid and a plane under it.
class MujocoBundle {
 public:
  explicit MujocoBundle(const TriangleMesh& solid, const std::string& name = "solid") {
    BundleOptions options;
    options.friction = 0.35;
    bundle = MakeObjectBundle(name, solid, options);
    WriteMesh(folder_ / (name + ".stl"), bundle.mesh);
    for (std::size_t i = 0; i < bundle.parts.size(); ++i) {
      WriteMesh(folder_ / (bundle.PartName(i) + ".stl"), bundle.parts[i].mesh);
    }
    model = folder_.Write("solid.xml", MjcfText(bundle));
    scene = folder_.Write("scene.xml",
                          "<mujoco><include file=\"solid.xml\"/><worldbody><geom name=\"floor\" "
                          "type=\"plane\" size=\"1 1 1\"/></worldbody></mujoco>");
  }

  ObjectBundle bundle;
  std::filesystem::path model, scene;

 private:
  shapes::TempFolder folder_;
};

// Above the plane, `up` of its own frame pointing up.
void Place(const ObjectBundle& bundle, const Eigen::Quaterniond& turn, mjData* data) {
  double low = std::numeric_limits<double>::max();
  for (const Vector3d& v : bundle.mesh.vertices) low = std::min(low, (turn * v).z());
  const double pose[] = {0, 0, 0.005 - low, turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy(pose, pose + 7, data->qpos);
}

TEST(MujocoReads, MassCentreAndInertiaAsTheyAreWritten) {
  const MujocoBundle written(shapes::LShape());
  const Simulation simulation(written.model);
  ASSERT_EQ(simulation.model->nbody, 2);
  EXPECT_EQ(simulation.model->ngeom, 3);  // seen, and two parts
  EXPECT_NEAR(simulation.model->body_mass[1], 0.024, 0.024e-6);
  EXPECT_TRUE(Vector3d(simulation.model->body_ipos + 3).isApprox(written.bundle.center, 1e-6));
  const mjtNum* q = simulation.model->body_iquat + 4;
  const Eigen::Matrix3d axes = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Vector3d moments(simulation.model->body_inertia + 3);
  EXPECT_TRUE(
      (axes * moments.asDiagonal() * axes.transpose()).isApprox(written.bundle.inertia, 1e-6));
}

TEST(MujocoReads, ANameWithEveryCharacterThatXmlEscapes) {
  const MujocoBundle written(shapes::LShape(), "a<b> & \"c\" 'd'");
  EXPECT_GE(mj_name2id(Simulation(written.model).model, mjOBJ_BODY, "a<b> & \"c\" 'd'"), 0);
}

TEST(MujocoReads, AnObjectThatIsCalledAsItsWorldIs) {
  const MujocoBundle written(shapes::LShape(), "world");
  EXPECT_EQ(Simulation(written.model).model->nbody, 2);
}

TEST(MujocoReads, TheFrictionOfThePairWhateverTheFloorHas) {
  const MujocoBundle written(shapes::LShape());
  Simulation simulation(written.scene);
  Place(written.bundle, Eigen::Quaterniond::Identity(), simulation.data);
  simulation.Run(0.5);
  ASSERT_GT(simulation.data->ncon, 0);
  EXPECT_EQ(simulation.data->contact[0].friction[0], 0.35);
}

// A ball of 8 mm let into the slot of the U, 20 mm wide, comes to rest on its bottom.
TEST(MujocoReads, ASlotThatABallFallsInto) {
  const MujocoBundle written(shapes::UShape());
  std::string still = MjcfText(written.bundle);
  still.erase(still.find("<freejoint/>"), 12);
  std::ofstream(written.model) << still;
  std::ofstream(written.scene)
      << "<mujoco><include file=\"solid.xml\"/><option gravity=\"0 -9.81 0\"/><worldbody><body "
         "name=\"ball\" "
         "pos=\"0.04 0.05 0.03\"><freejoint/><geom type=\"sphere\" size=\"0.004\" "
         "mass=\"0.001\"/></body></worldbody></mujoco>";
  Simulation simulation(written.scene);
  simulation.Run(1.0);
  const int ball = mj_name2id(simulation.model, mjOBJ_BODY, "ball");
  EXPECT_NEAR(simulation.data->xpos[3 * ball + 1], -0.02 + 0.02 + 0.004, 0.0005);
}

// The self-check that every bundle carries.
TEST(MujocoReads, OneBoxThatFallsAndOneThatStays) {
  shapes::TempFolder folder;
  Simulation simulation(folder.Write("self_check.xml", MjcfSelfCheck()));
  simulation.Run(2.0);
  EXPECT_LT(simulation.Height("falls"), 0.2);
  EXPECT_NEAR(simulation.Height("stays"), 0.3, 0.001);
}

constexpr int kDrops = 100;
constexpr double kSame = 0.02;  // rad, between upward axes

// The way up in the object's axes after it was let go above the plane.
Vector3d UpAtRest(const MujocoBundle& written, const Eigen::Quaterniond& turn,
                  Simulation* simulation) {
  mj_resetData(simulation->model, simulation->data);
  Place(written.bundle, turn, simulation->data);
  simulation->Run(2.0);
  const mjtNum* q = simulation->data->xquat + 4;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * Vector3d::UnitZ();
}

// Let down near its likeliest stable pose it stays in it.
TEST(MujocoReads, AnObjectThatRestsInItsLikeliestPose) {
  const MujocoBundle written(shapes::LShape());
  const StablePose pose = StablePoses(written.bundle.mesh, written.bundle.center).front();
  Simulation simulation(written.scene);
  RngStream rng(1, "drops", 0, 0);
  int right = 0;
  for (int drop = 0; drop < kDrops; ++drop) {
    const Eigen::AngleAxisd tilt(0.1, DrawDirection(&rng));
    const Vector3d up =
        UpAtRest(written, Eigen::Quaterniond(tilt * pose.table_from_object), &simulation);
    right += up.dot(pose.table_from_object.row(2)) > std::cos(kSame) ? 1 : 0;
  }
  EXPECT_GE(right, 95);
}

// Dropped any way round it comes to rest in a pose that is known.
TEST(MujocoReads, AnObjectThatRestsInAStablePoseHoweverItIsDropped) {
  const MujocoBundle written(shapes::LShape());
  const std::vector<StablePose> poses = StablePoses(written.bundle.mesh, written.bundle.center);
  Simulation simulation(written.scene);
  RngStream rng(1, "drops", 1, 0);
  int known = 0;
  for (int drop = 0; drop < kDrops; ++drop) {
    const Eigen::Quaterniond turn =
        Eigen::AngleAxisd(2.0 * std::numbers::pi * rng.Uniform(), Vector3d::UnitZ()) *
        Eigen::Quaterniond::FromTwoVectors(DrawDirection(&rng), Vector3d::UnitZ());
    const Vector3d up = UpAtRest(written, turn, &simulation);
    known += std::any_of(poses.begin(), poses.end(), [&](const StablePose& pose) {
      return up.dot(pose.table_from_object.row(2)) > std::cos(kSame);
    });
  }
  EXPECT_GE(known, 95);
}

#else

TEST(MujocoReads, Bundles) { GTEST_SKIP() << "libmujoco-dev is not installed"; }

#endif

}  // namespace
}  // namespace antigrasp
