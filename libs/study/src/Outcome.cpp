#include <slamot/study/Outcome.h>

#include <slamot/core/Error.h>
#include <slamot/study/Metrics.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace slamot::study
{
namespace
{
namespace fs = std::filesystem;

bool holdsRecords(const fs::path& folder)
{
  return fs::is_directory(folder / "runs");
}
}  // namespace

std::vector<std::optional<double>> Outcome::values(const Plan& plan, std::size_t group,
                                                   std::size_t metric) const
{
  std::vector<std::optional<double>> out;
  for (int s = 0; s < plan.spec.seeds; ++s)
  {
    const auto& record = records[plan.runAt(group, s)];
    const bool good = record && record->error.empty();
    out.push_back(good ? record->metrics[metric] : std::nullopt);
  }
  return out;
}

Outcome collect(const Plan& plan, const std::vector<std::string>& folders)
{
  Outcome out;
  for (const Run& run : plan.runs)
  {
    std::optional<RunRecord> best;
    for (const std::string& folder : folders)
    {
      RunRecord record;
      const RecordState state = loadRecord(folder, plan, run, record);
      if (state == RecordState::kStale || state == RecordState::kDamaged) ++out.stale;
      if (state != RecordState::kGood) continue;
      // A run that failed in one place may have been done in another.
      if (!best || (!best->error.empty() && record.error.empty())) best = record;
    }
    if (!best) ++out.missing;
    if (best && !best->error.empty()) ++out.failed;
    out.records.push_back(std::move(best));
  }
  return out;
}

std::vector<std::string> recordFolders(const std::string& folder)
{
  if (holdsRecords(folder)) return {folder};
  std::vector<std::string> out;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (holdsRecords(entry.path())) out.push_back(entry.path().string());
  if (out.empty())
    throw core::Error(core::ExitStatus::kUnreadable, folder, "holds no records of a study",
                      "give a folder with runs/, or one of such folders");
  std::sort(out.begin(), out.end());
  return out;
}

math::MeanInterval statistics(const std::vector<std::optional<double>>& values)
{
  std::vector<double> present;
  for (const auto& v : values)
    if (v) present.push_back(*v);
  return math::meanInterval(present);
}

std::optional<math::MeanInterval> pairedRatio(const std::vector<std::optional<double>>& a,
                                              const std::vector<std::optional<double>>& b)
{
  double sumA = 0, sumB = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i]) sumA += *a[i], sumB += *b[i], ++count;
  if (count == 0 || sumB == 0) return std::nullopt;
  const double ratio = sumA / sumB, meanB = sumB / count;
  std::vector<double> residuals;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i]) residuals.push_back((*a[i] - ratio * *b[i]) / meanB);
  math::MeanInterval out = math::meanInterval(residuals);
  out.mean = ratio;
  return out;
}

std::optional<math::MeanInterval> pairedRootRatio(const std::vector<std::optional<double>>& a,
                                                  const std::vector<std::optional<double>>& b)
{
  std::vector<std::optional<double>> squaresA(a.size()), squaresB(a.size()), ratios(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    if (!a[i] || !b[i]) continue;
    squaresA[i] = *a[i] * *a[i];
    squaresB[i] = *b[i] * *b[i];
    if (*b[i] != 0) ratios[i] = *a[i] / *b[i];
  }
  auto out = pairedRatio(squaresA, squaresB);
  if (!out) return std::nullopt;
  out->mean = std::sqrt(out->mean);
  if (out->mean > 0) out->halfWidth95 /= 2 * out->mean;
  out->std = statistics(ratios).std;
  return out;
}

namespace
{
/// The numerator's values of the runs that have the ratio.
std::vector<std::optional<double>> numerators(const Outcome& outcome, const Plan& plan,
                                              std::size_t group, std::size_t metric)
{
  const auto ratios = outcome.values(plan, group, metric);
  auto out = outcome.values(plan, group, *metricByName(metrics()[metric].numerator));
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!ratios[i]) out[i].reset();
  return out;
}
}  // namespace

math::MeanInterval Outcome::summary(const Plan& plan, std::size_t group, std::size_t metric) const
{
  const Metric& m = metrics()[metric];
  if (!m.numerator) return statistics(values(plan, group, metric));
  const auto ratio = pairedRootRatio(numerators(*this, plan, group, metric),
                                     values(plan, group, *metricByName(m.denominator)));
  return ratio.value_or(math::MeanInterval{});
}

std::optional<math::MeanInterval> Outcome::ratio(const Plan& plan, std::size_t group,
                                                 std::size_t reference, std::size_t metric) const
{
  if (!metrics()[metric].numerator)
    return pairedRatio(values(plan, group, metric), values(plan, reference, metric));
  return pairedRootRatio(numerators(*this, plan, group, metric),
                         numerators(*this, plan, reference, metric));
}
}  // namespace slamot::study
