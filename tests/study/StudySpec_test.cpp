#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>
#include <slamot/study/Trial.h>

#include "tinyStudy.h"

namespace slamot::study::test
{
namespace
{
/// The message of the error that laying out a study throws.
std::string errorOf(const TinyStudy& study, const std::vector<std::string>& set)
{
  filters::registerAll();
  try
  {
    (void)study.plan(set);
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kConfig) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    return e.what();
  }
  ADD_FAILURE() << "nothing thrown";
  return {};
}

void expectError(const std::string& assignment, const std::string& part)
{
  const TinyStudy study;
  const std::string message = errorOf(study, {assignment});
  EXPECT_NE(message.find(part), std::string::npos) << assignment << " gave: " << message;
}
}  // namespace

TEST(StudySpec, WrongValuesAreOneLineThatNamesTheKey)
{
  expectError("study.sedes=3", "study.ini [study] sedes: unknown key; did you mean seeds?");
  expectError("study.seeds=0", "study.ini [study] seeds: 0 is out of range");
  expectError("study.methods=joint, nobody", "[study] methods: there is no [method.nobody]");
  expectError("study.methods=joint, joint", "[study] methods: joint comes twice");
  expectError("study.reference=nobody", "[study] reference: 'nobody' is none of the methods");
  expectError("table.ratios.reference=nobody",
              "[table.ratios] reference: 'nobody' is none of the methods");
  expectError("study.rawlogs=x.rawlog", "[study] scenario: is given beside rawlogs");
  expectError("study.scenario=none.ini", "none.ini can't be read");
  expectError("study.vary=particles", "[study] vary: there is no [vary.particles]");
  expectError("study.align=sideways", "[study] align: 'sideways' is not known");
  expectError("table.errors.columns=robot_maen_m",
              "'robot_maen_m' is no metric; known: robot_mean_m");
  expectError("vary.landmarks.keys=wrold.landmarks", "a section [wrold]");
  expectError("vary.landmarks.keys=landmarks", "'landmarks' is no Section.key");
  expectError("vary.landmarks.values=few, many", "[plot.errors] x: the values of landmarks");
  expectError("vary.landmarks.value_labels=few", "value_labels: are not as many as values");
  expectError("study.gospa_cutoff_m=0", "study.ini [study] gospa_cutoff_m: 0 is out of range");
  expectError("published.paper.robot_maen_m=1", "[published.paper] robot_maen_m: unknown key");
  expectError("method.jiont.config=x.ini", "[method.jiont]: unknown section");
  expectError("method.joint.config=none.ini", "none.ini can't be read");
}

TEST(StudySpec, WrongValuesOfScenarioAndMethodsAreFoundBeforeAnyRun)
{
  expectError("vary.landmarks.values=3, -1", "world.ini [world] landmarks: -1 is out of range");
  expectError("vary.landmarks.keys=world.landmrks", "world.ini [world] landmrks: unknown key");
  expectError("method.joint.rbpf-slamot.particles=none", "filter.ini [rbpf-slamot] particles");
  expectError("method.joint.rbpf-slamot.partcles=9",
              "partcles: unknown key; did you mean particles?");
  expectError("scenario.world.landmrks=9", "world.ini [world] landmrks: unknown key");
}

TEST(StudySpec, MethodsThatAnAxisDoesNotTouchShareTheirRuns)
{
  filters::registerAll();
  const TinyStudy study;
  EXPECT_EQ(study.plan().groups.size(), 4u);  // the world differs, for both methods
  const Plan plan = study.plan({"vary.landmarks.keys=rbpf-slamot.particles"});
  EXPECT_EQ(plan.cells.size(), 2u);
  EXPECT_EQ(plan.groups.size(), 3u);
  EXPECT_EQ(plan.groupOf[0][1], plan.groupOf[1][1]);
  EXPECT_NE(plan.groupOf[0][0], plan.groupOf[1][0]);
  EXPECT_EQ(plan.runs.size(), 12u);
}

const std::vector<std::string> kWordByWord = {
    "vary.landmarks.keys=world.landmarks, robot.v_std_mps, rbpf-slamot.particles",
    "vary.landmarks.values=3 0.1 4, 8 0.3 7", "vary.landmarks.value_labels=few, many"};

std::string withoutPlot()
{
  std::string text = TinyStudy::kStudy;
  return text.erase(text.find("[plot.errors]"),
                    std::string("[plot.errors]\ny = robot_mean_m\n").size());
}

TEST(StudySpec, AnAxisMaySetEachKeyToAWordOfItsOwn)
{
  filters::registerAll();
  const TinyStudy study(withoutPlot());
  const Plan plan = study.plan(kWordByWord);
  ASSERT_EQ(plan.cells.size(), 2u);
  EXPECT_EQ(plan.cellValues(plan.cells[1]), std::vector<std::string>{"many"});
  const Trial trial = openTrial(plan.spec, plan.cells[1], plan.spec.methods[0], 1);
  for (const char* setting : {"landmarks = 8\n", "v_std_mps = 0.3\n", "particles = 7\n"})
    EXPECT_NE(trial.effective.find(setting), std::string::npos) << setting << trial.effective;
  EXPECT_NE(trial.effective.find("v_std_mps = 0.2\n"), std::string::npos) << "the target's";
}

TEST(StudySpec, AWordForEachKeyIsAWordForEachKey)
{
  filters::registerAll();
  const TinyStudy study(withoutPlot());
  auto set = kWordByWord;
  set[1] = "vary.landmarks.values=3 0.1 4, 8 0.3";
  EXPECT_NE(errorOf(study, set)
                .find("[vary.landmarks] values: '8 0.3' has not one word for each of "
                      "the keys; write 3 of them"),
            std::string::npos);
}

TEST(StudySpec, SavedSpecRepeatsTheStudy)
{
  filters::registerAll();
  const TinyStudy study;
  const Plan plan = study.plan({"study.seeds = 2", "method.joint.rbpf-slamot.particles=4"});
  saveSpec(study.out("saved"), plan.spec);
  const Plan again(StudySpec::load(study.out("saved/study.ini")));
  ASSERT_EQ(again.groups.size(), plan.groups.size());
  for (std::size_t g = 0; g < plan.groups.size(); ++g)
    EXPECT_EQ(again.groups[g].hash, plan.groups[g].hash);
  EXPECT_EQ(again.runs.size(), plan.runs.size());
}

TEST(StudySpec, ATableOfRatiosHasTheStudysReferenceOrItsOwn)
{
  const TinyStudy study;
  const auto references = [](const StudySpec& spec)
  {
    std::vector<std::string> out;
    for (const TableSpec& t : spec.tables) out.push_back(t.reference);
    return out;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(references(study.spec()), (Names{"", "joint"}));
  EXPECT_EQ(references(study.spec({"table.ratios.reference=odometry"})), (Names{"", "odometry"}));
  EXPECT_EQ(references(study.spec({"study.reference=none", "table.ratios.reference=odometry"})),
            (Names{"", "odometry"}));
}
}  // namespace slamot::study::test
