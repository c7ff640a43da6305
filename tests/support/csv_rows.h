#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "antigrasp/core/csv_reader.h"

namespace antigrasp::shapes {

// The rows of a table by the names in its header.
inline std::vector<std::map<std::string, std::string>> CsvRows(const std::filesystem::path& path) {
  std::vector<std::map<std::string, std::string>> rows;
  CsvReader csv(path);
  while (csv.Next()) {
    rows.emplace_back();
    for (std::size_t i = 0; i < csv.names().size(); ++i) rows.back()[csv.names()[i]] = csv.Field(i);
  }
  return rows;
}

}  // namespace antigrasp::shapes
