#include "antigrasp/report/page/payload.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "antigrasp/report/page/display_mesh.h"
#include "antigrasp/report/page/packed_grasps.h"
#include "tests/report/page/inflated.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

ReportObject ObjectOf(const std::string& name, const TriangleMesh& mesh) {
  ReportObject object;
  object.name = name;
  object.status = "ok";
  object.shape.mesh = mesh;
  return object;
}

Report ReportOf(std::vector<ReportObject> objects) {
  Report report;
  report.title = "title";
  report.kind = "objects";
  report.groups = {{"input-0", "meshes", "all"}};
  report.objects = std::move(objects);
  return report;
}

Json Parsed(const Report& report) { return Json::parse(EncodeReport(report, {}).json); }

// The part [offset, length, size] of the blob, inflated; its bounds and its size are checked.
std::string Part(const std::string& blob, const Json& place) {
  const std::size_t offset = place[0], length = place[1];
  EXPECT_LE(offset + length, blob.size());
  return Inflated(blob.substr(offset, length), place[2]);
}

TEST(Payload, NamesNeverCloseTheScriptAndReadBackAsTheyAre) {
  const std::vector<std::string> names = {"</script><script>alert(1)",
                                          "\"quoted\\\" & 'single'",
                                          "<!--<script>",
                                          "Grüße, 物体 \xF0\x9F\x98\x80",
                                          std::string("nul\0, line\nbreak", 15),
                                          "\u2028"};
  std::vector<ReportObject> objects;
  for (const std::string& name : names) objects.push_back(ObjectOf(name, shapes::Cube()));
  objects.push_back(ObjectOf("cut \xC3", shapes::Cube()));
  objects.push_back(ObjectOf("\xFF\xFE", shapes::Cube()));
  const std::string json = EncodeReport(ReportOf(objects), {}).json;
  for (const char c : json) {
    EXPECT_TRUE(c >= ' ' && c <= '~' && c != '<' && c != '>' && c != '&') << int(c);
  }
  const Json parsed = Json::parse(json);
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(parsed["objects"][i]["name"], names[i]);
  EXPECT_EQ(parsed["objects"][6]["name"], "cut \uFFFD");
  EXPECT_EQ(parsed["objects"][7]["name"], "\uFFFD\uFFFD");
}

TEST(Payload, NumbersThatDoNotExistAreNull) {
  ReportObject object = ObjectOf("a", shapes::Cube());
  object.shape.score = ScoreSummary{0.5, std::nan(""), INFINITY, 0.25, 1.0, 7};
  object.shape.mesh.vertices[0].x() = std::nan("");
  Report report = ReportOf({object});
  ReportStage stage;
  stage.id = "prior";
  stage.coverage = std::nan("");
  stage.graspability = {std::nan(""), std::nan(""), 0};
  stage.scores = {0.1, std::nan("")};
  report.run = ReportRun{{stage}, {{0, false, {{"step", {10, 20}}, {"loss", {NAN, 1.0}}}}}};
  const Json json = Parsed(report);
  const Json& written = json["objects"][0];
  EXPECT_EQ(written["score"]["graspability"], 0.5);
  EXPECT_TRUE(written["score"]["ci_low"].is_null());
  EXPECT_TRUE(written["score"]["ci_high"].is_null());
  EXPECT_EQ(written["score"]["num_grasps"], 7);
  EXPECT_TRUE(written["mesh"].is_null());
  EXPECT_TRUE(written["com"].is_null());
  EXPECT_TRUE(written["grasps"].is_null());
  EXPECT_TRUE(written["print"].is_null());
  EXPECT_FALSE(written.contains("elite"));
  EXPECT_FALSE(written.contains("pair"));
  EXPECT_TRUE(json["metric"].is_null());
  EXPECT_TRUE(json["config"].is_null());
  const Json& run = json["run"];
  EXPECT_TRUE(run["stages"][0]["coverage"].is_null());
  EXPECT_TRUE(run["stages"][0]["graspability"]["mean"].is_null());
  EXPECT_EQ(run["stages"][0]["scores"], Json::parse("[0.1, null]"));
  EXPECT_EQ(run["losses"][0]["columns"]["loss"], Json::parse("[null, 1.0]"));
}

TEST(Payload, MeshesAreTheStreamsOfTheDisplayMesh) {
  const TriangleMesh mesh = shapes::Box({1.0, 2.0, 4.0});
  const ReportPayload payload = EncodeReport(ReportOf({ObjectOf("box", mesh)}), {});
  const Json json = Json::parse(payload.json)["objects"][0];
  const auto display = MakeDisplayMesh(mesh, 6000);
  EXPECT_EQ(json["mesh"]["vertices"], 8);
  EXPECT_EQ(json["mesh"]["triangles"], 12);
  EXPECT_EQ(json["mesh"]["extent"], 4.0);
  EXPECT_EQ(json["mesh"]["min"], Json::parse("[-0.5, -1.0, -2.0]"));
  EXPECT_FALSE(json["mesh"].contains("full_triangles"));
  EXPECT_EQ(Part(payload.blob, json["mesh"]["positions"]), EncodePositions(*display));
  EXPECT_EQ(Part(payload.blob, json["mesh"]["indices"]), EncodeIndices(*display));
  EXPECT_NEAR(json["com"][0], 0.0, 1e-12);

  PayloadOptions few;
  few.max_triangles = 100;
  const Json ball =
      Json::parse(EncodeReport(ReportOf({ObjectOf("ball", shapes::Sphere(1.0, 3))}), few).json);
  EXPECT_EQ(ball["objects"][0]["mesh"]["full_triangles"], 1280);
  EXPECT_LE(ball["objects"][0]["mesh"]["triangles"], 100);
}

TEST(Payload, GraspsArePackedInTheUnitsOfTheMesh) {
  ReportObject object = ObjectOf("cube", shapes::Cube());
  object.shape.metres_per_unit = 0.04;
  object.shape.grasps.resize(2);
  object.shape.grasps[1].quality = 0.003;
  object.shape.grasps[1].grasp.width = 0.04;
  const ReportPayload payload = EncodeReport(ReportOf({object}), {});
  const Json json = Json::parse(payload.json)["objects"][0];
  EXPECT_EQ(json["metres_per_unit"], 0.04);
  EXPECT_EQ(Part(payload.blob, json["grasps"]), PackGrasps(object.shape.grasps, 0.04));
}

TEST(Payload, PartsStandInTheBlobOneAfterTheOtherAndReplaysAmongThem) {
  ReportObject object = ObjectOf("cube", shapes::Cube());
  object.trials.emplace().replays = {{R"({"grasp":1})", "[1,2]"}, {R"({"grasp":2})", "[3]"}};
  const ReportPayload payload = EncodeReport(ReportOf({object}), {});
  const Json json = Json::parse(payload.json)["objects"][0];
  std::size_t end = 0;
  for (const Json& place :
       {json["mesh"]["positions"], json["mesh"]["indices"], json["trials"]["replays"][0]["frames"],
        json["trials"]["replays"][1]["frames"]}) {
    EXPECT_EQ(place[0], end);
    end += place[1].get<std::size_t>();
  }
  EXPECT_EQ(end, payload.blob.size());
  EXPECT_EQ(Part(payload.blob, json["trials"]["replays"][0]["frames"]), "[1,2]");
  EXPECT_EQ(Part(payload.blob, json["trials"]["replays"][1]["frames"]), "[3]");
}

TEST(Payload, DisplacementIsTheDistanceToTheOriginalInTheOrderOfTheVertices) {
  ReportObject object = ObjectOf("cube", shapes::Cube());
  for (Vector3d& vertex : object.shape.mesh.vertices) {
    if (vertex.z() > 0.0) vertex.z() += vertex.x() > 0.0 ? 0.2 : 0.1;
  }
  object.original.emplace().label = "before";
  object.original->shape.mesh = shapes::Cube();
  const ReportPayload payload = EncodeReport(ReportOf({object}), {});
  const Json pair = Json::parse(payload.json)["objects"][0]["pair"];
  EXPECT_EQ(pair["label"], "before");
  EXPECT_EQ(pair["mesh"]["vertices"], 8);
  EXPECT_NEAR(pair["max_displacement"], 0.2, 1e-12);
  const std::string shares = Part(payload.blob, pair["displacement"]);
  const auto display = MakeDisplayMesh(object.shape.mesh, 6000);
  ASSERT_EQ(shares.size(), display->vertices.size());
  for (std::size_t v = 0; v < shares.size(); ++v) {
    const double rise = std::max(display->vertices[v].z() - 0.5, 0.0);
    EXPECT_NEAR(static_cast<unsigned char>(shares[v]), 255.0 * rise / 0.2, 0.51) << v;
  }
}

TEST(Payload, OfAPairWithoutOneOfTheMeshesHasNoDisplacement) {
  for (const bool changed : {false, true}) {
    ReportObject object = ObjectOf("cube", changed ? shapes::Cube() : TriangleMesh());
    object.original.emplace().label = "before";
    if (!changed) object.original->shape.mesh = shapes::Cube();
    const Json pair = Parsed(ReportOf({object}))["objects"][0]["pair"];
    EXPECT_FALSE(pair.contains("displacement"));
    EXPECT_EQ(pair["mesh"].is_null(), changed);
  }
}

TEST(Payload, PrintCheckAndHeadAreWrittenAsTheyAre) {
  ReportObject object = ObjectOf("cube", shapes::Cube());
  object.elite = true;
  object.numbers = {{"faces", "12"}};
  ReportPrint print;
  print.size_mm = {60, 40, 38};
  print.wall_mm = std::nan("");
  print.watertight = true;
  print.overhang = 0.25;
  print.pose = Eigen::Matrix3d::Identity();
  (*print.pose)(0, 1) = 2.0;
  print.pose_probability = 0.5;
  print.notes = {"thin"};
  object.print = print;
  Report report = ReportOf({object});
  report.missing = {"no prior set"};
  report.provenance = {{"commit", "abc"}};
  report.config = "[cem]\n";
  report.metric.emplace().friction = 0.75;
  const Json json = Parsed(report);
  EXPECT_EQ(json["format"], "antigrasp.report");
  EXPECT_EQ(json["version"], 2);
  EXPECT_EQ(json["missing"][0], "no prior set");
  EXPECT_EQ(json["provenance"], Json::parse(R"([["commit", "abc"]])"));
  EXPECT_EQ(json["config"], "[cem]\n");
  EXPECT_EQ(json["metric"]["friction"], 0.75);
  EXPECT_EQ(json["gripper"]["jaw_opening"], 0.05);
  EXPECT_EQ(json["groups"], Json::parse(R"([{"id":"input-0","label":"meshes","note":"all"}])"));
  const Json& written = json["objects"][0];
  EXPECT_EQ(written["elite"], true);
  EXPECT_EQ(written["numbers"], Json::parse(R"([["faces", "12"]])"));
  EXPECT_TRUE(written["print"]["wall_mm"].is_null());
  EXPECT_EQ(written["print"]["pose"], Json::parse("[[1, 2, 0], [0, 1, 0], [0, 0, 1]]"));
  EXPECT_EQ(written["print"]["notes"], Json::parse(R"(["thin"])"));
}

TEST(Payload, HasTheSameBytesForAnyNumberOfThreads) {
  std::vector<ReportObject> objects;
  for (int i = 0; i < 12; ++i) {
    objects.push_back(ObjectOf(std::to_string(i), shapes::Sphere(1.0 + i, 1 + i % 3)));
    if (i % 4 == 0) objects.back().original = ReportOriginal{"before", objects[0].shape};
  }
  const Report report = ReportOf(objects);
  PayloadOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const ReportPayload a = EncodeReport(report, one), b = EncodeReport(report, three);
  EXPECT_EQ(a.json, b.json);
  EXPECT_EQ(a.blob, b.blob);
}

}  // namespace
}  // namespace antigrasp
