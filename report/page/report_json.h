#pragma once

#include <nlohmann/json.hpp>

#include "antigrasp/report/page/report.h"

namespace antigrasp {

// The parts of the page's JSON that need no binary blob. A number that is not finite becomes null.

nlohmann::ordered_json VectorJson(const Eigen::Vector3d& v);
nlohmann::ordered_json PairsJson(const std::vector<LabelledText>& pairs);
nlohmann::ordered_json ScoreJson(const ScoreSummary& score);
nlohmann::ordered_json PrintJson(const ReportPrint& print);
nlohmann::ordered_json TrialsJson(const ReportTrials& trials);  // replays without their frames

// Everything of the report but its objects.
nlohmann::ordered_json HeadJson(const Report& report);

}  // namespace antigrasp
