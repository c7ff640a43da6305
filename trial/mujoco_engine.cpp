#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "antigrasp/trial/mujoco_model.h"
#include "antigrasp/trial/physics_engine.h"

namespace antigrasp {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// MuJoCo keeps a contact at rest where its distance is `margin`: what is reported to it is the
// distance plus this, so that surfaces rest where they meet.
constexpr double kMargin = 0.0002;
constexpr double kNearlySlips = 0.95;  // of what a contact can bear
// How much of 1 MuJoCo's impedance lacks at a touch and at 0.1 mm of depth, and the mass below
// which less: a contact gives way in proportion to (force / mass), and the force is the jaws'.
constexpr double kGives = 0.01, kGivesDeep = 0.001, kLeastGives = 1e-4, kLight = 0.020;
constexpr int kTable = 0, kBody = 1, kFirstTip = 2;  // geoms, in the order of the text below
constexpr int kTipDofs = 6, kTipPositions = 7;       // behind those of the free body

// What the contact function below may look at: MuJoCo gives it no pointer of ours.
struct Scene {
  const ContactSolid* solid = nullptr;
  Fingertip tip;
  Vector3d up = Vector3d::UnitZ();
  double table = kNoTable;
  std::array<TouchCache, 2> near;  // of each tip
};
thread_local Scene* scene_of_thread = nullptr;

Vector3d At(const mjtNum* p) { return {p[0], p[1], p[2]}; }
Matrix3d MatrixAt(const mjtNum* m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m);
}

// In the body's frame: one fingertip.
int TouchTip(Scene* scene, int tip, const Isometry3d& to_body, const Vector3d& center,
             SurfaceContact* found) {
  TouchCache* const near = &scene->near[static_cast<std::size_t>(tip)];
  if (scene->tip.shape == TipShape::kSphere) {
    return scene->solid->Touch(SpherePose{to_body * center, scene->tip.radius}, kMargin, found, 4,
                               near);
  }
  return scene->solid->Touch(PadAt(scene->tip, to_body, center, tip == 0 ? 1.0 : -1.0), kMargin,
                             found, kMostContacts, near, /*exact_load=*/true);
}

// The collision function of all pairs: table and body, tip and body. The body's geom is a box that
// stands for its solid; the pose comes from the body.
int Collide(const mjModel* model, mujoco::CollisionData data, mujoco::CollisionContact* contacts,
            int geom1, int geom2, mjtNum /*margin*/) {
  if (scene_of_thread == nullptr) return 0;
  Scene& scene = *scene_of_thread;
  const int body = model->geom_bodyid[kBody];
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = MatrixAt(data->xmat + 9 * body);
  pose.translation() = At(data->xpos + 3 * body);
  std::array<SurfaceContact, kMostContacts> found;
  const int other = geom1 == kBody ? geom2 : geom1;
  int count = 0;
  if (other == kTable) {
    if (scene.table == kNoTable) return 0;
    const Vector3d up = pose.linear().transpose() * scene.up;
    count = scene.solid->TouchPlane(up, scene.table - scene.up.dot(pose.translation()), kMargin,
                                    found.data());
  } else {
    count = TouchTip(&scene, other - kFirstTip, pose.inverse(), At(data->geom_xpos + 3 * other),
                     found.data());
  }
  // From geom1 to geom2: ours point out of the table and out of the solid towards a tip.
  const double sign = (other == kTable) == (geom2 == kBody) ? 1.0 : -1.0;
  for (int i = 0; i < count; ++i) {
    const SurfaceContact& at = found[static_cast<std::size_t>(i)];
    const Vector3d position = pose * at.position, normal = sign * (pose.linear() * at.normal);
    contacts[i].dist = at.distance + kMargin;
    mju_copy3(contacts[i].pos, position.data());
    mujoco::SetNormal(normal.data(), &contacts[i]);
  }
  return count;
}

// Once for the process: the pairs of geoms that stand here have no other use in it.
void UseOurContacts() {
  static const bool done = [] {
    mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_BOX] = &Collide;
    mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_BOX] = &Collide;
    mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] = &Collide;
    return true;
  }();
  static_cast<void>(done);
}

// docs/trials.md says why each number is what it is. The body is at its centre of mass with its
// principal axes, so that MuJoCo knows its mass matrix as diagonal; numbers that change with
// the object or the execution are set in the model.
std::string Mjcf(const PhysicsOptions& options) {
  const bool sphere = options.tip.shape == TipShape::kSphere;
  const double stiff = 3.5 * options.time_step;
  char text[4000];
  std::snprintf(text, sizeof text, R"(<mujoco>
 <size nconmax="40" njmax="200"/>
 <option timestep="%.17g" gravity="0 0 0" cone="elliptic" impratio="100" solver="Newton" tolerance="1e-8"/>
 <worldbody>
  <geom type="plane" size="1 1 1" contype="0" conaffinity="0"/>
  <body><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
   <geom type="box" size="1 1 1" contype="0" conaffinity="0"/></body>
  <body><joint type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="%.17g" diaginertia="1 1 1"/>
   <geom type="%s" size="1 1 1" contype="0" conaffinity="0"/></body>
  <body><joint type="slide" axis="-1 0 0"/><inertial pos="0 0 0" mass="%.17g" diaginertia="1 1 1"/>
   <geom type="%s" size="1 1 1" contype="0" conaffinity="0"/></body>
 </worldbody>
)",
                options.time_step, options.finger_mass, sphere ? "sphere" : "box",
                options.finger_mass, sphere ? "sphere" : "box");
  std::string mjcf = text;
  for (const char* name : {"table", "body", "tip1", "tip2"}) {
    const auto geom = mjcf.find("<geom type");
    mjcf.replace(geom, 10, std::string("<geom name=\"") + name + "\" type");
  }
  for (const char* name : {"joint1", "joint2"}) {
    const auto joint = mjcf.find("<joint type");
    mjcf.replace(joint, 11, std::string("<joint name=\"") + name + "\" type");
  }
  std::snprintf(text, sizeof text,
                " <equality><joint joint1=\"joint1\" joint2=\"joint2\" polycoef=\"0 1 0 0 0\" "
                "solref=\"%.17g 1\"/></equality>\n <contact>\n",
                stiff);
  mjcf += text;
  for (const char* other : {"table", "tip1", "tip2"}) {
    std::snprintf(text, sizeof text,
                  "  <pair geom1=\"%s\" geom2=\"body\" condim=\"%d\" margin=\"%.17g\" "
                  "solref=\"%.17g 1\" solimp=\"0.99 0.999 0.0001\"/>\n",
                  other, other[1] == 'a' || !sphere ? 3 : 4, kMargin, stiff);
    mjcf += text;
  }
  return mjcf + " </contact>\n</mujoco>\n";
}

// MuJoCo's reader of models is not for several threads, and it takes a step to see that one works.
mujoco::Model CompileAlone(const PhysicsOptions& options) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  scene_of_thread = nullptr;
  return mujoco::Compile(Mjcf(options));
}

class Mujoco final : public PhysicsEngine {
 public:
  explicit Mujoco(const PhysicsOptions& options)
      : options_(options), model_(CompileAlone(options)), data_(mj_makeData(model_.get())) {
    UseOurContacts();
    scene_.tip = options.tip;
    const Vector3d half = options.tip.Half();
    for (int tip = kFirstTip; tip < kFirstTip + 2; ++tip) {
      Eigen::Map<Vector3d>(model_->geom_size + 3 * tip) = half;
      model_->geom_rbound[tip] = half.norm();
    }
  }

  void Load(const GrippedBody& body, double mass) override {
    scene_.solid = &body.solid;
    scene_.near = {};
    const int id = model_->geom_bodyid[kBody];
    mass_ = mass;
    model_->body_mass[id] = mass;
    Eigen::Map<Vector3d>(model_->body_inertia + 3 * id) = mass / body.volume * body.inertia;
    model_->geom_rbound[kBody] = body.radius;
    Eigen::Map<Vector3d>(model_->geom_size + 3 * kBody).setConstant(body.radius);
    const double share = std::min(1.0, mass / kLight);
    for (int pair = 0; pair < model_->npair; ++pair) {
      mjtNum* const impedance = model_->pair_solimp + mjNIMP * pair;
      impedance[0] = 1.0 - std::max(share * kGives, kLeastGives);
      impedance[1] = 1.0 - std::max(share * kGivesDeep, kLeastGives);
    }
    mj_setConst(model_.get(), data_.get());
  }

  void Begin(const GripStart& start) override {
    scene_of_thread = &scene_;
    opening_ = start.opening;
    scene_.up = start.up;
    SetTable(start.table);
    SetBrake(false);
    SetFriction(start.friction);
    mj_resetData(model_.get(), data_.get());
    const Eigen::Quaterniond turn(start.body.linear());
    mjtNum* const q = data_->qpos;
    Eigen::Map<Vector3d>(q + 0) = start.body.translation();
    q[3] = turn.w(), q[4] = turn.x(), q[5] = turn.y(), q[6] = turn.z();
    const double out = 0.5 * opening_ + options_.tip.Half().x();
    for (int tip = 0; tip < 2; ++tip) {
      const int body = model_->geom_bodyid[kFirstTip + tip];
      model_->body_pos[3 * body] = tip == 0 ? -out : out;
      q[kTipPositions + tip] = start.travel;
      data_->qvel[kTipDofs + tip] = start.speed;
    }
  }

  void SetAcceleration(const Vector3d& acceleration) override {
    const int body = model_->geom_bodyid[kBody];
    for (int k = 0; k < 3; ++k) data_->xfrc_applied[6 * body + k] = mass_ * acceleration[k];
  }

  void SetTable(double table) override {
    scene_.table = table;
    // Where it is for MuJoCo's own look at what may be near; far below when there is none.
    const Vector3d place = (table == kNoTable ? -1e3 : table) * scene_.up;
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), scene_.up);
    Eigen::Map<Vector3d>(model_->geom_pos + 3 * kTable) = place;
    mjtNum* const q = model_->geom_quat + 4 * kTable;
    q[0] = turn.w(), q[1] = turn.x(), q[2] = turn.y(), q[3] = turn.z();
  }

  void SetBrake(bool on) override {
    for (int dof = 0; dof < kTipDofs; ++dof) {
      model_->dof_damping[dof] = on ? (dof < 3 ? kBrake : kTurnBrake) : 0.0;
    }
  }

  GripState Step() override {
    scene_of_thread = &scene_;
    // Not a joint's damping: MuJoCo's step takes that in by itself, after the contacts were solved
    // without it, which leaves them four times too soft.
    for (int dof = kTipDofs; dof < kTipDofs + 2; ++dof) {
      data_->qfrc_applied[dof] = options_.DriveForce(data_->qvel[dof]);
    }
    mj_step(model_.get(), data_.get());
    return State();
  }

  void Save() override {
    saved_.assign(data_->qpos, data_->qpos + model_->nq);
    saved_.insert(saved_.end(), data_->qvel, data_->qvel + model_->nv);
    saved_.insert(saved_.end(), data_->qacc_warmstart, data_->qacc_warmstart + model_->nv);
  }

  void Restore() override {
    const mjtNum* from = saved_.data();
    mju_copy(data_->qpos, from, model_->nq);
    mju_copy(data_->qvel, from + model_->nq, model_->nv);
    mju_copy(data_->qacc_warmstart, from + model_->nq + model_->nv, model_->nv);
  }

  std::vector<ContactForce> Contacts() const override {
    std::vector<ContactForce> all;
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      if (contact.efc_address < 0) continue;
      const mjtNum* const f = data_->efc_force + contact.efc_address;
      if (!(f[0] > 0.0)) continue;
      const Vector3d force = MatrixAt(contact.frame).transpose() * Vector3d(f[0], f[1], f[2]);
      all.push_back({At(contact.pos), contact.geom2 == kBody ? force : Vector3d(-force)});
    }
    return all;
  }

 private:
  void SetFriction(double friction) {
    for (int pair = 0; pair < model_->npair; ++pair) {
      mjtNum* const mu = model_->pair_friction + 5 * pair;
      const bool of_table =
          model_->pair_geom1[pair] == kTable || model_->pair_geom2[pair] == kTable;
      // MuJoCo divides by it.
      mu[0] = mu[1] = std::max(of_table ? options_.table_friction : friction, 1e-5);
      mu[2] = std::max(mu[0] * options_.tip.Torsion(), 1e-9);  // a length: torque over normal force
    }
  }

  GripState State() const {
    GripState state;
    const mjtNum *q = data_->qpos, *v = data_->qvel;
    state.body.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).toRotationMatrix();
    state.body.translation() = At(q);
    state.velocity = At(v);
    state.turning = state.body.linear() * At(v + 3);  // MuJoCo's is in the body's frame
    state.travel = 0.5 * (q[kTipPositions] + q[kTipPositions + 1]);
    state.travel_speed = 0.5 * (v[kTipDofs] + v[kTipDofs + 1]);
    state.broken = mujoco::WentWrong(*data_);
    state.sticks = true;
    for (int i = 0; i < data_->ncon; ++i) AddContact(data_->contact[i], &state);
    state.sticks = state.sticks && state.press[0] > 0.0 && state.press[1] > 0.0;
    return state;
  }

  void AddContact(const mjContact& contact, GripState* state) const {
    const int other = contact.geom1 == kBody ? contact.geom2 : contact.geom1;
    if (other != kTable) {
      state->penetration = std::max(state->penetration, kMargin - contact.dist);
    }
    if (contact.efc_address < 0) return;
    const mjtNum* const f = data_->efc_force + contact.efc_address;
    if (!(f[0] > 0.0)) return;
    if (other == kTable) {
      state->on_table = true;
      return;
    }
    ++state->contacts;
    state->press[static_cast<std::size_t>(other - kFirstTip)] += f[0];
    double borne = 0.0;  // share of what friction can bear
    for (int k = 1; k < contact.dim; ++k) {
      const double share = f[k] / (contact.friction[k - 1] * f[0]);
      borne += share * share;
    }
    if (borne > kNearlySlips * kNearlySlips) state->sticks = false;
  }

  PhysicsOptions options_;
  mujoco::Model model_;
  mujoco::Data data_;
  Scene scene_;
  double opening_ = 0.0, mass_ = 0.0;
  std::vector<mjtNum> saved_;
};

}  // namespace

std::unique_ptr<PhysicsEngine> MakeMujocoEngine(const PhysicsOptions& options) {
  return std::make_unique<Mujoco>(options);
}

std::string MujocoVersion() { return mj_versionString(); }

}  // namespace antigrasp
