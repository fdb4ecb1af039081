#pragma once

#include <slamot/eval/Truth.h>
#include <slamot/results/Tum.h>

#include <string>

namespace slamot::results
{
/// The folder of a log's truth: X.truth for X.rawlog (or X).
[[nodiscard]] std::string truthFolder(const std::string& rawlogPath);

/// Reads robot.tum, target_<id>.tum, landmarks.csv (`id,x,y`), associations.csv (`t,index,id`;
/// id -1: clutter) and relations.csv (`t1,t2,dx,dy,dtheta`); what is absent stays empty, all of it
/// if there is no such folder. \throws core::Error (kUnreadable, kTruncated, kNonsense, kLimit) on
/// a malformed file, with its line.
[[nodiscard]] eval::Truth loadTruth(const std::string& folder);

/// Writes what the truth holds.  The folder is made; truth files in it from before are replaced or
/// removed, others left alone.  \throws core::Error as saveTum().
void saveTruth(const std::string& folder, const eval::Truth& truth);
}  // namespace slamot::results
