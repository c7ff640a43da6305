#include "antigrasp/quality/contact_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/error.h"
#include "tests/quality/option_lines.h"
#include "tests/quality/reference_cases.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

const std::string kHeader = "p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comy,comz";
// The two face centres of a 4 cm cube.
const std::string kCube = "-0.02,0,0,-1,0,0,0.02,0,0,1,0,0,0,0,0";

std::vector<ContactRow> Read(const std::string& bytes, const ContactTableOptions& options = {}) {
  const TempFolder folder;
  return ReadContactTable(folder.Write("grasps.csv", bytes), options);
}

ContactRow ReadOne(const std::string& more_names = "", const std::string& more_fields = "",
                   const ContactTableOptions& options = {}) {
  return Read(kHeader + more_names + "\n" + kCube + more_fields + "\n", options).at(0);
}

void ExpectRefused(const std::string& bytes, const std::string& part) {
  try {
    Read(bytes);
    ADD_FAILURE() << "read: " << bytes;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

void ExpectRowRefused(const std::string& names, const std::string& fields,
                      const std::string& part) {
  ExpectRefused(kHeader + names + "\n" + kCube + fields + "\n", part);
}

// The cube's row with one field changed.
std::string CubeWith(std::size_t column, const std::string& text) {
  std::string row;
  std::size_t at = 0;
  for (std::size_t i = 0; i < 15; ++i) {
    const std::size_t end = std::min(kCube.find(',', at), kCube.size());
    row += (i > 0 ? "," : "") + (i == column ? text : kCube.substr(at, end - at));
    at = end + 1;
  }
  return row;
}

TEST(ContactTable, TheReferenceTableGivesTheReferencesAnswers) {
  const std::vector<ReferenceCase> cases = ReadReferenceCases();
  const std::vector<ContactRow> rows =
      ReadContactTable(ANTIGRASP_TEST_DATA "/quality/contacts.csv", {});
  ASSERT_EQ(rows.size(), cases.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ReferenceCase& c = cases[i];
    const ContactRowQuality quality = EvaluateContacts(rows[i], {});
    const double norm = std::isfinite(c.matrix_norm) ? c.matrix_norm : 0.0;
    EXPECT_EQ(rows[i].id, c.id);
    EXPECT_NEAR(quality.epsilon, c.epsilon, 1e-9 * std::max(1.0, norm) + 1e-7 * c.epsilon) << c.id;
    EXPECT_EQ(quality.force_closure, c.force_closure) << c.id;
    EXPECT_EQ(quality.force_closure_signed, c.force_closure_signed) << c.id;
    ASSERT_TRUE(quality.resistance.has_value());
    EXPECT_EQ(quality.resistance->resisted, c.resistance > 0.0) << c.id;
    if (!c.below_limit) continue;  // exact there, with the row's own frames
    EXPECT_NEAR(quality.resistance->coefficient_norm, c.coefficient_norm,
                1e-12 * c.coefficient_norm)
        << c.id;
  }
}

TEST(ContactTable, ABareTableTakesItsConstantsFromTheOptions) {
  const ContactRow row = ReadOne();
  EXPECT_EQ(row.id, "1");
  EXPECT_EQ(row.contacts[1].point, Eigen::Vector3d(0.02, 0.0, 0.0));
  EXPECT_EQ(row.contacts[0].normal_force, 1.0);
  EXPECT_EQ(row.force_limit, 20.0);
  EXPECT_FALSE(row.target.has_value());
  const ContactRowQuality quality = EvaluateContacts(row, {});
  EXPECT_NEAR(quality.epsilon, 0.0391, 5e-5);
  EXPECT_TRUE(quality.force_closure && quality.force_closure_signed);
  EXPECT_FALSE(quality.resistance.has_value());

  ContactTableOptions options;
  options.friction = 0.25;
  options.cone_edges = 6;
  options.finger_radius = 0.01;
  options.torque_scale = 10.0;
  options.torsion = Torsion::kUniformPressure;
  options.wrench.force_limit = 3.0;
  const ContactRow other = ReadOne("", "", options);
  EXPECT_EQ(other.model.friction, 0.25);
  EXPECT_EQ(other.model.cone_edges, 6);
  EXPECT_EQ(other.model.finger_radius, 0.01);
  EXPECT_EQ(other.model.torque_scale, 10.0);
  EXPECT_EQ(other.model.torsion, Torsion::kUniformPressure);
  EXPECT_EQ(other.force_limit, 3.0);
  const ContactRow own = ReadOne(
      ",friction_coef,num_cone_faces,finger_radius,torque_scaling,"
      "force_limit",
      ",0.5,8,0.005,1000,20", options);
  EXPECT_EQ(own.model.friction, 0.5);
  EXPECT_EQ(own.model.cone_edges, 8);
  EXPECT_EQ(own.model.finger_radius, 0.005);
  EXPECT_EQ(own.model.torque_scale, 1000.0);
  EXPECT_EQ(own.force_limit, 20.0);
}

TEST(ContactTableOptions, EveryKeyIsBoundToItsFieldAndEveryDefaultIsItsNumber) {
  const auto head = [](const ContactTableOptions& options) {
    auto lines = LinesOf(options);
    lines.resize(6);  // those of the wrench have a test of their own
    return lines;
  };
  EXPECT_EQ(head({}), (std::vector<std::string>{
                          "contact.friction = 0.5", "contact.cone_edges = 8",
                          "contact.finger_radius = 0.005", "contact.torque_scale = 1000.0",
                          "contact.torsion = 'dexnet'", "wrench.force_limit = 20.0"}));
  ContactTableOptions options{0.25, 6, 0.01, 10.0, Torsion::kNone, {}};
  options.wrench.force_limit = 3.0;
  EXPECT_EQ(head(options),
            (std::vector<std::string>{"contact.friction = 0.25", "contact.cone_edges = 6",
                                      "contact.finger_radius = 0.01", "contact.torque_scale = 10.0",
                                      "contact.torsion = 'none'", "wrench.force_limit = 3.0"}));
}

TEST(ContactTable, EveryNamedColumnFillsItsOwnField) {
  // 1 to 36 in the order of the names, no two alike; normals and directions along one axis each.
  const ContactRow row =
      Read(
          "id,p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comy,comz,friction_coef,"
          "num_cone_faces,finger_radius,torque_scaling,force_limit,in1x,in1y,in1z,in2x,in2y,in2z,"
          "t1c1_x,t1c1_y,t1c1_z,t1c2_x,t1c2_y,t1c2_z,wfx,wfy,wfz,wtx,wty,wtz\n"
          "seven,1,2,3,0,-4,0,5,6,7,0,0,8,9,10,11,0.875,12,13,14,15,0,1,0,3,0,-4,1,0,0,0,1,0,"
          "16,17,18,19,20,21\n")
          .at(0);
  EXPECT_EQ(row.id, "seven");
  EXPECT_EQ(row.contacts[0].point, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(row.contacts[0].normal, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(row.contacts[1].point, Eigen::Vector3d(5, 6, 7));
  EXPECT_EQ(row.contacts[1].normal, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(row.com, Eigen::Vector3d(9, 10, 11));
  EXPECT_EQ(row.model.friction, 0.875);
  EXPECT_EQ(row.model.cone_edges, 12);
  EXPECT_EQ(row.model.finger_radius, 13.0);
  EXPECT_EQ(row.model.torque_scale, 14.0);
  EXPECT_EQ(row.force_limit, 15.0);
  EXPECT_EQ(row.contacts[0].normal_force, 1.0);
  // (3, 0, -4) / 5 against the inward normal -z: 4/5 along it, 3/5 across, less than 7/8 of that.
  EXPECT_NEAR(row.contacts[1].normal_force, 0.8, 1e-15);
  EXPECT_EQ(row.frames[0][0], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(row.frames[0][1], Eigen::Vector3d(0, 0, -1));  // y cross x
  EXPECT_EQ(row.frames[1][0], Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(row.frames[1][1], Eigen::Vector3d(1, 0, 0));  // -z cross y
  EXPECT_EQ(*row.target, (Wrench() << 16, 17, 18, 19, 20, 21).finished());
}

TEST(ContactTable, TheRowsForceLimitCountsAndTheOptionsSayTheRest) {
  // The cube's grasp lifts 2 mu F = F: a limit of 2 does not hold 3, one of 4 does.
  const auto resisted = [](const char* limit, double of_options) {
    WrenchResistanceOptions options;
    options.force_limit = of_options;
    return EvaluateContacts(ReadOne(",wfx,wfy,wfz,force_limit", std::string(",0,0,3,") + limit),
                            options)
        .resistance->resisted;
  };
  EXPECT_FALSE(resisted("2", 4.0));
  EXPECT_TRUE(resisted("4", 2.0));
  // Along the line and against it differ where one contact is weaker: 0.8 of the other.
  const ContactRow row =
      ReadOne(",wfx,wfy,wfz,force_limit,in1x,in1y,in1z,in2x,in2y,in2z", ",4.5,0,0,5,3,0,4,-1,0,0");
  EXPECT_EQ(row.contacts[0].normal_force, 0.0) << "slips: 4/3 of the normal part";
  const ContactRow weak = ReadOne(",wfx,wfy,wfz,force_limit,in1x,in1y,in1z,in2x,in2y,in2z",
                                  ",4.5,0,0,5,12,0,5,-1,0,0");  // 12/13 along, 5/12 across
  WrenchResistanceOptions oppose;
  EXPECT_TRUE(EvaluateContacts(weak, oppose).resistance->resisted) << "5 x 12/13 = 4.6 along +x";
  oppose.oppose_target = true;
  EXPECT_TRUE(EvaluateContacts(weak, oppose).resistance->resisted) << "5 along -x";
  const ContactRow more =
      ReadOne(",wfx,wfy,wfz,force_limit,in1x,in1y,in1z,in2x,in2y,in2z", ",4.8,0,0,5,12,0,5,-1,0,0");
  EXPECT_FALSE(EvaluateContacts(more, {}).resistance->resisted);
  EXPECT_TRUE(EvaluateContacts(more, oppose).resistance->resisted);
}

TEST(ContactTable, ColumnsMayStandInAnyOrderAmongOthersWithMarksAndQuotes) {
  const std::string table =
      "\xEF\xBB\xBFnote,comz,comy,comx,n2z,n2y,n2x,p2z,p2y,p2x,n1z,n1y,n1x,p1z,p1y,p1x,id\r\n"
      "\"a, b\",0,0,0,0,0,1,0,0,0.02,0,0,-1,0,0,-0.02,\"first, \"\"best\"\"\"\r\n";
  const ContactRow row = Read(table).at(0);
  EXPECT_EQ(row.id, "first, \"best\"");
  EXPECT_NEAR(EvaluateContacts(row, {}).epsilon, EvaluateContacts(ReadOne(), {}).epsilon, 0.0);
}

TEST(ContactTable, NormalsAndClosingDirectionsMayHaveAnyLength) {
  const std::string closing = ",in1x,in1y,in1z,in2x,in2y,in2z";
  const ContactRow row = ReadOne(closing, ",3,0.3,0,-1e200,0,0");
  EXPECT_NEAR(row.contacts[0].normal_force, 1.0 / std::sqrt(1.01), 1e-15);
  EXPECT_EQ(row.contacts[1].normal_force, 1.0);
  const ContactRow slips = ReadOne(closing, ",1,0.6,0,-1,0,0");
  EXPECT_EQ(slips.contacts[0].normal_force, 0.0);
  EXPECT_EQ(EvaluateContacts(slips, {}).epsilon, 0.0);
  EXPECT_TRUE(EvaluateContacts(slips, {}).force_closure) << "which knows no jaws";
  const ContactRow away = ReadOne(closing, ",-1,0,0,-1,0,0");
  EXPECT_EQ(away.contacts[0].normal_force, 0.0);
  EXPECT_EQ(ReadOne(closing, ",nan,nan,nan,,,").contacts[0].normal_force, 1.0);
  EXPECT_EQ(ReadOne(closing + ",has_in_direction", ",1,9,0,-1,0,0,0").contacts[0].normal_force,
            1.0);
  const auto longer = Read(kHeader + "\n" + CubeWith(3, "-1e-200") + "\n");
  EXPECT_EQ(longer.at(0).contacts[0].normal, Eigen::Vector3d(-1.0, 0.0, 0.0));
}

TEST(ContactTable, AGivenFrameIsUsedAndAMissingOneIsOurs) {
  const std::string names = ",t1c1_x,t1c1_y,t1c1_z,t1c2_x,t1c2_y,t1c2_z";
  const ContactRow row = ReadOne(names, ",0,0.6,0.8,nan,nan,nan");
  EXPECT_EQ(row.frames[0][0], Eigen::Vector3d(0.0, 0.6, 0.8));
  EXPECT_LT((row.frames[0][1] - Eigen::Vector3d(0.0, -0.8, 0.6)).norm(), 1e-15);
  EXPECT_EQ(row.frames[1][0], TangentFrame(Eigen::Vector3d(-1.0, 0.0, 0.0))[0]);
  ExpectRowRefused(names, ",0,0.6,0.9,nan,nan,nan", "t1c1_x = 0");
  ExpectRowRefused(names, ",0.1,0.6,0.8,nan,nan,nan", "a unit vector across the normal");
  ExpectRowRefused(names, ",0,0.6,nan,nan,nan,nan", "t1c1_z = nan");
}

TEST(ContactTable, TorqueOfTheTargetIsZeroUnlessThereAreColumns) {
  const ContactRow force = ReadOne(",wfx,wfy,wfz", ",0,0,-2");
  ASSERT_TRUE(force.target.has_value());
  EXPECT_EQ(*force.target, (Wrench() << 0, 0, -2, 0, 0, 0).finished());
  const ContactRow torque = ReadOne(",wtx,wty,wtz", ",1,2,3");
  EXPECT_EQ(*torque.target, (Wrench() << 0, 0, 0, 1, 2, 3).finished());
  ExpectRowRefused(",wfx,wfy,wfz", ",0,0,nan", "wfz = nan");
}

TEST(ContactTable, NamesMissingColumns) {
  ExpectRefused("id,x\na,1\n", "no column p1x p1y");
  ExpectRefused("p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comz\n", "no column comy");
  ExpectRefused(kHeader + ",in1x,in1y\n", "in1x, in1y, in1z");
  ExpectRefused(kHeader + ",in1x,in1y,in1z\n", "in2");
  ExpectRefused(kHeader + ",has_in_direction\n", "in1x ... in2z");
  ExpectRefused(kHeader + ",wfx\n", "wfx, wfy, wfz");
  ExpectRefused(kHeader + ",comx\n", "column comx twice");
  ExpectRefused("", "empty table");
}

TEST(ContactTable, NamesTheLineAndColumnOfABadField) {
  const std::string good = kHeader + "\n" + kCube + "\n";
  for (const char* bad : {"nan", "inf", "", "abc", "0.1.2", "1e999"}) {
    ExpectRefused(good + CubeWith(1, bad) + "\n", std::string("p1y = ") + bad + " (");
    ExpectRefused(good + CubeWith(14, bad) + "\n", "grasps.csv:3): expected a finite number");
  }
  ExpectRefused(good + CubeWith(3, "0") + "\n", "n1x = 0");
  ExpectRefused(good + CubeWith(3, "0") + "\n", "grasps.csv:3): expected a direction that is not");
  ExpectRefused(good + "\n" + kCube.substr(2) + ",\n", "grasps.csv:4)");
  ExpectRefused(good + "0,0\n", "a row of 2 fields");
  ExpectRefused(good + "\x01\x02\n", "not a table");
  ExpectRowRefused(",friction_coef", ",-0.1", "friction_coef = -0.1");
  ExpectRowRefused(",num_cone_faces", ",8.5", "a whole number");
  ExpectRowRefused(",num_cone_faces", ",2", "[3, 64]");
  ExpectRowRefused(",finger_radius", ",-1", "finger_radius = -1");
  ExpectRowRefused(",torque_scaling", ",0", "torque_scaling = 0");
  ExpectRowRefused(",force_limit", ",0", "force_limit = 0");
  ExpectRowRefused(",in1x,in1y,in1z,in2x,in2y,in2z", ",0,0,0,1,0,0", "in1x = 0");
  const std::string closing = ",has_in_direction,in1x,in1y,in1z,in2x,in2y,in2z";
  ExpectRowRefused(closing, ",2,1,0,0,-1,0,0", "0 or 1");
  ExpectRowRefused(closing, ",1,1,0,0,nan,nan,nan", "in2x = nan");
}

TEST(ContactTable, WithoutRowsThereIsNothingToScore) { EXPECT_TRUE(Read(kHeader + "\n").empty()); }

TEST(ContactTable, HugeNumbersGiveNoGraspAndNoFailure) {
  for (const std::size_t column : {0u, 3u, 7u, 12u}) {
    for (const char* huge : {"1e150", "-1e308", "1e-308"}) {
      const auto rows = Read(kHeader + ",wfx,wfy,wfz\n" + CubeWith(column, huge) + ",0,0,-1\n");
      const ContactRowQuality quality = EvaluateContacts(rows.at(0), {});
      EXPECT_FALSE(std::isnan(quality.epsilon)) << column << " " << huge;
      EXPECT_FALSE(std::isnan(quality.resistance->quality)) << column << " " << huge;
    }
  }
}

}  // namespace
}  // namespace antigrasp
