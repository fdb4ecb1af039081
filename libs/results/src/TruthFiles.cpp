#include <slamot/results/TextFile.h>
#include <slamot/results/TruthFiles.h>

#include <charconv>
#include <filesystem>
#include <optional>

namespace slamot::results
{
namespace fs = std::filesystem;
namespace
{
using core::Error;
using core::ExitStatus;

constexpr const char* kRobot = "robot.tum";
constexpr const char* kLandmarks = "landmarks.csv";
constexpr const char* kAssociations = "associations.csv";
constexpr const char* kRelations = "relations.csv";

void requireHeader(LineReader& line, const std::string& header)
{
  if (!line.next() || line.text() != header)
    line.fail("the header is not '" + header + "'", "write it as the first line");
}

// The columns of the next line that is not empty; none at the end.
std::optional<std::vector<std::string_view>> nextRow(LineReader& line, std::size_t columns)
{
  do
    if (!line.next()) return std::nullopt;
  while (line.text().empty());
  auto parts = line.commaSeparated();
  if (parts.size() != columns)
    line.fail("has " + std::to_string(parts.size()) + " columns, not " + std::to_string(columns),
              "mend the line");
  return parts;
}

std::map<int, Point2D> loadLandmarks(const std::string& path)
{
  std::map<int, Point2D> out;
  LineReader line(path);
  requireHeader(line, "id,x,y");
  while (const auto row = nextRow(line, 3))
  {
    const int id = line.wholeNumber((*row)[0], "id");
    if (id < 0) line.fail("a landmark's id is negative", "number landmarks from 0 on");
    const Point2D at{line.number((*row)[1], "x"), line.number((*row)[2], "y")};
    if (!out.emplace(id, at).second)
      line.fail("landmark " + std::to_string(id) + " comes twice", "remove one");
  }
  return out;
}

std::vector<eval::TrueAssociation> loadAssociations(const std::string& path)
{
  std::vector<eval::TrueAssociation> out;
  LineReader line(path);
  requireHeader(line, "t,index,id");
  while (const auto row = nextRow(line, 3))
  {
    const eval::TrueAssociation a{line.number((*row)[0], "t"), line.wholeNumber((*row)[1], "index"),
                                  line.wholeNumber((*row)[2], "id")};
    if (a.index < 0 || a.id < -1) line.fail("a negative index, or an id below -1", "mend the line");
    if (!out.empty() &&
        (a.time < out.back().time || (a.time == out.back().time && a.index <= out.back().index)))
      line.fail("is not after the line before", "sort by time, then by index");
    out.push_back(a);
  }
  return out;
}

std::vector<eval::Relation> loadRelations(const std::string& path)
{
  std::vector<eval::Relation> out;
  LineReader line(path);
  requireHeader(line, "t1,t2,dx,dy,dtheta");
  while (const auto row = nextRow(line, 5))
  {
    const auto number = [&](std::size_t i, const char* name)
    { return line.number((*row)[i], name); };
    out.push_back({number(0, "t1"),
                   number(1, "t2"),
                   {number(2, "dx"), number(3, "dy"), math::wrapToPi(number(4, "dtheta"))}});
  }
  return out;
}

std::string targetFile(int id)
{
  return "target_" + std::to_string(id) + ".tum";
}

// The id in target_<id>.tum; none for another name.
std::optional<int> targetOf(const std::string& name)
{
  const std::size_t prefix = 7;
  int id = 0;
  if (name.size() <= prefix) return std::nullopt;
  std::from_chars(name.data() + prefix, name.data() + name.size(), id);
  if (id < 0 || name != targetFile(id)) return std::nullopt;
  return id;
}

std::vector<std::string> namesIn(const std::string& folder)
{
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    names.push_back(at->path().filename().string());
  if (error)
    throw Error(ExitStatus::kUnreadable, folder, "can't be read", "give a folder of truth files");
  return names;
}

std::string relationsText(const std::vector<eval::Relation>& relations)
{
  std::string text = "t1,t2,dx,dy,dtheta\n";
  for (const eval::Relation& r : relations)
  {
    const Pose2D& p = r.pose_from_to;
    const char* separator = "";
    for (const double v : {r.from, r.to, p.x, p.y, p.phi})
    {
      appendFixed(text += separator, v, 9);
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

std::map<std::string, std::string> csvFiles(const eval::Truth& truth)
{
  std::map<std::string, std::string> files;
  if (!truth.landmarks.empty()) files[kLandmarks] = "id,x,y\n";
  for (const auto& [id, at] : truth.landmarks)
  {
    std::string& text = files[kLandmarks];
    text += std::to_string(id) + ',';
    appendFixed(text, at.x, 9);
    appendFixed(text += ',', at.y, 9);
    text += '\n';
  }
  if (!truth.associations.empty()) files[kAssociations] = "t,index,id\n";
  for (const eval::TrueAssociation& a : truth.associations)
  {
    std::string& text = files[kAssociations];
    appendFixed(text, a.time, 9);
    text += ',' + std::to_string(a.index) + ',' + std::to_string(a.id) + '\n';
  }
  if (!truth.relations.empty()) files[kRelations] = relationsText(truth.relations);
  return files;
}

void makeEmptyOfTruth(const std::string& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ExitStatus::kUnreadable, folder, "can't be made: " + error.message(),
                "write elsewhere");
  for (const std::string& name : namesIn(folder))
    if (name == kRobot || name == kLandmarks || name == kAssociations || name == kRelations ||
        targetOf(name))
      fs::remove(fs::path(folder) / name, error);
}
}  // namespace

std::string truthFolder(const std::string& rawlogPath)
{
  const fs::path path(rawlogPath);
  if (path.extension() != ".rawlog") return rawlogPath + ".truth";
  return fs::path(path).replace_extension(".truth").string();
}

eval::Truth loadTruth(const std::string& folder)
{
  eval::Truth truth;
  if (!fs::exists(folder)) return truth;
  for (const std::string& name : namesIn(folder))
  {
    const std::string path = (fs::path(folder) / name).string();
    if (name == kRobot) truth.robot = loadTum(path);
    if (name == kLandmarks) truth.landmarks = loadLandmarks(path);
    if (name == kRelations) truth.relations = loadRelations(path);
    if (name == kAssociations) truth.associations = loadAssociations(path);
    if (const auto id = targetOf(name)) truth.targets[*id] = loadTum(path);
  }
  return truth;
}

void saveTruth(const std::string& folder, const eval::Truth& truth)
{
  makeEmptyOfTruth(folder);
  const auto path = [&](const std::string& name) { return (fs::path(folder) / name).string(); };
  if (!truth.robot.empty()) saveTum(path(kRobot), truth.robot);
  for (const auto& [id, trajectory] : truth.targets)
    if (!trajectory.empty()) saveTum(path(targetFile(id)), trajectory);
  for (const auto& [name, text] : csvFiles(truth)) writeWhole(path(name), text);
}
}  // namespace slamot::results
