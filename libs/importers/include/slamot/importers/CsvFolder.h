#pragma once

#include <slamot/importers/Import.h>

#include <memory>
#include <string>

namespace slamot::importers
{
/// Opens a folder of CSV files: odometry.csv and, each optional, landmark_sightings.csv, blobs.csv,
/// scans.csv, fov.csv, start.csv and truth_*.csv; all as the manual's page on CSV folders says.
///
/// Times stay as they are, the first step starts at `startTime` [s].  Each row of odometry ends a
/// step; what sensors report within 1e-6 s of that time belongs to it.  What they report between
/// two rows cuts the step there (see HeldMotion); at the start it makes a step without odometry.
/// What they report after the last row is left out and counted: nothing tells how the robot moved
/// until then.
std::unique_ptr<Import> openCsvFolder(const std::string& folder, double startTime = 0);
}  // namespace slamot::importers
