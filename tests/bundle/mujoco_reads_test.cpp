// Bundles in MuJoCo, a reader that is not ours.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <limits>
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

// Let down near its likeliest stable pose it stays in it.
TEST(MujocoReads, AnObjectThatRestsInItsLikeliestPose) {
  const MujocoBundle written(shapes::LShape());
  const StablePose pose = StablePoses(written.bundle.mesh, written.bundle.center).front();
  RngStream rng(1, "drops", 0, 0);
  int right = 0;
  for (int drop = 0; drop < 20; ++drop) {
    Simulation simulation(written.scene);
    const Eigen::AngleAxisd tilt(0.1, DrawDirection(&rng));
    Place(written.bundle, Eigen::Quaterniond(tilt * pose.table_from_object), simulation.data);
    simulation.Run(2.0);
    const mjtNum* q = simulation.data->xquat + 4;
    const Vector3d up = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * Vector3d::UnitZ();
    right += up.dot(pose.table_from_object.row(2)) > std::cos(0.02) ? 1 : 0;
  }
  EXPECT_GE(right, 19);
}

#else

TEST(MujocoReads, Bundles) { GTEST_SKIP() << "libmujoco-dev is not installed"; }

#endif

}  // namespace
}  // namespace antigrasp
