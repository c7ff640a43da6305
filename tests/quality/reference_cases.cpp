#include "tests/quality/reference_cases.h"

#include <Eigen/Geometry>

#include "antigrasp/core/csv_reader.h"

namespace antigrasp {
namespace {

class Row {
 public:
  explicit Row(const CsvReader& csv) : csv_(csv) {}
  const std::string& Text(const std::string& name) const {
    return csv_.Field(csv_.Column(name).value());
  }
  double Number(const std::string& name) const {
    return csv_.Number(csv_.Column(name).value()).value();
  }
  Eigen::Vector3d Vector(const std::string& prefix) const {
    return {Number(prefix + "x"), Number(prefix + "y"), Number(prefix + "z")};
  }

 private:
  const CsvReader& csv_;
};

ReferenceCase Parse(const Row& row) {
  ReferenceCase c;
  c.id = row.Text("id");
  c.family = row.Text("family");
  c.com = row.Vector("com");
  c.model = {row.Number("friction_coef"), static_cast<int>(row.Number("num_cone_faces")),
             row.Number("finger_radius"), row.Number("torque_scaling")};
  c.has_jaw_direction = row.Text("has_in_direction") == "1";
  c.cone_status = row.Text("cone_status");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i + 1);
    c.contacts[i] = {row.Vector("p" + k), row.Vector("n" + k), row.Number("normal_force" + k)};
    if (c.cone_status.find(k) != std::string::npos) c.contacts[i].normal_force = 0.0;
    const Eigen::Vector3d t1 = row.Vector("t1c" + k + "_");
    c.frames[i] = {t1, Eigen::Vector3d(-c.contacts[i].normal).cross(t1)};
    c.jaw_direction[i] = row.Vector("in" + k);
  }
  c.matrix_norm = row.Number("G_frobenius");
  c.epsilon = row.Number("eps_exact");
  c.epsilon_own_frame = row.Number("eps_exact_analytic_frame");
  c.force_closure = row.Text("force_closure") == "1";
  c.force_closure_signed = row.Text("force_closure_signed") == "1";
  c.target << row.Vector("wf"), row.Vector("wt");
  c.force_limit = row.Number("force_limit");
  c.dexnet_resistance = row.Number("wr_dexnet");
  c.resistance = row.Number("wr_ref");
  c.coefficient_norm = row.Number("wr_ref_norm");
  c.residual2 = row.Number("wr_ref_resid2");
  c.below_limit = row.Text("wr_ref_method") == "nnls";
  return c;
}

}  // namespace

std::vector<ReferenceCase> ReadReferenceCases() {
  CsvReader csv(ANTIGRASP_TEST_DATA "/quality/contacts.csv");
  std::vector<ReferenceCase> cases;
  while (csv.Next()) cases.push_back(Parse(Row(csv)));
  return cases;
}

}  // namespace antigrasp
