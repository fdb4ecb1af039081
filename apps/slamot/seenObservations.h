#pragma once

#include <mrpt/obs/CObservation.h>
#include <slamot/perception/Pipeline.h>

#include <memory>
#include <vector>

namespace slamot::apps
{
/// What an image showed, as a rawlog holds it (CObservationColorBlobs), with the image's time; its
/// label is the image's and `_BLOBS`.
[[nodiscard]] std::shared_ptr<::mrpt::obs::CObservation> blobsObservation(
    const perception::Look& look, const ::mrpt::obs::CObservation& image,
    const perception::Pipeline& pipeline);

/// Landmarks of a scan (CObservationBearingRange, without identities), with the scan's time and
/// place; its label is the scan's and `_LANDMARKS`.
[[nodiscard]] std::shared_ptr<::mrpt::obs::CObservation> landmarksObservation(
    const std::vector<perception::DetectedLandmark>& landmarks, const core::LaserScan& scan,
    const ::mrpt::obs::CObservation& source, const perception::Pipeline& pipeline);
}  // namespace slamot::apps
