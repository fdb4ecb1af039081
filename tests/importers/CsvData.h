#pragma once

#include <slamot/importers/CsvFolder.h>

#include "../results/TemporaryFolder.h"

namespace slamot::test
{
inline const std::string kOdometryHeader = "t,v,omega,std_v,std_omega\n";
inline const std::string kSightingsHeader = "t,range,bearing,std_range,std_bearing,id\n";
inline const std::string kBlobsHeader = "t,label,range,bearing,std_range,std_bearing,id\n";

inline std::vector<core::Step> stepsOf(importers::Import& import)
{
  std::vector<core::Step> out;
  while (auto step = import.next()) out.push_back(std::move(*step));
  return out;
}

/// All steps of a folder; what the import holds besides is given up.
inline std::vector<core::Step> importCsv(const TemporaryFolder& folder)
{
  return stepsOf(*importers::openCsvFolder(folder.file("")));
}
}  // namespace slamot::test
