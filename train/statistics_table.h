#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/train/statistics.h"

namespace antigrasp {

// statistics.csv (docs/formats.md): a header and a row a stage, a number in every field ("nan":
// none). Tables of versions that had no flat_share and crease_share are read with NaN there.
std::string StatisticsToCsv(const std::vector<StageStatistics>& rows);

// Back, of a file and of a text, as a checkpoint holds it. InputError naming the file or `origin`.
std::vector<StageStatistics> ReadStatistics(const std::filesystem::path& path);
std::vector<StageStatistics> StatisticsFromCsv(const std::string& csv, const std::string& origin);

}  // namespace antigrasp
